"""Short ways to ask the translator of TEKHTRAN."""

from __future__ import annotations

from functools import partial

import rivalhelp

from skg.rivals.tekhtran import translate

made = partial(rivalhelp.made, translate=translate)
cut = partial(rivalhelp.cut, translate=translate)
fault = partial(rivalhelp.fault, translate=translate)
