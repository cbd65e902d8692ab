"""What legs cost at least in runs too many to list, against all runs of sets where they can be listed."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from tests.cases import unit_quaternions
from timelaw.limits import make_limits
from timelaw.orientations.lattices import make_lattice
from timelaw.tours import shares
from timelaw.tours.ends import Ends
from timelaw.tours.fastest import find_fastest
from timelaw.tours.travel_times import TravelTimes

LIMITS = {"velocity": 1.0, "acceleration": 2.0, "jerk": 10.0}
BY_AXIS = {"velocity": (1.0, 0.5, 2.0), "acceleration": (2.0, 2.0, 1.0), "jerk": 10.0}
NO_CRUISE = {"acceleration": 2.0}


def about_z(*degrees):
    return Rotation.from_euler("Z", np.array(degrees)[:, None], degrees=True).as_quat(scalar_first=True)


SETS = {
    "24-cell": make_lattice("24-cell"),
    "a row": np.concatenate([about_z(0, 9, 30, 41, 44, 80), unit_quaternions(np.random.default_rng(1), 3)]),
    "a ring": about_z(0, 50, 110, 170, 230, 300),
    "two rings": np.concatenate([about_z(0, 70, 140, 200, 290), make_lattice("tesseract")[:4]]),
}


def in_all_runs(travel):
    """The least equal share of each leg in any run, every run listed and timed by itself."""
    least = travel.legs.copy()
    for run in travel.straight_runs.runs():
        for i, j in pairwise(run):
            least[i, j] = least[j, i] = min(least[i, j], travel.run(run) / (len(run) - 1))
    return least


@pytest.mark.parametrize("limits", [LIMITS, BY_AXIS, NO_CRUISE], ids=["norms", "by axis", "acceleration"])
@pytest.mark.parametrize("name", SETS)
@pytest.mark.parametrize("most_steps", [24, 1])
def test_no_run_has_less(name, limits, most_steps, monkeypatch):
    monkeypatch.setattr(shares, "MOST_STEPS", most_steps)
    q = SETS[name]
    for passable in (range(len(q)), range(1, len(q))):
        travel = TravelTimes(q, make_limits(limits, None), passable)
        bounds, least = shares.bound_shares(travel), in_all_runs(travel)
        assert np.all(bounds <= least * (1 + 1e-9))
        assert np.all(bounds[~np.eye(len(q), dtype=bool)] > 0) or (most_steps == 1 and limits is NO_CRUISE)


def test_what_a_whole_row_takes_is_shared_by_its_legs():
    """Sixty nodes about one axis: one run over all, to which the bound adds up."""
    travel = TravelTimes(about_z(*range(0, 120, 6)), make_limits(NO_CRUISE, None), range(20))
    found = find_fastest(travel, Ends())
    (merit,) = found.merits
    assert merit.value == pytest.approx(2 * np.sqrt(np.radians(114) / 2.0), rel=1e-9)
    assert merit.is_best


@pytest.mark.parametrize(
    ("limits", "gap"),
    [((1, 0.05, 0.01), 1e-6), pytest.param((60, 120, 600), 0.19, marks=pytest.mark.campaign)],
)
def test_the_120_cell(limits, gap):
    """Its runs are too many to list; where acceleration and jerk count most, minimal legs are proved the fastest.

    A tour of 299 legs enters all nodes but one, each by a leg that costs a share at least.
    """
    rates = dict(zip(LIMITS, np.radians(limits).tolist(), strict=True))
    travel = TravelTimes(make_lattice("120-cell"), make_limits(rates, None), range(300))
    bounds = shares.bound_shares(travel) + np.diag(np.full(300, np.inf))
    stops = 299 * travel.legs[travel.legs > 0].min()
    least = np.sum(np.sort(np.min(bounds, axis=0))[:-1])
    assert least * (1 - 1e-9) <= stops <= least * (1 + gap)
