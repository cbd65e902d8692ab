"""Merging is greedy in the order of the set, whatever its size: against all pairs, one after another."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from tests.cases import unit_quaternions
from timelaw.orientations import equivalence
from timelaw.orientations.equivalence import find_equivalents, make_rotation_group
from timelaw.tours.graph import distances

TOLERANCES = [1e-6, 0.02, 0.2]


def compare_all(q, tolerance, group):
    """By definition, in plain steps: the chord between q_i and ±q_j ⊗ s for every s."""
    turns = np.eye(4)[:1] if group is None else group
    whole = Rotation.from_quat(q, scalar_first=True)
    images = np.stack(
        [(whole * Rotation.from_quat(s, scalar_first=True)).as_quat(scalar_first=True) for s in turns]
    )
    chord, first = 2 * np.sin(tolerance / 4), []
    for i in range(len(q)):
        kept = [j for j in range(i) if first[j] == j]
        near = [
            j
            for j in kept
            if min(np.min(np.linalg.norm(images[:, j] - sign * q[i], axis=1)) for sign in (1, -1)) <= chord
        ]
        first.append(min(near, default=i))
    return first


def cloud(rng, count, spread, group):
    """Orientations within `spread` [rad] of one, or anywhere; some twice; turned by any of a group."""
    q = unit_quaternions(rng, count)
    if spread:
        vectors = q[:, 1:] * spread * rng.uniform(size=(count, 1)) / 2
        about = Rotation.from_rotvec(vectors) * Rotation.from_quat(q[0], scalar_first=True)
        q = about.as_quat(scalar_first=True) * rng.choice([-1.0, 1.0], size=(count, 1))
    q = np.concatenate([q, q[::5], -q[::7]])
    if group is not None:
        turns = Rotation.from_quat(group[rng.integers(len(group), size=len(q))], scalar_first=True)
        q = (Rotation.from_quat(q, scalar_first=True) * turns).as_quat(scalar_first=True)
    return q


@pytest.mark.parametrize("tolerance", TOLERANCES)
@pytest.mark.parametrize("spread", [0.0, 0.03, 0.4])
@pytest.mark.parametrize("name", [None, "m-3m", "-3m", "I", "D12"])
def test_greedy_merging_is_as_it_is_defined(name, spread, tolerance, monkeypatch):
    monkeypatch.setattr(equivalence, "BLOCK", 50)
    monkeypatch.setattr(equivalence, "FEW", 8)
    group = None if name is None else make_rotation_group(name)
    q = cloud(np.random.default_rng(len(name or "") + int(spread * 100)), 60, spread, group)
    assert find_equivalents(q, tolerance, group) == compare_all(q, tolerance, group)


@pytest.mark.parametrize("name", [None, "m-3m"])
@pytest.mark.parametrize(("spread", "tolerance"), [(0.0, 1e-3), (0.02, 1e-3), (0.02, 0.1)])
def test_a_map_of_many_points_takes_seconds_and_little_memory(spread, tolerance, name):
    """Those kept are apart, the others within the tolerance of the one they are merged with."""
    import tracemalloc

    group = None if name is None else make_rotation_group(name)
    q = cloud(np.random.default_rng(5), 20_000, spread, group)
    tracemalloc.start()
    first = np.array(find_equivalents(q, tolerance, group))
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 40e6  # 4.6 GB for 8000 points, where all pairs are held
    assert np.all(first[first] == first)
    assert np.all(first <= np.arange(len(q)))
    turns = np.eye(4)[:1] if group is None else group
    pairs = Rotation.from_quat(q, scalar_first=True).inv() * Rotation.from_quat(q[first], scalar_first=True)
    w = np.abs(pairs.as_quat(scalar_first=True) @ (turns * [1, -1, -1, -1]).T)
    assert np.max(2 * np.arccos(np.clip(np.max(w, axis=1), 0, 1))) <= tolerance + 1e-7
    kept = q[np.unique(first)][:300]
    assert find_equivalents(kept, tolerance, group) == list(range(len(kept)))


def test_the_least_distance_of_many_is_found_by_nearest_ones(monkeypatch):
    q = cloud(np.random.default_rng(3), 200, 0.0, None)[:200]
    least = distances.find_minimal_distance(q)
    monkeypatch.setattr(distances, "MANY", 100)
    assert distances.find_minimal_distance(q) == pytest.approx(least, rel=1e-12)
    assert distances.find_minimal_distance(np.concatenate([q, q[:1]])) == 0
