"""Quantities with units: conversions, and what is refused."""

import numpy as np
import pytest

from timelaw.units import (
    ANGULAR_ACCELERATION,
    ANGULAR_JERK,
    ANGULAR_VELOCITY,
    FREQUENCY,
    MOMENTUM,
    TORQUE,
    parse_quantity,
)


@pytest.mark.parametrize(
    ("text", "kind", "value"),
    [
        ("60 deg/s", ANGULAR_VELOCITY, np.pi / 3),
        ("60°/s", ANGULAR_VELOCITY, np.pi / 3),
        ("10 rpm", ANGULAR_VELOCITY, np.pi / 3),
        ("1 rev/min", ANGULAR_VELOCITY, np.pi / 30),
        ("3.6e3 arcsec/s", ANGULAR_VELOCITY, np.pi / 180),
        (" 2 mrad / ms ", ANGULAR_VELOCITY, 2.0),
        ("1 rad*Hz", ANGULAR_VELOCITY, 1.0),
        ("1 rpm/s", ANGULAR_ACCELERATION, np.pi / 30),
        ("180 deg/s^2", ANGULAR_ACCELERATION, np.pi),
        ("180 deg/s²", ANGULAR_ACCELERATION, np.pi),
        ("180 deg/s/s", ANGULAR_ACCELERATION, np.pi),
        ("180 deg*s^-2", ANGULAR_ACCELERATION, np.pi),
        ("1 rad/s**3", ANGULAR_JERK, 1.0),
        (".5 kHz", FREQUENCY, 500.0),
        ("60 dps", ANGULAR_VELOCITY, np.pi / 3),
        ("180 degrees/sec^2", ANGULAR_ACCELERATION, np.pi),
        ("1 radians/sec^3", ANGULAR_JERK, 1.0),
        ("0.2 Nm", TORQUE, 0.2),
        ("200 mNm", TORQUE, 0.2),
        ("4 Nms", MOMENTUM, 4.0),
        ("4 Nm*sec", MOMENTUM, 4.0),
    ],
)
def test_conversions(text, kind, value):
    assert parse_quantity(text, kind) == pytest.approx(value, rel=1e-15)


@pytest.mark.parametrize(
    "text", ["", "deg/s", "60", "60 Hz", "60 deg", "60 deg/s^2", "60 deg//s", "1e deg/s", "60 furlong/s"]
)
def test_refusals(text):
    with pytest.raises(ValueError, match=r"write|unknown unit|unit"):
        parse_quantity(text, ANGULAR_VELOCITY)
