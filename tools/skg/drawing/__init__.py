"""Drawings: DXF and SVG read, planned, and written as programs; tapes drawn, as DXF and as pictures."""
