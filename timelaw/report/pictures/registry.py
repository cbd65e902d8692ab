"""The registry of pictures of a law, by the name that users give them."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from timelaw.motion import QuaternionLaw
from timelaw.report.pictures.frames import describe_frames, draw_frames
from timelaw.report.pictures.rates import describe_rates, draw_rates
from timelaw.report.pictures.stereographic import describe_stereographic, draw_stereographic
from timelaw.report.pictures.traces import describe_traces, draw_traces


@dataclass(frozen=True)
class Picture:
    """Its title, how it is drawn, and what stands for it where it is not seen."""

    title: str
    draw: Callable[[QuaternionLaw], Any]
    describe: Callable[[QuaternionLaw], str]


PICTURES: dict[str, Picture] = {
    "traces": Picture("Traces of the body axes", draw_traces, describe_traces),
    "frames": Picture("The body at the nodes", draw_frames, describe_frames),
    "sphere": Picture("The route on S³", draw_stereographic, describe_stereographic),
    "rates": Picture("Rates over time", draw_rates, describe_rates),
}
