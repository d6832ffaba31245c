"""A tape checked: its wire laid beside the drawing."""
