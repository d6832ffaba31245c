"""How near fitted curves come to the true ones, and how many blocks they take."""
