"""How long work says how far it is: a function of (stage, done, of how many)."""

from collections.abc import Callable

Progress = Callable[[str, int, int], None]
