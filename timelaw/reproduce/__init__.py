"""Commands that make published numbers again; nothing imports them."""
