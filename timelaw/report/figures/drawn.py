"""What pictures of rates ask of a design, whatever its route: its law, and those beside it."""

from typing import Protocol

from timelaw.pipeline import Certified


class Drawn(Protocol):
    """A law with its certificate, and baselines."""

    @property
    def optimised(self) -> Certified:
        """The law that was designed."""
        ...

    @property
    def baselines(self) -> tuple[Certified, ...]:
        """Laws beside it."""
        ...
