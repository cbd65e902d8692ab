"""Single legs from rest to rest under limits on rates: least times of all at once, without a solver."""
