"""Drawings read: a DXF or SVG file becomes contours."""
