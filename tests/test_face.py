"""The public Python face, its page, and what `dir(timelaw)` shows."""

import json
import re
from pathlib import Path

import numpy as np
import pytest
from scipy.interpolate import PPoly
from scipy.spatial.transform import Rotation

import timelaw
from tests.cases import PROBLEMS
from tests.laws import LAWS, law_of
from timelaw.errors import InputError
from timelaw.face import Law

PAGE = Path(timelaw.__file__).parent / "docs" / "python.md"
PROBLEM = {
    "timelaw": 1,
    "name": "two",
    "route": {"orientations": {"list": [[1, 0, 0, 0], [0.6, 0.8, 0, 0]]}},
    "limits": {"velocity": "60 deg/s", "acceleration": "120 deg/s^2", "jerk": "600 deg/s^3"},
    "baselines": [],
}


def test_the_package_shows_what_it_is_for_and_nothing_else():
    public = [name for name in dir(timelaw) if not name.startswith("_")]
    assert public == sorted(timelaw.__all__) == ["certify", "design", "load", "quaternion"]
    for name in public:
        assert getattr(timelaw, name).__doc__
        assert name in timelaw.__doc__
    with pytest.raises(AttributeError, match="no attribute 'desing'"):
        timelaw.desing  # noqa: B018


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    """The names that the blocks of the page leave behind."""
    folder = tmp_path_factory.mktemp("page")
    names = {"law_json": LAWS["paper"]}
    code = "\n".join(re.findall(r"```python\n(.*?)```", PAGE.read_text(), re.DOTALL))
    exec(code.replace('"rates.png"', repr(str(folder / "rates.png"))), names)
    return folder, names


def test_every_block_of_the_page_runs_and_says_what_it_says(page):
    folder, names = page
    t, law = names["t"], names["law"]
    turns = Rotation.from_quat(names["q"] if len(np.shape(names["q"])) > 1 else law(t), scalar_first=True)
    np.testing.assert_allclose(names["R"], turns.as_matrix(), atol=1e-14)
    np.testing.assert_allclose(names["turned"], names["R"][:, :, 0], atol=1e-14)
    for order, key in enumerate(("omega", "alpha", "jerk"), 1):
        np.testing.assert_array_equal(names[key], law(t, order))
    assert names["same"].name == "paper-24-cell"
    assert names["arrays"]["q"].shape == (len(names["arrays"]["t"]), 4)
    assert (folder / "rates.png").read_bytes().startswith(b"\x89PNG")
    assert all(upper <= bound for upper, bound in names["peaks"].values())
    np.testing.assert_allclose(
        names["x_turned"], [np.cos(3 * np.pi / 4), np.sin(3 * np.pi / 4), 0], atol=1e-15
    )
    assert names["labels"] == ("1", "2", "3")


def test_every_function_of_the_algebra_stands_on_the_page():
    for name in timelaw.quaternion.__all__:
        assert f"`{name}`" in PAGE.read_text()


def test_a_mapping_is_a_problem_file(tmp_path):
    path = tmp_path / "two.yaml"
    path.write_text(json.dumps(PROBLEM))
    one, other = timelaw.design(PROBLEM).law, timelaw.design(str(path)).law
    assert one.duration == other.duration
    np.testing.assert_array_equal(one(one.duration / 3), other(one.duration / 3))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"name": "a b"}, 'name: "a b"; letters, digits'),
        ({"limits": {"velocity": 60}}, 'limits.velocity: "60" has no unit'),
        ({"limits": {"velocity": {1, 2}}}, "problem: not what a problem file can hold: set {1, 2}"),
        (
            {"limits": {"velocity": float("nan")}},
            "problem: not what a problem file can hold: Out of range float",
        ),
    ],
)
def test_mappings_that_are_wrong(change, message):
    with pytest.raises(InputError) as error:
        timelaw.design(PROBLEM | change)
    assert message in str(error.value)


def test_curves_are_designed_too():
    done = timelaw.design(
        {
            "timelaw": 1,
            "name": "curve",
            "route": {"bezier": [{"quaternions": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]}]},
            "limits": {"velocity": "60 deg/s", "acceleration": "120 deg/s^2", "jerk": "600 deg/s^3"},
            "baselines": [],
        }
    )
    assert timelaw.certify(done.law).holds
    with pytest.raises(ValueError, match=r"leg 1–2 is a rational curve and has no easing: .* take rotation"):
        done.law.to_scipy().easing(0)


@pytest.mark.parametrize("name", LAWS)
def test_scipy_has_the_same_motion(name):
    law = timelaw.load(LAWS[name])
    assert isinstance(law, Law)
    t = np.linspace(0, law.duration, 300)
    motion = law.to_scipy()
    np.testing.assert_allclose(motion.rotation(t).as_matrix(), law_of(name).rotation(t), atol=1e-14)
    for k, leg in enumerate(law.legs):
        if leg.kind != "arc":
            with pytest.raises(ValueError, match="is a rational curve"):
                motion.easing(k)
            continue
        easing = motion.easing(k)
        assert isinstance(easing, PPoly)
        inside = np.linspace(leg.start_time, leg.end_time, 50)[1:-1]
        for order in (1, 2, 3):
            rate = easing.derivative(order)(inside)[:, None] * leg.angle * leg.direction
            np.testing.assert_allclose(rate, law(inside, order), rtol=1e-7, atol=1e-7)
        np.testing.assert_allclose(easing([leg.start_time, leg.end_time]), [0, 1], atol=1e-12)
    with pytest.raises(IndexError, match="there are legs 0 to"):
        motion.easing(len(law.legs))


def test_samples_are_those_of_the_export():
    law = timelaw.load(LAWS["dwells"])
    found = law.sample(50.0)
    np.testing.assert_array_equal(found["omega"], law(found["t"], 1))
    for rate in (0.0, -1.0, float("nan"), float("inf")):
        with pytest.raises(ValueError, match="a positive number of samples per second"):
            law.sample(rate)
    with pytest.raises(InputError, match="at most 20000000 are written"):
        law.sample(1e9)


@pytest.mark.parametrize("name", ["through", "dwells"])
def test_the_plot_has_each_rate_with_its_limit(name):
    law = timelaw.load(LAWS[name])
    figure = law.plot()
    assert len(figure.axes) == 3
    for ax, order in zip(figure.axes, (1, 2, 3), strict=True):
        x, y, z, norm = (line.get_ydata() for line in ax.lines[:4])
        np.testing.assert_allclose(np.sqrt(x**2 + y**2 + z**2), norm, atol=1e-9)
        bound = law.limits.get({1: "velocity", 2: "acceleration", 3: "jerk"}[order])
        dashed = sorted(line.get_ydata()[0] for line in ax.lines if line.get_linestyle() == "--")
        both = [-np.degrees(bound), np.degrees(bound)] if isinstance(bound, float) else []
        assert dashed == pytest.approx(both)
        assert np.max(norm) > 0


def test_a_certificate_of_a_loaded_law_is_that_of_its_file():
    law = timelaw.load(LAWS["paper"])
    assert timelaw.certify(law).holds
    assert timelaw.certify(law).digest == json.loads(LAWS["paper"].read_text())["certificate"]["digest"]
    with pytest.raises(InputError, match="this is a problem file, not a law file"):
        timelaw.load(PROBLEMS / "paper-24-cell.yaml")
