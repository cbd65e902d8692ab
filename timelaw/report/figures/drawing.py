"""A picture as texts, and the words that stand for it where it is not seen."""

from dataclasses import dataclass

from timelaw.report.figures.drawn import Scene
from timelaw.report.figures.rates import say_peak


@dataclass(frozen=True)
class Drawing:
    """One picture as SVG texts, for screen and paper, and for a phone; its title and what it shows."""

    title: str
    description: str
    wide: str
    narrow: str


def describe_laws(scene: Scene) -> str:
    """The times of the laws."""
    laws = (scene.optimised, *scene.baselines)
    return "Bars of total time: " + ", ".join(f"{e.name} {e.law.duration:.6g} s" for e in laws) + "."


def describe_rates(scene: Scene) -> str:
    """The proved peak of each quantity."""
    parts = [f"{channel.words} [{channel.unit}] {say_peak(scene, channel)}" for channel in scene.channels]
    return f"Curves over the time of the motion: {'; '.join(parts)}."


def describe_limits(scene: Scene) -> str:
    """How much of each limit is used."""
    parts = [f"{c.limit} to {100 * c.ratio:.4g} %" for c in scene.optimised.certificate.limits]
    return f"For each limit the part that each segment uses; at most: {', '.join(parts)}."
