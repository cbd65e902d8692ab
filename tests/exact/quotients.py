"""The largest quotient |p|/q over a piece, q > 0: a ball that holds it, found by dividing the piece.

With m a value that is taken, g = m q - |p| is looked at on patches c ± r as a polynomial in v = (u - c)/r.
A patch is done where g is surely positive; where it is surely monotone, for m is at least the values at the
ends; and where it is surely convex, for there its tangent at the lowest point, to which Newton's steps lead,
is below it. All else is halved, or, where balls are what is left of g, counted into the upper end.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from flint import arb, arb_poly

from tests.exact.patches import Patch, Patches

TINY = arb(2) ** -120  # of the maximum; what may be left open
DUST = arb(2) ** -300  # of what the quantity would be if nothing cancelled: rounding alone
STEPS = 40  # of Newton; quadratic, so a dozen is the rule
HALVINGS = 60
MOST = 6000  # patches of one quotient

Quotient = Callable[[Patch], tuple[arb_poly, arb_poly]]


@dataclass
class Search:
    """What is known of a maximum: `least`, a value that is taken, and `most`, what no patch exceeds.

    `gross` is of the size that p/q would have if nothing cancelled.
    """

    gross: arb
    least: arb = field(default_factory=lambda: arb(0))
    most: arb = field(default_factory=lambda: arb(0))

    def take(self, value: arb) -> None:
        """A value of the quotient, as a ball."""
        self.least = self.least.max(value.lower())
        self.allow(value)

    @property
    def slack(self) -> arb:
        """What may be left open."""
        return (TINY * self.least).max(DUST * self.gross)

    def allow(self, value: arb) -> None:
        """Something that the maximum may be."""
        self.most = self.most.max(value.upper())

    @property
    def found(self) -> arb:
        """The ball."""
        return self.least.union(self.least.max(self.most))


def enclose_quotient(patches: Patches, quotient: Quotient, senses: Sequence[int], gross: arb) -> arb:
    """The largest of sense * p/q over the piece and the `senses`; 0 at least."""
    search = Search(gross)
    open_ = list(patches.first())
    looked = 0
    while open_:
        pairs = [(patch, *quotient(patch)) for patch in open_]
        for _, p, q in pairs:
            for v in (-1, 0, 1):
                value = p(arb(v)) / q(arb(v))
                search.take(abs(value) if len(senses) > 1 else value)
        looked += len(open_)
        last = looked > MOST or open_[0].depth >= HALVINGS
        open_ = [
            half
            for patch, p, q in pairs
            if not all(_is_done(search, p * sense, q, last=last) for sense in senses)
            for half in patches.halve(patch)
        ]
    return search.found


def _is_done(search: Search, p: arb_poly, q: arb_poly, *, last: bool) -> bool:
    """Whether nothing above what is found is left on a patch."""
    g = (search.least * q - p).coeffs()
    if not g:
        return True
    sizes = [abs(c) for c in g]
    least = g[0] - sum(sizes[1:], arb(0))
    if least > 0:
        return True
    bend = sum((i * size for i, size in enumerate(sizes[2:], 2)), arb(0))
    if len(g) > 1 and sizes[1] > bend:
        return True
    lowest = _find_least(q)
    if lowest > 0 and (last or -least < search.slack * lowest):
        search.allow(search.least + (-least).max(arb(0)) / lowest)
        return True
    if last:
        search.allow(arb.pos_inf())
        return True
    turn = sum((i * (i - 1) * size for i, size in enumerate(sizes[3:], 3)), arb(0))
    return len(g) > 2 and 2 * g[2] > turn and lowest > 0 and _descend(search, p, q, lowest)


def _find_least(p: arb_poly) -> arb:
    """A bound on p from below for v in [-1, 1]."""
    c = p.coeffs()
    return c[0] - sum((abs(x) for x in c[1:]), arb(0))


def _descend(search: Search, p: arb_poly, q: arb_poly, lowest: arb) -> bool:
    """On a patch on which g is convex: to its lowest point, m growing on the way."""
    v = arb(0)
    for _ in range(STEPS):
        g = search.least * q - p
        slope = g.derivative()
        fall, bend = slope(v), slope.derivative()(v)
        if not bend > 0:
            return False
        target = _clamp((v - fall / bend).mid())
        search.take(p(target) / q(target))
        if abs(target - v) < TINY:
            v = target
            break
        v = target
    g = search.least * q - p
    fall = g.derivative()(v)
    if (v == 1 and fall < 0) or (v == -1 and fall > 0):
        return True  # for m is no less than the value there
    below = g(v) - abs(fall) * 2
    excess = (-below).max(arb(0)) / lowest
    if not excess < search.slack:
        return False
    search.allow(search.least + excess)
    return True


def _clamp(v: arb) -> arb:
    return v.max(arb(-1)).min(arb(1)).mid()
