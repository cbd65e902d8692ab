"""The registry of segments, by the kind that the law file gives them."""

from timelaw.motion.arc import Arc
from timelaw.motion.dwell import Dwell
from timelaw.motion.rational import Rational
from timelaw.motion.segment import Segment

KINDS: dict[str, type[Segment]] = {kind.kind: kind for kind in (Arc, Dwell, Rational)}
