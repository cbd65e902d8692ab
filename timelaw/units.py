"""Quantities with units: "60 deg/s^2" → SI with radians, the angle counted as a dimension.

Pint and its kind treat an angle as a pure number, so that "60 Hz" would pass as an angular
velocity; in this field that is the very mistake a unit check is for.
"""

import math
import re
from dataclasses import dataclass
from fractions import Fraction

from timelaw.errors import shorten

LEAST, MOST = 1e-9, 1e9  # in SI; no body is that slow or fast, and cubes of times stay far from overflow

LONGEST = 1000  # characters of a quantity; a number may have all its digits
Dimension = tuple[int, int, int, int]  # exponents of angle, second, metre, kilogram


@dataclass(frozen=True)
class Kind:
    """A physical dimension with its name in messages and an example of how to write it."""

    name: str
    dimension: Dimension
    example: str
    unit: str


ANGULAR_VELOCITY = Kind("an angular velocity", (1, -1, 0, 0), "60 deg/s", "rad/s")
ANGULAR_ACCELERATION = Kind("an angular acceleration", (1, -2, 0, 0), "120 deg/s^2", "rad/s^2")
ANGULAR_JERK = Kind("an angular jerk", (1, -3, 0, 0), "600 deg/s^3", "rad/s^3")
ANGULAR_SNAP = Kind("an angular snap", (1, -4, 0, 0), "3000 deg/s^4", "rad/s^4")
TORQUE = Kind("a torque", (0, -2, 2, 1), "0.2 N*m", "N*m")
MOMENTUM = Kind("an angular momentum", (0, -1, 2, 1), "4 N*m*s", "N*m*s")
INERTIA = Kind("a moment of inertia", (0, 0, 2, 1), "12 kg*m^2", "kg*m^2")
LINEAR_VELOCITY = Kind("a velocity", (0, -1, 1, 0), "0.5 m/s", "m/s")
LINEAR_ACCELERATION = Kind("an acceleration", (0, -2, 1, 0), "2 m/s^2", "m/s^2")
LENGTH = Kind("a length", (0, 0, 1, 0), "1.5 m", "m")
TIME = Kind("a time", (0, 1, 0, 0), "2 s", "s")
ANGLE = Kind("an angle", (1, 0, 0, 0), "20 deg", "rad")
FREQUENCY = Kind("a frequency", (0, -1, 0, 0), "100 Hz", "1/s")

_UNITS: dict[str, tuple[Fraction | float, Dimension]] = {
    "rad": (Fraction(1), (1, 0, 0, 0)),
    "mrad": (Fraction(1, 1000), (1, 0, 0, 0)),
    "deg": (math.pi / 180, (1, 0, 0, 0)),
    "°": (math.pi / 180, (1, 0, 0, 0)),
    "arcmin": (math.pi / 10800, (1, 0, 0, 0)),
    "arcsec": (math.pi / 648000, (1, 0, 0, 0)),
    "rev": (2 * math.pi, (1, 0, 0, 0)),
    "rpm": (2 * math.pi / 60, (1, -1, 0, 0)),
    "s": (Fraction(1), (0, 1, 0, 0)),
    "ms": (Fraction(1, 1000), (0, 1, 0, 0)),
    "min": (Fraction(60), (0, 1, 0, 0)),
    "h": (Fraction(3600), (0, 1, 0, 0)),
    "Hz": (Fraction(1), (0, -1, 0, 0)),
    "kHz": (Fraction(1000), (0, -1, 0, 0)),
    "m": (Fraction(1), (0, 0, 1, 0)),
    "cm": (Fraction(1, 100), (0, 0, 1, 0)),
    "mm": (Fraction(1, 1000), (0, 0, 1, 0)),
    "kg": (Fraction(1), (0, 0, 0, 1)),
    "g": (Fraction(1, 1000), (0, 0, 0, 1)),
    "N": (Fraction(1), (0, -2, 1, 1)),
    "mN": (Fraction(1, 1000), (0, -2, 1, 1)),
    "degrees": (math.pi / 180, (1, 0, 0, 0)),
    "radians": (Fraction(1), (1, 0, 0, 0)),
    "dps": (math.pi / 180, (1, -1, 0, 0)),
    "sec": (Fraction(1), (0, 1, 0, 0)),
    "Nm": (Fraction(1), (0, -2, 2, 1)),
    "mNm": (Fraction(1, 1000), (0, -2, 2, 1)),
    "Nms": (Fraction(1), (0, -1, 2, 1)),
    "mNms": (Fraction(1, 1000), (0, -1, 2, 1)),
}
UNIT_NAMES = tuple(_UNITS)
_NUMBER = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*)", re.DOTALL)
_FACTOR = re.compile(r"([A-Za-z°]+)(?:(?:\^|\*\*)([+-]?\d))?$")
_SUPERSCRIPTS = str.maketrans({"²": "^2", "³": "^3", "⁴": "^4", "·": "*", "⋅": "*"})


def parse_quantity(text: str, kind: Kind) -> float:
    """Value in SI (radians) of a text such as "60 deg/s^2" or "12 kg*m^2".

    Raises:
        ValueError: with what is wrong, without the place.
    """
    match = _NUMBER.fullmatch(text) if len(text := text.strip()) <= LONGEST else None
    if match is None:
        raise ValueError(f'"{shorten(text)}" is not {kind.name}; write it like "{kind.example}"')
    number, unit = match.groups()
    if not unit:
        raise ValueError(f'"{text}" has no unit; write {kind.name} like "{kind.example}"')
    scale, dimension = _parse_unit(unit)
    if dimension != kind.dimension:
        raise ValueError(f'"{text}" is not {kind.name}; write it like "{kind.example}"')
    return float(number) * scale


def _parse_unit(text: str) -> tuple[float, Dimension]:
    """Scale to SI and dimension of a product of units, read from the left: a/b*c is (a/b)*c."""
    scale: float = 1.0
    dimension = [0, 0, 0, 0]
    parts = re.split(r"([*/])", text.translate(_SUPERSCRIPTS).replace("**", "^"))
    for index in range(0, len(parts), 2):
        sign = -1 if index and parts[index - 1] == "/" else 1
        factor = _FACTOR.match(parts[index].strip())
        if factor is None:
            raise ValueError(f'cannot read the unit "{text}"; write units like "deg/s^2" or "kg*m^2"')
        name, power = factor.group(1), sign * int(factor.group(2) or 1)
        if name not in _UNITS:
            raise ValueError(f'unknown unit "{name}"; known: {", ".join(_UNITS)}')
        size, base = _UNITS[name]
        scale *= float(size) ** power
        dimension = [d + power * b for d, b in zip(dimension, base, strict=True)]
    return scale, (dimension[0], dimension[1], dimension[2], dimension[3])


def convert(value: float, unit: str, *, degrees: bool) -> float:
    """A value in SI, or with its angles in degrees."""
    return value * (180 / math.pi) if degrees and "rad" in unit else value


def name_unit(unit: str, *, degrees: bool) -> str:
    """The unit of `convert`."""
    return unit.replace("rad", "deg") if degrees else unit
