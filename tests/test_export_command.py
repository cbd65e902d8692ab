"""`timelaw export` as a shell sees it, and motions that end on a multiple of a control cycle."""

import json

import numpy as np
import pytest

from tests.cases import PROBLEMS, problem
from tests.laws import LAWS, SMALL, law_of
from timelaw.certificate import certify
from timelaw.cli.app import run_command
from timelaw.errors import InputError
from timelaw.export.registry import EXPORTERS
from timelaw.law_file import read_law
from timelaw.motion.cycle import stretch_to_cycle
from timelaw.pipeline import design
from timelaw.problem import load_problem
from timelaw.problem.output import find_given_times

PAPER = str(LAWS["paper"])


def export(capfd, *arguments):
    """Exit code, the object on stdout, the text on stderr."""
    code = run_command(["export", *map(str, arguments), "--json"])
    said = capfd.readouterr()
    return code, json.loads(said.out), said.err


@pytest.mark.parametrize("name", EXPORTERS)
def test_every_format_is_written_beside_its_path(name, tmp_path, capfd):
    code, found, said = export(
        capfd, LAWS["dwells"], "--to", name, "-o", tmp_path / EXPORTERS[name].file_name
    )
    assert code == 0
    assert found["files"] == [
        str(p) for p in sorted(tmp_path.iterdir(), key=lambda p: p.name not in found["files"][0])
    ]
    assert all(path.stat().st_size > 500 for path in tmp_path.iterdir())
    assert EXPORTERS[name].loses in said


def test_without_a_path_it_goes_beside_the_law(tmp_path, capfd):
    law = tmp_path / "law.json"
    law.write_bytes(LAWS["dwells"].read_bytes())
    assert export(capfd, law, "--to", "c99")[1]["files"] == [str(tmp_path / "law.c"), str(tmp_path / "law.h")]
    assert export(capfd, law, "--to", "csv")[1]["files"] == [str(tmp_path / "samples.csv")]


def test_the_list_says_what_each_carries_and_loses(capfd):
    code, found, said = export(capfd, "--list")
    assert code == 0
    assert set(found["formats"]) == set(EXPORTERS)
    run_command(["export", "--help"])
    shown = " ".join(capfd.readouterr().out.split())
    for name, exporter in EXPORTERS.items():
        assert name in said
        assert exporter.loses in shown


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ([], "Missing argument 'LAW'"),
        ([PAPER], "--to FORMAT is needed: csv, npz, mat, aem"),
        ([PAPER, "--to", "json"], '--to "json"; allowed: csv, npz'),
        (
            [PAPER, "--to", "csv", "--rate", "100"],
            '--rate: "100" has no unit; write a frequency like "100 Hz"',
        ),
        ([PAPER, "--to", "csv", "--rate", "4 ms"], '--rate: "4 ms" is not a frequency'),
        ([PAPER, "--to", "csv", "--rate", "1e99 Hz"], "is out of range; 1e-09 to 1e+09 1/s are allowed"),
        ([PAPER, "--to", "csv", "--rate", "1 MHz"], 'unknown unit "MHz"'),
        (
            [PAPER, "--to", "csv", "--rate", "900 kHz"],
            "25945995 rows in 28.8289 s; at most 20000000 are written",
        ),
        ([PAPER, "--to", "c99", "--rate", "9 Hz"], "--rate does nothing for c99; it belongs to csv, npz"),
        (
            [PAPER, "--to", "csv", "--epoch", "2000-01-01"],
            "--epoch does nothing for csv; it belongs to aem, aem-1.0, stk",
        ),
        (
            [PAPER, "--to", "aem", "--epoch", "noon"],
            '--epoch "noon"; an instant like 2030-06-01T12:00:00 is needed',
        ),
        ([PAPER, "--to", "tum", "--single"], "--single does nothing for tum; it belongs to c99"),
        (
            [PAPER, "--to", "csv", "--grid", "0 s"],
            '--grid "0 s" is out of range; 1e-06 to 1000 s are allowed',
        ),
        ([PAPER, "--to", "csv", "-o", PAPER], "is the law file itself"),
        (["none.json", "--to", "csv"], "none.json: cannot be read"),
        ([str(SMALL / "moving.json"), "--to", "csv", "--grid", "4 ms"], "--grid: the motion begins moving"),
    ],
)
def test_what_is_wrong_is_said(arguments, message, capfd):
    code, found, said = export(capfd, *arguments)
    assert code == 2
    assert message in said
    assert not found["ok"]


@pytest.mark.parametrize("name", [*LAWS])
@pytest.mark.parametrize("cycle", [0.004, 1.0, 7.7])
def test_a_stretched_law_ends_on_the_grid_through_the_same_orientations(name, cycle):
    law = law_of(name)
    found = stretch_to_cycle(law, cycle)
    assert found.duration / cycle == pytest.approx(round(found.duration / cycle), abs=1e-9)
    assert -1e-9 <= found.duration - law.duration < cycle
    factor = 1 + (found.duration - law.duration) / sum(s.duration for s in law.legs)
    for before, after in zip(law.segments, found.segments, strict=True):
        kept = before.duration * (factor if before.moves else 1.0)
        assert after.duration == pytest.approx(kept, rel=1e-14)
        tau = np.linspace(0, 1, 7)
        np.testing.assert_allclose(after(tau, 0, "right"), before(tau, 0, "right"), atol=1e-14)
        scale = factor if before.moves else 1.0
        for order in (1, 2, 3):
            expected = before(tau, order, "right") / scale**order
            np.testing.assert_allclose(after(tau, order, "right"), expected, atol=1e-11)
        if law.travels:
            np.testing.assert_allclose(
                after.place(tau, 0, "right"), before.place(tau, 0, "right"), atol=1e-14
            )
    assert not certify(found).findings()


def test_what_is_on_the_grid_stays():
    law = stretch_to_cycle(law_of("dwells"), 0.25)
    assert stretch_to_cycle(law, 0.25).duration == law.duration


def test_the_exported_motion_ends_on_the_grid(tmp_path, capfd):
    code, found, said = export(capfd, PAPER, "--to", "npz", "--grid", "4 ms", "-o", tmp_path / "s.npz")
    assert code == 0
    assert "stretched from 28.8288816 s to 28.832 s, and certified again" in said
    assert found["duration"] == pytest.approx(28.832, abs=1e-12)
    with np.load(tmp_path / "s.npz") as arrays:
        assert arrays["t"][-1] == pytest.approx(28.832, abs=1e-12)


def altered(tmp_path, change):
    document = json.loads(LAWS["dwells"].read_text())
    change(document)
    (tmp_path / "law.json").write_text(json.dumps(document))
    return tmp_path / "law.json"


def test_a_law_that_breaks_a_limit_is_written_and_said(tmp_path, capfd):
    law = altered(tmp_path, lambda document: document["limits"].update(velocity=0.1))
    code, found, said = export(capfd, law, "--to", "tum")
    assert code == 1
    assert not found["ok"]
    assert "finding: velocity reaches 1.0" in said
    assert (tmp_path / "trajectory.tum").exists()


def test_what_is_no_motion_is_refused(tmp_path, capfd):
    law = altered(tmp_path, lambda document: document["segments"][1].update(duration=9.0))
    code, _, said = export(capfd, law, "--to", "tum")
    assert code == 2
    assert f"{law}: it is no motion that could be exported: " in said
    assert not (tmp_path / "trajectory.tum").exists()


def test_a_curve_through_zero_has_no_orientation_there(tmp_path, capfd):
    """Q from q to -q: the limits cannot be proved, and nothing can be drawn there."""

    def turn(document):
        (segment,) = (s for s in document["segments"][:1])
        piece = segment["pieces"][0]
        piece["control"] = [piece["control"][0], [-x for x in piece["control"][0]], piece["control"][0]]

    document = json.loads(LAWS["curves"].read_text())
    turn(document)
    (tmp_path / "law.json").write_text(json.dumps(document))
    code, _, said = export(capfd, tmp_path / "law.json", "--to", "gltf")
    assert code == 2
    assert "no motion that could be exported" in said or "no orientation at some instant" in said


def test_a_law_that_keeps_given_times_is_not_stretched(tmp_path, capfd):
    document = json.loads(LAWS["dwells"].read_text())
    document["provenance"] = {"given_times": ["objective.total_time"]}
    (tmp_path / "law.json").write_text(json.dumps(document))
    code, _, said = export(capfd, tmp_path / "law.json", "--to", "csv", "--grid", "1 s")
    assert code == 2
    assert "--grid: the law keeps ['objective.total_time'], which a stretch would change" in said


TWO = "route: {orientations: {list: [[1,0,0,0], [0.6,0.8,0,0], [0.6,0,0.8,0]]}}\nbaselines: []\n"


@pytest.mark.parametrize("motion", ["arcs", "through"])
def test_a_design_ends_on_its_cycle_and_is_certified_as_it_is(motion, tmp_path):
    path = tmp_path / "p.yaml"
    limits = "limits: {velocity: 60 deg/s, acceleration: 120 deg/s^2, jerk: 600 deg/s^3}\n"
    path.write_text(f"timelaw: 1\nname: p\n{TWO}{limits}motion: {motion}\noutput: {{grid: 8 ms}}\n")
    done = design(path).optimised
    assert done.law.duration / 0.008 == pytest.approx(round(done.law.duration / 0.008), abs=1e-9)
    assert done.certificate.holds
    assert done.certificate.duration == done.law.duration
    assert max(check.upper / check.bound for check in done.certificate.limits) > 0.99


@pytest.mark.parametrize(
    ("more", "key"),
    [
        ("objective: {minimise: jerk, total_time: 60 s}", "objective.total_time"),
        ("nodes: {at: {8: {time: 40 s}}}", "nodes.at.8.time"),
        ("segments: {9-6: {duration: 4 s}}", "segments.9-6.duration"),
        ("nodes: {start: {velocity: 10 deg/s}}", "nodes.start"),
        ("nodes: {end: {velocity: 10 deg/s}}", "nodes.end"),
    ],
)
def test_a_cycle_is_refused_where_times_are_given(more, key):
    with pytest.raises(
        InputError, match=f"output.grid: the motion would be stretched .* no longer keep {key}"
    ):
        problem(f"output: {{grid: 4 ms}}\n{more}")


def test_the_law_file_says_which_times_were_given():
    shipped, _ = load_problem(PROBLEMS / "camera-scan.yaml")
    given = list(find_given_times(shipped))
    assert given == ["objective.total_time", "nodes.at.2.time", "nodes.at.3.time"]
    assert "given_times" not in read_law(LAWS["paper"])[1]["provenance"]
