"""Other programs on the same routes: how each is set up, and what comes of it."""
