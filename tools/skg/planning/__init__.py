"""Contours planned: their order, their start holes and passes."""
