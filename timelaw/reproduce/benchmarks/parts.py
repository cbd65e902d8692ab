"""All parts, in the order of the page."""

from timelaw.reproduce.benchmarks import (
    coupled,
    evaluation,
    many_legs,
    proofs,
    random_tours,
    single_leg,
    start_up,
    sweeps,
)
from timelaw.reproduce.benchmarks.part import Part
from timelaw.reproduce.benchmarks.peers import comparison

PARTS: dict[str, Part] = {
    part.name: part
    for part in (
        comparison.PART,
        evaluation.PART,
        single_leg.PART,
        *many_legs.PARTS,
        coupled.PART,
        proofs.PART,
        random_tours.PART,
        sweeps.PART,
        start_up.PART,
    )
}
