"""Cutting: from a drawing's contours to a tape that was checked against them, and the shop's sheet for it."""
