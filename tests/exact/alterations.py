"""Alterations of one number or word of a law document, anywhere in it."""

from collections import defaultdict
from collections.abc import Callable, Iterator
from math import inf, nextafter
from random import Random
from typing import Any

Path = tuple[Any, ...]

LEFT_ALONE = ("conventions", "provenance", "timelaw", "format", "version", "name")
FACTORS = (2.0, 0.5, 1000.0, -1.0)
SMALL = 0.4e-9  # each of a few tolerable ones, which add up to what is not
STEPS = (*(10.0**-k for k in range(6, 16)), 0.4e-9, 0.6e-9, 0.9e-9, 1.1e-9, 2e-9, 1e-4)


def list_leaves(data: Any, path: Path = ()) -> Iterator[tuple[Path, Any]]:
    """Every number, word and truth of a document, with the way to it."""
    if isinstance(data, dict):
        for key, value in data.items():
            if path or key not in LEFT_ALONE:
                yield from list_leaves(value, (*path, key))
    elif isinstance(data, list):
        for index, value in enumerate(data):
            yield from list_leaves(value, (*path, index))
    else:
        yield path, data


def name_field(path: Path) -> str:
    """The keys of a path, without the places in lists."""
    return ".".join(key for key in path if isinstance(key, str))


def replace(document: Any, path: Path, value: Any) -> None:
    """Set what is at the end of a path."""
    for key in path[:-1]:
        document = document[key]
    document[path[-1]] = value


def alter_number(rng: Random, value: float) -> tuple[str, float]:
    """Another number near it, or far from it, and how it was found."""
    way = rng.randrange(7)
    sense = rng.choice((-1, 1))
    if way == 0:
        return "by an ulp", nextafter(value, sense * inf)
    if way == 1:
        for _ in range(steps := rng.randint(2, 6)):
            value = nextafter(value, sense * inf)
        return f"by {steps} ulp", value
    if way in (2, 3):
        step = rng.choice(STEPS)
        return f"by {step:g} of it", value * (1 + sense * step) if value else sense * step
    if way == 4:
        step = rng.choice(STEPS)
        return f"by {step:g}", value + sense * step
    if way == 5:
        factor = rng.choice(FACTORS)
        return f"times {factor:g}", value * factor
    return "to zero", 0.0


def alter_leaf(rng: Random, value: Any) -> tuple[str, Any]:
    """Another value of the same type."""
    if isinstance(value, bool):
        return "to the contrary", not value
    if isinstance(value, str):
        return "to another word", rng.choice(("another", value + "'", "1", "2"))
    if isinstance(value, int) and abs(value) < 10:
        return "by one", value + rng.choice((-1, 1))
    return alter_number(rng, float(value))


def alter_field(rng: Random, document: dict[str, Any]) -> str:
    """Alter one leaf of a field that is chosen first, so that long lists do not take all."""
    fields: dict[str, list[tuple[Path, Any]]] = defaultdict(list)
    for path, value in list_leaves(document):
        if value is not None:
            fields[name_field(path)].append((path, value))
    field = rng.choice(sorted(fields))
    path, value = rng.choice(fields[field])
    how, other = alter_leaf(rng, value)
    replace(document, path, other)
    return f"{field}: {how}"


def swap_numbers(rng: Random, document: dict[str, Any]) -> str:
    """Swap two neighbours in a list of numbers."""
    lists: dict[str, list[Path]] = defaultdict(list)
    for path, value in list_leaves(document):
        if path and isinstance(path[-1], int) and path[-1] > 0 and isinstance(value, float):
            lists[name_field(path)].append(path)
    field = rng.choice(sorted(lists))
    path = rng.choice(lists[field])
    holder: Any = document
    for key in path[:-1]:
        holder = holder[key]
    i = path[-1]
    holder[i - 1], holder[i] = holder[i], holder[i - 1]
    return f"{field}: swapped"


def flip_vector(rng: Random, document: dict[str, Any]) -> str:
    """Turn a quaternion or an axis around."""
    segment = rng.choice(document["segments"])
    key = rng.choice([k for k in ("start", "end", "axis", "orientation") if k in segment])
    segment[key] = [-x for x in segment[key]]
    return f"segments.{key}: turned around"


def stretch_vector(rng: Random, document: dict[str, Any]) -> str:
    """Make a quaternion or an axis a little longer or shorter."""
    segment = rng.choice(document["segments"])
    key = rng.choice([k for k in ("start", "end", "axis", "orientation") if k in segment])
    by = rng.choice((-1, 1)) * rng.choice(STEPS)
    segment[key] = [x * (1 + by) for x in segment[key]]
    return f"segments.{key}: longer by {by:g}"


def touch_limit(rng: Random, document: dict[str, Any]) -> str:
    """Set a bound of the law to what its record says it reaches, or a little less."""
    reached = {c["limit"]: c["upper"] for c in document.get("certificate", {}).get("limits", [])}
    path, value = rng.choice([(p, v) for p, v in list_leaves(document["limits"])])
    name = path[0] if len(path) == 1 else f"{path[0]} {'xyz'[path[1]]}"
    by = rng.choice((0.0, 1e-15, 1e-14, 1e-13, 1e-12, 1e-10, 1e-9, 1e-6))
    replace(document["limits"], path, reached.get(name, value) * (1 - by))
    return f"limits: what is reached less {by:g} of it"


def drift_nodes(rng: Random, document: dict[str, Any]) -> str:
    """Every stored orientation off by a little, and every angle."""
    for segment in document["segments"]:
        for key in ("start", "end", "orientation"):
            if key in segment:
                segment[key] = [x + rng.uniform(-SMALL, SMALL) for x in segment[key]]
        if "angle" in segment:
            segment["angle"] += rng.uniform(-SMALL, SMALL)
    return "orientations and angles drift"


def drift_pieces(rng: Random, document: dict[str, Any]) -> str:
    """One state of every piece off by a little, so that gaps add up."""
    order, size = rng.randrange(3), 10 ** rng.uniform(-13, -8)
    for segment in document["segments"]:
        for piece in segment.get("pieces", []):
            if order < len(piece.get("state", ())):
                piece["state"][order] += rng.uniform(-size, size)
    return f"rates {order} of all pieces drift"


def drift_times(rng: Random, document: dict[str, Any]) -> str:
    """Every start time a few ulp off."""
    for segment in document["segments"][1:]:
        for _ in range(rng.randrange(4)):
            segment["start_time"] = nextafter(segment["start_time"], rng.choice((-inf, inf)))
    return "start times drift"


ALTERATIONS: tuple[Callable[[Random, dict[str, Any]], str], ...] = (
    *[alter_field] * 6,
    swap_numbers,
    flip_vector,
    stretch_vector,
    drift_nodes,
    drift_pieces,
    drift_times,
    *[touch_limit] * 2,
)
