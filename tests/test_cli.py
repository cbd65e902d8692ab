"""The command line as a shell sees it: exit codes, stdout, stderr, files."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.cases import PROBLEMS
from timelaw.cli import app
from timelaw.errors import InfeasibleError
from timelaw.results_folder.manifest import MANIFEST


def timelaw(*arguments, cwd=None):
    command = [sys.executable, "-m", "timelaw", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, cwd=cwd, check=False)


@pytest.fixture(scope="module")
def designed(tmp_path_factory):
    folder = tmp_path_factory.mktemp("designed")
    return folder, timelaw("design", PROBLEMS / "first-steps.yaml", cwd=folder)


def test_design_writes_its_files_and_says_so(designed):
    folder, done = designed
    assert done.returncode == 0
    assert done.stdout == ""
    assert "certified: all limits hold for all t" in done.stderr
    assert "time [s]" in done.stderr
    assert "\r" not in done.stderr
    names = {path.name for path in (folder / "results" / "first-steps").iterdir()}
    pictures = {"laws.svg", "rates.svg", "limits.svg", "easings.svg"}
    assert names == {"law.json", "samples.csv", "report.html", *pictures, MANIFEST}


def test_verify_agrees_with_design(designed):
    folder, _ = designed
    path = folder / "results" / "first-steps" / "law.json"
    done = timelaw("verify", path, "--json")
    assert done.returncode == 0
    result = json.loads(done.stdout)
    assert result["ok"] is True
    assert result["findings"] == []
    assert result["certificate"] == json.loads(path.read_text())["certificate"]


def alter(folder, tmp_path, change):
    document = json.loads((folder / "results" / "first-steps" / "law.json").read_text())
    change(document["segments"])
    path = tmp_path / "law.json"
    path.write_text(json.dumps(document))
    return path


@pytest.mark.parametrize("what", ["control point", "duration", "axis"])
def test_verify_catches_an_altered_law(designed, tmp_path, what):
    def change(segments):
        if what == "control point":
            segments[1]["pieces"][0]["bernstein"][4] += 1e-9
        elif what == "duration":
            segments[1]["duration"] *= 0.999
        else:
            segments[1]["axis"] = [0.0, 1.0, 0.0]

    done = timelaw("verify", alter(designed[0], tmp_path, change), "--json")
    assert done.returncode == 1
    result = json.loads(done.stdout)
    assert result["ok"] is False
    assert result["findings"]
    assert "NOT certified" in done.stderr


def test_output_folder_and_json(tmp_path):
    done = timelaw("design", PROBLEMS / "first-steps.yaml", "-o", tmp_path / "out", "--json")
    assert done.returncode == 0
    result = json.loads(done.stdout)
    assert result["ok"] is True
    assert all(Path(file).exists() for file in result["files"])
    assert [law["name"] for law in result["laws"]] == [
        "optimised",
        "quintic",
        "double-S",
        "double-S, every stop",
    ]
    assert result["certificate"]["holds"] is True


def test_a_wrong_file_is_exit_2_with_places_and_no_traceback(tmp_path):
    path = tmp_path / "wrong.yaml"
    path.write_text(
        "timelaw: 1\nname: a b\nroute: {orientations: {lattice: 24-cell}}\nlimits: {velocity: 60}\n"
    )
    done = timelaw("design", path, "--json")
    assert done.returncode == 2
    lines = done.stderr.splitlines()
    assert [line.split(": ")[1] for line in lines] == [f"{path}:2:7", f"{path}:4:20"]
    errors = json.loads(done.stdout)
    assert errors["exit_code"] == 2
    assert [e["where"] for e in errors["errors"]] == ["name", "limits.velocity"]
    assert [e["line"] for e in errors["errors"]] == [2, 4]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["design"], "Missing argument 'PROBLEM'"),
        (["desing", "x"], "No such command 'desing'"),
        (["design", "x.yaml", "--fast"], "No such option"),
        (["design", "none.yaml"], "none.yaml: cannot be read: No such file or directory"),
        (["verify", "none.json"], "none.json: cannot be read: No such file or directory"),
        (
            ["verify", str(PROBLEMS / "first-steps.yaml")],
            "first-steps.yaml: this is a problem file, not a law file; run timelaw design",
        ),
        (
            ["verify", str(PROBLEMS / "studies" / "calm-front.yaml")],
            "this is a study file, not a law file; use it with: timelaw sweep",
        ),
    ],
)
def test_a_wrong_command_line_is_exit_2(arguments, message):
    done = timelaw(*arguments, "--json")
    assert done.returncode == 2
    assert message in done.stderr
    assert "Traceback" not in done.stderr
    assert json.loads(done.stdout)["ok"] is False


def test_faults_found_after_reading_name_the_file_too(tmp_path):
    text = (PROBLEMS / "paper-24-cell.yaml").read_text().replace("tour: paper", "tour: [1, 2]")
    (tmp_path / "p.yaml").write_text(text)
    done = timelaw("design", tmp_path / "p.yaml")
    assert done.returncode == 2
    assert f"{tmp_path / 'p.yaml'}:8:9: route.tour: the tour leaves out 3, 4" in done.stderr


def test_a_folder_that_cannot_be_written(tmp_path):
    (tmp_path / "taken").write_text("")
    done = timelaw("design", PROBLEMS / "first-steps.yaml", "-o", tmp_path / "taken")
    assert done.returncode == 2
    assert "cannot be written" in done.stderr


def test_labels_with_markup_and_mathematics(tmp_path):
    (tmp_path / "scan.csv").write_text("label,w,x,y,z\n[/a],1,0,0,0\n$\\frac$,0.6,0.8,0,0\n🛰,0,1,0,0\n")
    text = "timelaw: 1\nname: odd\nroute: {orientations: {file: scan.csv}}\nlimits: {jerk: 1 rad/s^3}\n"
    (tmp_path / "odd.yaml").write_text(text)
    assert timelaw("design", tmp_path / "odd.yaml", "-o", tmp_path / "out", "--json").returncode == 0
    done = timelaw("verify", tmp_path / "out" / "law.json", "--json")
    assert done.returncode == 0
    assert json.loads(done.stdout)["name"] == "odd"


def test_no_command_is_a_wrong_command_line():
    done = timelaw()
    assert done.returncode == 2
    assert "Missing command" in done.stderr


def test_an_interrupt_inside_the_solver_is_obeyed(monkeypatch):
    """CasADi catches Ctrl-C and reports a requested stop; it must not pass for a solution."""
    import casadi

    from timelaw.nlp import ipopt
    from timelaw.nlp.assembly import Layout

    class Stopped:
        def __call__(self, **_):
            return {"x": [0.0]}

        def stats(self):
            return {"return_status": "User_Requested_Stop", "iter_count": 3}

    monkeypatch.setattr(casadi, "nlpsol", lambda *_: Stopped())
    ipopt.keep_solver.cache_clear()
    with pytest.raises(KeyboardInterrupt):
        ipopt.solve(Layout(1, (), (), ()), [0.0], {"lbx": [0.0], "ubx": [1.0]}, strict=False)
    ipopt.keep_solver.cache_clear()


def test_no_solution_is_exit_3_and_an_interrupt_130(monkeypatch, capsys):
    def infeasible(*_, **__):
        raise InfeasibleError("no law was found")

    def interrupted(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr("timelaw.cli.design.run", infeasible)
    assert app._run(["design", "x.yaml", "--json"]) == 3
    assert json.loads(capsys.readouterr().out)["exit_code"] == 3
    monkeypatch.setattr("timelaw.cli.design.run", interrupted)
    assert app.run_command(["design", "x.yaml"]) == 130


def test_help_and_version():
    shown = timelaw("--help")
    assert shown.returncode == 0
    assert "design" in shown.stdout
    assert "Exit codes" in shown.stdout
    assert timelaw("--version").stdout.startswith("timelaw, version")


def test_the_installed_command_is_there():
    assert shutil.which("timelaw", path=str(Path(sys.executable).parent))


def at_a_terminal(command, columns=80):
    """What a command shows on a terminal of so many columns."""
    import pty

    master, slave = pty.openpty()
    environment = {**os.environ, "COLUMNS": str(columns), "TERM": "dumb"}
    done = subprocess.Popen(command, stderr=slave, stdout=subprocess.DEVNULL, env=environment)
    os.close(slave)
    shown = b""
    while True:
        try:
            part = os.read(master, 65536)
        except OSError:
            break
        if not part:
            break
        shown += part
    done.wait()
    return shown.decode()


def test_no_number_or_name_is_cut_on_a_narrow_terminal(tmp_path):
    """Labels of any length, eight columns: what does not fit in 80 is folded by the terminal, never cut."""
    names = [f"calibration-pose-with-a-long-name-{i}" for i in range(4)]
    rows = [
        "label,w,x,y,z",
        f"{names[0]},1,0,0,0",
        f"{names[1]},0.6,0.8,0,0",
        f"{names[2]},0,1,0,0",
        f"{names[3]},0,0,1,0",
    ]
    (tmp_path / "scan.csv").write_text("\n".join(rows))
    text = "timelaw: 1\nname: narrow\nroute: {orientations: {file: scan.csv}}\nlimits: {velocity: [61.2345 deg/s, 60 deg/s, 60 deg/s], jerk: 601.234 deg/s^3}\n"
    (tmp_path / "narrow.yaml").write_text(text)
    command = [sys.executable, "-m", "timelaw", "design", tmp_path / "narrow.yaml", "-o", tmp_path / "out"]
    shown = at_a_terminal([str(part) for part in command])
    assert "…" not in shown
    assert "61.2345" in shown
    assert "601.234" in shown
    assert "acceleration" not in shown
    assert any(f"{a}–{b}" in shown for a in names for b in names)
    tour = at_a_terminal([sys.executable, "-m", "timelaw", "tour", str(tmp_path / "narrow.yaml")])
    assert "…" not in tour
    assert all(name in tour for name in names)


@pytest.mark.parametrize(
    ("limits", "shown", "unit"),
    [
        ("{velocity: 60 °/s, jerk: 10 rad/s^3}", "572.958", "deg/s³"),
        ("{velocity: 10 rpm, jerk: 600 deg/s^3}", "60", "deg/s"),
    ],
)
def test_the_terminal_speaks_the_files_units_and_names_them(tmp_path, limits, shown, unit):
    route = "{orientations: {list: [[1,0,0,0], [0.6,0.8,0,0]]}}"
    text = f"timelaw: 1\nname: u\nroute: {route}\nlimits: {limits}\neasing: {{degree: 9}}\n"
    (tmp_path / "u.yaml").write_text(text)
    done = timelaw("design", tmp_path / "u.yaml", "-o", tmp_path / "out")
    rows = [line.split() for line in done.stderr.splitlines()]
    assert [unit, shown] in [row[1:3] for row in rows]
    verified = timelaw("verify", tmp_path / "out" / "law.json")
    assert "rad/s³" in verified.stderr  # as the law file has it
    assert "deg" not in verified.stderr


def test_what_is_wrong_with_a_command_line_is_said_once():
    assert timelaw().stderr.startswith("timelaw: Missing command.")
    assert timelaw("design").stderr.startswith("timelaw: design: Missing argument 'PROBLEM'.")
    assert timelaw("nothing").stderr.startswith("timelaw: No such command 'nothing'.")


def test_a_file_of_another_kind_gets_one_sentence(designed):
    law = designed[0] / "results" / "first-steps" / "law.json"
    study, problem = PROBLEMS / "studies" / "calm-front.yaml", PROBLEMS / "first-steps.yaml"
    cases = {
        (
            "design",
            study,
        ): f"{study}:1:1: this is a study file, not a problem file; use it with: timelaw sweep {study}",
        (
            "tour",
            study,
        ): f"{study}:1:1: this is a study file, not a problem file; use it with: timelaw sweep {study}",
        (
            "sweep",
            problem,
        ): f"{problem}:1:1: this is a problem file, not a study file; use it with: timelaw design {problem}",
        (
            "design",
            law,
        ): f"{law}:1:1: this is a law file, not a problem file; use it with: timelaw verify {law}",
        ("sweep", law): f"{law}:1:1: this is a law file, not a study file; use it with: timelaw verify {law}",
    }
    for (command, path), message in cases.items():
        done = timelaw(command, path)
        assert done.returncode == 2
        assert done.stderr == f"timelaw: {message}\n"


def test_json_says_what_was_gained_and_null_for_what_has_no_bound(tmp_path):
    route = "{orientations: {list: [[1,0,0,0], [0.6,0.8,0,0]]}}"
    limits = "{velocity: 60 deg/s, acceleration: 100 deg/s^2}"
    base = f"timelaw: 1\nroute: {route}\nlimits: {limits}\n"
    (tmp_path / "a.yaml").write_text(base + "name: a\neasing: {basis: double-s}\nnodes: {continuity: 1}\n")
    (tmp_path / "b.yaml").write_text(base + "name: b\nobjective: {minimise: energy, total_time: 9 s}\n")
    first, second = (
        json.loads(timelaw("design", tmp_path / f"{n}.yaml", "-o", tmp_path / n, "--json").stdout)
        for n in "ab"
    )
    assert first["laws"][0]["smoothness"] is None
    assert "objective" not in first
    assert second["objective"]["minimise"] == "energy"
    assert 0 < second["objective"]["gained"] < 1
    assert second["objective"]["value"] == pytest.approx(
        (1 - second["objective"]["gained"]) * second["objective"]["quintic_at_equal_times"]
    )
