"""The gains of a design at a glance, in the words of its objective: numbers, each with what it is."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite

from timelaw.motion import QuaternionLaw
from timelaw.pipeline import Design
from timelaw.report.numbers import write_number
from timelaw.report.outcome import Gain, measure_gain
from timelaw.report.problem_text import CONTINUOUS
from timelaw.report.summary import LawRow
from timelaw.time_law.baselines import time_double_s

NOTICEABLE = 1e-6  # relative; rest that is less of the time is not told


@dataclass(frozen=True)
class Tile:
    """A number, short, and what it is."""

    number: str
    words: str


def list_tiles(design: Design, rows: Sequence[LawRow]) -> list[Tile]:
    """What was gained first, then the time, how far it is from the best possible, and how smooth it is."""
    best, law = rows[0], design.optimised.law
    gain = measure_gain(design)
    tiles = [_show_effort(gain)] if gain is not None else _show_time(design, best)
    tiles.append(
        Tile(f"{write_number(law.duration)} s", "total time" + ("" if gain is None else ", as asked"))
    )
    tiles += show_motion_time(law)
    if isfinite(best.to_limit) and design.through is None and gain is None:
        tiles.append(Tile(f"+{100 * (best.to_limit - 1):.2f} %", "time above the physical limit"))
    tiles.append(Tile(f"C{best.continuity}", f"{CONTINUOUS[best.continuity]} without jumps"))
    return tiles


def _show_time(design: Design, best: LawRow) -> list[Tile]:
    if design.through is None:
        return show_gain(best.duration, best.duration / best.to_quintic, design.requirements.dwell_time)
    stopping = time_double_s(design.route, design.requirements, stop=True).duration
    return [
        show_difference(best.duration / stopping, "time against a stop at every node (double-S)"),
        show_difference(best.to_quintic, "time against the quintic"),
    ]


def _show_effort(gain: Gain) -> Tile:
    if gain.part is None:
        unit = f" {gain.objective.unit}" if gain.objective.unit else ""
        return Tile(f"{gain.value:.4g}{unit}", gain.objective.symbol)
    return show_difference(1 - gain.part, f"{gain.objective.symbol} against the quintic in the same time")


def show_difference(ratio: float, words: str) -> Tile:
    """A ratio as what it is more or less than one."""
    sign = "−" if ratio <= 1 else "+"
    return Tile(f"{sign}{abs(100 * (ratio - 1)):.1f} %", words)


def show_gain(duration: float, quintic: float, rest: float) -> list[Tile]:
    """Time [s] against the quintic's; where the body rests, what both need in motion first."""
    tiles = [show_difference(duration / quintic, "time against the quintic")]
    if rest > NOTICEABLE * duration:
        moving = (duration - rest) / (quintic - rest)
        tiles = [show_difference(moving, "time in motion against the quintic"), *tiles]
    return tiles


def show_motion_time(law: QuaternionLaw) -> list[Tile]:
    """The time in motion, where the body also rests."""
    motion = sum(leg.duration for leg in law.legs)
    return (
        [Tile(f"{write_number(motion)} s", "in motion")] if motion < law.duration * (1 - NOTICEABLE) else []
    )
