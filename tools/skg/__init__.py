"""Host tools of SKG, the numerical-control language of an 8080 board."""
