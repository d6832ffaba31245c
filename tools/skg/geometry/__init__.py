"""Places, lines, arcs, contours, and what lies around them."""
