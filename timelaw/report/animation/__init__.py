"""A law's motion as a moving picture: frames drawn one at a time, and the formats they are written in."""
