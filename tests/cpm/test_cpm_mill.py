"""SKGMILL.COM: the milling firmware under CP/M gives the reference's tape, in a file of type .NC."""

from __future__ import annotations

import pytest
from cpmhelp import PROCESSORS, ROOT, Cpm, text

from skg.ref import mill

PARTS = {
    "statements": "10 M 6,2\n20 M 3,1200\n30 G 4,0.5\n40 F 200,60\n50 Z -2,5\n60 R=1\n70 FROM (-5,0)\n"
    "80 CUT (0,0),(40,0),5,(40,30),(0,30),(0,0)\n90 FROM (20,15)\n100 Z -4\n110 CUT (20,15):6\n120 BACK\n"
    "130 HOLE (10,10),(20,20)\n140 END\n",
    "error": "10 F 100\n20 Z -1\n30 CUT (0,0),(1,0),(2,0)\n40 A=1/0\n",
    "no feed": "10 Z -1\n20 CUT (0,0),(1,0)\n",
}


@pytest.mark.parametrize("processor", PROCESSORS)
@pytest.mark.parametrize("name", PARTS)
def test_tape(name: str, processor: str) -> None:
    """From the command line; the error too is the reference's."""
    wanted = mill.run(PARTS[name])
    cpm = Cpm(processor, {"PART.SKG": text(PARTS[name])}, program=ROOT / "roms" / "skgmill.com")
    printed = cpm.type("SKG PART TAPE")
    assert cpm.at_cpm
    assert ("ERR" in printed) == (name != "statements")
    assert cpm.read("TAPE.NC") == wanted.tape
