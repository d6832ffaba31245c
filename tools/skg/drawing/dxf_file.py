"""A DXF file's bytes as ezdxf's drawing."""

from __future__ import annotations

import io
import re

from ezdxf import recover
from ezdxf.document import Drawing
from ezdxf.lldxf.const import DXFError

from skg.errors import UserError


def load(data: bytes, name: str) -> Drawing:
    """Read a DXF file's bytes; a damaged one is mended as far as ezdxf can, else `UserError`."""
    if b"SECTION" not in data:
        raise UserError(f"{name}: not a DXF drawing, it has no SECTION")
    try:
        return recover.read(io.BytesIO(data))[0]
    except (DXFError, OSError, ValueError, KeyError, IndexError, AttributeError) as error:
        reason = re.sub(r"\s+", " ", str(error)) or type(error).__name__
        raise UserError(f"{name}: not a DXF drawing that can be read ({reason})") from None
