"""Exact rationals of doubles, vectors of them, and balls where roots are taken."""

from collections.abc import Sequence

from flint import arb, ctx, fmpq

PRECISION = 320  # bits; what is decided needs relative 1e-30 after cancellations of some 1e-40
ctx.prec = PRECISION
CLEAR = 1e-6  # of a tolerance; what is nearer to it than that is neither clearly kept nor clearly broken
ROUNDING = fmpq(1, 10**30)  # of a bound; limits are without tolerance, this is for the balls

Vector = list[fmpq]


def read(number: float) -> fmpq:
    """The rational that the double nearest to a number is."""
    return fmpq(*float(number).as_integer_ratio())


def read_all(numbers: Sequence[float]) -> Vector:
    """Each number's rational."""
    return [read(number) for number in numbers]


def dot(a: Sequence, b: Sequence):
    """Inner product of vectors of one kind of number."""
    return sum((x * y for x, y in zip(a, b, strict=True)), a[0] * 0)


def cross(a: Sequence, b: Sequence) -> list:
    """Vector product (3,)."""
    return [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]


def apply(matrix: Sequence[Sequence], vector: Sequence) -> list:
    """Matrix (3, 3) times vector (3,)."""
    return [dot(row, vector) for row in matrix]


def root(square: fmpq | arb) -> arb:
    """Square root of what is not negative but for the radius of its ball."""
    ball = square if isinstance(square, arb) else arb(square)
    return arb(0) if ball.is_zero() else ball.nonnegative_part().sqrt()


def norm(vector: Sequence) -> arb:
    """Euclidean length, of rationals or balls."""
    return root(dot(vector, vector))


def largest(values: Sequence[arb]) -> arb:
    """The largest of balls; 0 of none."""
    best = arb(0)
    for value in values:
        best = best.max(value)
    return best


def nearby(ball: arb) -> tuple[fmpq, arb]:
    """A rational in the ball, and how far from it the number that is meant can be."""
    middle = ball.mid()
    mantissa, exponent = middle.man_exp()
    power = fmpq(2) ** int(exponent)
    return fmpq(mantissa) * power, abs(ball - middle).abs_upper()


def within(radius: arb) -> arb:
    """A ball about 0."""
    return arb(0, radius.upper())


def surely_exceeds(value: arb | fmpq, tolerance: float) -> bool:
    """Whether it is above a tolerance by more than one part in a million."""
    return bool(arb(value) > arb(tolerance) * (1 + arb(CLEAR)))


def surely_keeps(value: arb | fmpq, tolerance: float) -> bool:
    """Whether it is below a tolerance by more than one part in a million."""
    return bool(arb(value) < arb(tolerance) * (1 - arb(CLEAR)))


def show(value: arb | fmpq) -> str:
    """A few digits of the middle of a ball."""
    return f"{float(arb(value).mid()):.17g}"
