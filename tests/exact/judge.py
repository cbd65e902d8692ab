"""The judge: which promises a law document clearly breaks."""

from typing import Any

from tests.exact.continuity import find_jumps, list_breaks
from tests.exact.limits import list_limited
from tests.exact.motion import Motion
from tests.exact.nodes import find_long_vectors, find_missed_nodes
from tests.exact.record import find_false_record
from tests.exact.times import find_impossible_body, find_wrong_times
from tests.exact.translation import Way


def judge(document: dict[str, Any]) -> list[str]:
    """Promises that the document clearly breaks, a sentence each that begins with the promise's number.

    The document is one that can be read as a law file. P2, the motion itself, is what the others judge.
    """
    motion = Motion(document)
    undefined = [finding for segment in motion.segments for finding in segment.find_undefined()]
    if undefined:
        return undefined
    limited, breaks = list(list_limited(motion)), list_breaks(motion)
    way = Way(motion) if motion.travels else None
    found = [
        *find_long_vectors(motion),
        *find_missed_nodes(motion),
        *find_wrong_times(motion),
        *(one.finding for one in limited if one.broken),
        *find_jumps(motion, breaks),
        *(way.find_gaps() + way.find_jumps() if way else []),
        *find_impossible_body(motion),
    ]
    return found + find_false_record(motion, limited, breaks, way, holds=not found)
