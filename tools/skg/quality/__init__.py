"""How good fitted curves are."""
