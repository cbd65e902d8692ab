"""What a law file says of itself, against the motion: duration, nodes, and the recorded certificate."""

from typing import Any

from flint import arb, fmpq

from tests.exact.continuity import Break
from tests.exact.curve_limits import RATE_ORDERS
from tests.exact.limits import Limited
from tests.exact.motion import Motion
from tests.exact.rational import CLEAR, largest, norm, read
from tests.exact.translation import Way

RECORD = 1e-9  # relative
LOOSE = 1e-11  # of what a quantity is at most if nothing cancels: a proved bound may exceed the maximum by so much


def find_false_record(
    motion: Motion, limited: list[Limited], breaks: list[Break], way: Way | None, *, holds: bool
) -> list[str]:
    """P8: where `nodes` and `certificate`, if they are there, say other things than the motion shows."""
    found = _find_false_nodes(motion, breaks)
    if "certificate" not in motion.document:
        return found
    certificate = motion.document["certificate"]
    if not isinstance(certificate, dict):
        return [*found, "P8 the certificate is none"]
    if certificate.get("holds") is not holds:
        found.append(f"P8 the certificate says holds: {certificate.get('holds')}")
    if _is_other_class(certificate.get("continuity"), [*breaks, *(way.breaks if way else [])]):
        found.append(f"P8 the certificate says C{certificate.get('continuity')}, which the motion is not")
    if "translation" in certificate:
        found += _find_false_way(certificate["translation"], way)
    return found + _find_false_limits(certificate.get("limits"), limited)


def _is_other_class(order: Any, breaks: list[Break]) -> bool:
    """Whether a class is surely not that of a motion with these breaks."""
    least = min(one.least_class() for one in breaks)
    return not (_is_number(order) and least <= order <= min(one.greatest_class() for one in breaks))


def _find_false_way(recorded: Any, way: Way | None) -> list[str]:
    """The classes of the origin's way, and its jumps at the nodes."""
    if way is None or not isinstance(recorded, dict):
        return ["P8 the certificate tells of a way that there is not"]
    found = []
    if _is_other_class(recorded.get("continuity"), way.breaks):
        found.append(f"P8 the certificate says that the way is C{recorded.get('continuity')}")
    nodes, at_nodes = recorded.get("nodes"), [one for one in way.list_meetings() if one[2] is not None]
    if not (isinstance(nodes, list) and len(nodes) == len(at_nodes)):
        return [*found, "P8 the certificate does not know the nodes of the way"]
    for index, (node, (_, (before, after), _)) in enumerate(zip(nodes, at_nodes, strict=True)):
        for order, name in enumerate(RATE_ORDERS, 1):
            jump = norm([b - a for a, b in zip(before[order], after[order], strict=True)])
            loose = LOOSE * way.gross(order)
            given = node["jump"].get(name) if isinstance(node.get("jump"), dict) else None
            if not _is_number(given) or abs(read(given) - jump) > RECORD * (1 + CLEAR) * jump + loose:
                found.append(
                    f"P8 the certificate says that the {name} of the way jumps by {given} at node {index}"
                )
    return found


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _differs(given: Any, value: fmpq, scale: fmpq) -> bool:
    """Whether a recorded number is surely another one."""
    return not _is_number(given) or abs(read(given) - value) > read(RECORD * (1 + CLEAR)) * scale


def _find_false_nodes(motion: Motion, breaks: list[Break]) -> list[str]:
    """Labels, times and classes of the nodes; times to 1e-9 of the whole, for the first is 0."""
    if "nodes" not in motion.document:
        return []
    nodes = motion.document["nodes"]
    segments = motion.segments
    labels = [segments[0].origin, *(segment.target for segment in segments)]
    times = [*(segment.begins for segment in segments), motion.end]
    if not (
        isinstance(nodes, list) and len(nodes) == len(labels) and all(isinstance(n, dict) for n in nodes)
    ):
        return ["P8 the nodes are not as many as the motion's"]
    found = []
    at_nodes = [one for one in breaks if one.node is not None]
    for index, (node, label, time, one) in enumerate(zip(nodes, labels, times, at_nodes, strict=True)):
        order = node.get("continuity")
        if node.get("label") != label:
            found.append(f"P8 node {index} is called {node.get('label')!r}")
        if _differs(node.get("time"), time, motion.end):
            found.append(f"P8 node {index} is said to be at {node.get('time')} s")
        if not (_is_number(order) and one.least_class() <= order <= one.greatest_class()):
            found.append(f"P8 node {index} is said to be C{order}")
    return found


def _find_false_limits(recorded: Any, limited: list[Limited]) -> list[str]:
    """Names, bounds and proved maxima; of one name all segments together."""
    if not (isinstance(recorded, list) and all(isinstance(one, dict) for one in recorded)):
        return ["P8 the certificate lists no limits"]
    names = {one.label for one in limited}
    known = [one.get("limit") for one in recorded]
    found = [f"P8 the certificate does not know the limit {name}" for name in sorted(names - set(known))]
    for one in recorded:
        same = [entry for entry in limited if entry.label == one.get("limit")]
        if not same:
            found.append(f"P8 the certificate knows a limit {one.get('limit')!r}")
        elif all(_differs(one.get("bound"), entry.bound, entry.bound) for entry in same):
            found.append(f"P8 the certificate says {one.get('bound')} is the bound of {same[0].label}")
        elif len({str(entry.bound) for entry in same}) == 1:
            found += _find_false_maximum(one, same)
    return found


def _find_false_maximum(recorded: dict[str, Any], same: list[Limited]) -> list[str]:
    """A recorded `upper` that is below the maximum, or above what rounding makes of it."""
    upper, true = recorded.get("upper"), largest([entry.maximum for entry in same])
    slack = arb(RECORD) * (1 + arb(CLEAR)) * true
    loose = arb(LOOSE) * max(entry.gross for entry in same)
    if not _is_number(upper) or read(upper) < true - slack or read(upper) > true + slack + loose:
        return [
            f"P8 the certificate says {recorded['limit']} is at most {upper}, it is {float(true.mid()):.17g}"
        ]
    return []
