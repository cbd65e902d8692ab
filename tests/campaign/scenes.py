"""Seeded orientations and tours: what a problem file says under `route`, and the angles it is about."""

import numpy as np

from tests.campaign.attitude import about, product, unit

NEARLY = (0.0, 1e-15, 1e-14, 1e-13, 1e-12, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3)
TOURS = ("shortest", "fewest-stops", "least-turning", "fastest")


def random_axis(rng):
    """Anywhere on the sphere."""
    v = rng.normal(size=3)
    return v / np.linalg.norm(v)


def count(rng, small: bool) -> int:
    """Of legs: mostly few."""
    if small:
        return int(rng.integers(1, 4))
    return int(
        rng.choice([1, 2, 3, 4, 5, 8, 13, 25, 59], p=[0.3, 0.2, 0.15, 0.1, 0.1, 0.07, 0.04, 0.03, 0.01])
    )


def written(quaternions) -> dict:
    """As a list with all digits."""
    return {"list": [[float(c) for c in q] for q in quaternions]}


def follow(start, axes, angles):
    """Orientations reached by turns one after the other."""
    points = [start]
    for axis, angle in zip(axes, angles, strict=True):
        points.append(unit(product(points[-1], about(axis, angle))))
    return points


def scatter(rng, small):
    """Random orientations."""
    return {"orientations": written(unit(rng.normal(size=(count(rng, small) + 1, 4))))}


def searched(rng, small):
    """Random orientations in an order to be found; the other tours want neighbours at one distance."""
    n = int(rng.integers(2, 4 if small else 12))
    route = {
        "orientations": written(unit(rng.normal(size=(n + 1, 4)))),
        "tour": str(rng.choice(["shortest", "fastest"])),
    }
    return route | ({"closed": True} if rng.random() < 0.3 else {})


def chain_angles(rng, n):
    """Equal and nearly equal steps, now and then one of another size."""
    base = float(rng.choice([rng.uniform(0.05, 3.0), np.pi / 2, np.pi / 3, 0.1]))
    angles = base * (1 + rng.choice(NEARLY, size=n) * rng.choice([-1, 1], size=n))
    odd = rng.random(n) < 0.15
    return np.minimum(np.where(odd, rng.uniform(0.01, 3.1, size=n), angles), 3.1)


def chain(rng, small):
    """Steps about one axis, in places a corner."""
    n = max(count(rng, small), 2)
    axis, angles = random_axis(rng), chain_angles(rng, n)
    axes = [axis if rng.random() < 0.85 else random_axis(rng) for _ in angles]
    points = follow(unit(rng.normal(size=4)), axes, angles)
    flips = rng.choice([-1.0, 1.0], size=n + 1)
    return {"orientations": written(np.array(points) * flips[:, None])}


def vectors(rng, small):
    """Steps about one axis as rotation vectors."""
    n = max(count(rng, small), 2)
    where = np.concatenate([[0.0], np.cumsum(chain_angles(rng, n))])
    axis = random_axis(rng) if rng.random() < 0.7 else np.eye(3)[rng.integers(3)]
    unit_name, factor = ("deg", 180 / np.pi) if rng.random() < 0.5 else ("rad", 1.0)
    rows = [[float(c) for c in axis * a * factor] for a in where]
    return {"orientations": {"as": "rotation-vector", "unit": unit_name, "list": rows}}


def typed(rng, small):
    """A chain or random orientations, with few digits or of single precision."""
    route = chain(rng, small) if rng.random() < 0.7 else scatter(rng, small)
    rows = np.array(route["orientations"]["list"])
    digits = int(rng.choice([0, 4, 5, 6, 7, 8, 10, 12]))
    rows = rows.astype(np.float32).astype(float) if digits == 0 else np.round(rows, digits)
    return {"orientations": written(rows)}


def tiny(rng, small):
    """Tiny turns among large ones and half turns."""
    n = max(count(rng, small), 2)
    pool = [10.0 ** rng.uniform(-4, -2, size=n), rng.uniform(0.5, 3.0, size=n), np.full(n, np.pi)]
    angles = np.choose(rng.choice(3, size=n, p=[0.45, 0.4, 0.15]), pool)
    axis = random_axis(rng)
    axes = [axis if rng.random() < 0.5 else random_axis(rng) for _ in angles]
    return {"orientations": written(follow(unit(rng.normal(size=4)), axes, angles))}


def body_axes(rng, small):
    """Quarter, third and half turns about the body's axes, exact ones in places."""
    n = count(rng, small)
    axes = [np.eye(3)[rng.integers(3)] * rng.choice([-1, 1]) for _ in range(n)]
    angles = rng.choice([np.pi / 2, np.pi, np.pi / 3, 2 * np.pi / 3], size=n)
    return {"orientations": written(follow(np.array([1.0, 0, 0, 0]), axes, angles))}


def lattice(rng, small):
    """Vertices of a regular polytope, all of them or some."""
    names = ["16-cell"] if small else ["16-cell", "tesseract", "24-cell"]
    name = str(rng.choice(names if small or rng.random() < 0.85 else ["600-cell", "120-cell"]))
    size = {"16-cell": 4, "tesseract": 8, "24-cell": 12, "600-cell": 60, "120-cell": 300}[name]
    kind = rng.random()
    if kind < 0.3 and size <= 12:
        return {"orientations": {"lattice": name}, "tour": (rng.permutation(size) + 1).tolist()}
    if name == "24-cell" and kind < 0.6:
        return {"orientations": {"lattice": name}, "tour": "paper"}
    tours = TOURS if size <= 12 else TOURS[:3]
    return {
        "orientations": {"lattice": name},
        "tour": str(rng.choice(tours)),
        "closed": bool(rng.random() < 0.3),
    }


SCENES = {
    f.__name__: (f, weight)
    for f, weight in (
        (scatter, 4),
        (chain, 5),
        (vectors, 3),
        (typed, 3),
        (tiny, 3),
        (body_axes, 2),
        (searched, 1),
        (lattice, 2),
    )
}
