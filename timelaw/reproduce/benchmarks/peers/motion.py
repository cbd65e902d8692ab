"""What every peer is given, and what it has to answer with."""

from collections.abc import Callable
from dataclasses import dataclass

from timelaw.numerics.array import Array


@dataclass(frozen=True)
class Course:
    """Nodes (n, 4), scalar first, each next one the nearer of ±q; the greatest |ω|, |α|, |jerk| [rad, s]."""

    name: str
    nodes: Array
    limits: tuple[float, float, float]


@dataclass(frozen=True)
class Motion:
    """When it is at each node (n,) [s], and its unit quaternions (m, 4), scalar first, at times (m,)."""

    times: Array
    evaluate: Callable[[Array], Array]


@dataclass(frozen=True)
class Peer:
    """One way to go: how it is called, its package, a sentence on how it is set up and what it cannot do.

    `prepare(course)` reads what is given, which is not timed, and returns the call that designs the motion.
    """

    label: str
    package: str
    setup: str
    prepare: Callable[[Course], Callable[[], Motion]]
