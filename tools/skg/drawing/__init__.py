"""Drawings: from DXF to programs, from tapes to DXF and to pictures."""
