"""The report: self-contained, the same every time, and saying what the certificates say."""

import html
import re
from dataclasses import replace
from math import inf

import numpy as np
import pytest

from tests.cases import reference
from tests.oracles import QUINTIC_PEAKS, smoothstep_duration
from timelaw import design
from timelaw.certificate import certify
from timelaw.certificate.continuity import check_continuity
from timelaw.certificate.effort import measure_effort
from timelaw.easing import Profile
from timelaw.report import list_law_rows, render_report
from timelaw.report.figures.style import OPTIMISED, QUINTIC
from timelaw.report.outcome import measure_gain
from timelaw.report.summary import join_alike, list_run_rows, measure_all_efforts
from timelaw.report.tour_text import describe_merits

DIGEST = "sha256:0"
DEG = np.pi / 180


@pytest.fixture(scope="module")
def files(paper):
    return render_report(paper, DIGEST)


def test_the_verdict_comes_first_and_the_numbers_are_the_laws(files):
    page = files["report.html"]
    verdict = page.index("Certified.")
    assert verdict < page.index("Laws side by side")
    text = re.sub(r"\s+", " ", page[verdict : verdict + 600])
    assert (
        "28.8289 s: 30.1 % less than the paper's quintic, 4.45 % above the physical limit of 27.6 s" in text
    )
    for number in ("41.2500", "27.6000", "29.7000"):
        assert number in page
    assert DIGEST in page


def test_a_law_that_breaks_a_limit_is_called_so(paper):
    law = replace(paper.optimised.law, limits={**paper.optimised.law.limits, "jerk": 1.0})
    broken = replace(paper, optimised=replace(paper.optimised, law=law, certificate=certify(law)))
    page = render_report(broken, DIGEST)["report.html"]
    assert "Not certified." in page
    assert "over the limit of 1 rad/s³" in page


def test_rows(paper):
    rows = {row.name: row for row in list_law_rows(paper)}
    assert rows["quintic"].to_quintic == pytest.approx(1)
    assert rows["double-S"].to_limit == pytest.approx(1)
    assert rows["optimised"].to_limit == pytest.approx(1.0445, abs=1e-3)
    assert all(row.holds for row in rows.values())
    assert [run.count for run in list_run_rows(paper)] == [5, 3]


def test_names_from_files_are_escaped(paper):
    segment = replace(paper.optimised.law.segments[0], origin="<script>alert(1)</script>")
    law = replace(paper.optimised.law, segments=(segment, *paper.optimised.law.segments[1:]))
    changed = replace(paper, optimised=replace(paper.optimised, law=law, certificate=certify(law)))
    files = render_report(changed, DIGEST)
    assert all("<script>alert" not in text for text in files.values())


# What the sections say, by values


def made(tmp_path, text, name="report"):
    path = tmp_path / f"{name}.yaml"
    easing = "" if "easing" in text or "motion" in text else "easing: {degree: 9}\n"
    path.write_text(f"timelaw: 1\nname: {name}\n{text}{easing}")
    return design(path)


def page_of(designed):
    return report_files_text(render_report(designed, DIGEST)["report.html"])


def report_files_text(page):
    """The page's text, its pictures and tags left out, blanks as one."""
    bare = re.sub(r"<svg.*?</svg>|<style.*?</style>", " ", page, flags=re.S)
    return re.sub(r"\s+", " ", html.unescape(re.sub(r"<[^>]+>", " ", bare)))


def rows_of(page, heading):
    """The cells of the first table that has a heading."""
    for table in re.findall(r"<table.*?</table>", page, flags=re.S):
        if heading in table:
            rows = re.findall(r"<tr.*?</tr>", table, flags=re.S)
            return [
                [report_files_text(c).strip() for c in re.findall(r"<t[hd].*?</t[hd]>", r, flags=re.S)]
                for r in rows
            ]
    raise AssertionError(heading)


LIST = "route: {orientations: {list: [[1,0,0,0], [0.8660254037844386,0.5,0,0], [0.5,0.8660254037844386,0,0], [0,0,1,0]]}}\n"
LIMITS_60 = "limits: {velocity: 60 deg/s, acceleration: 120 deg/s^2, jerk: 600 deg/s^3}\n"


def test_a_given_order_is_not_judged(tmp_path):
    """Neither `given` nor a list of labels is called too long, and what is best in it is said."""
    text = page_of(reference("first-steps"))
    assert "The order of visits is the one given, 333.841° in all." in text
    assert "too long" not in text
    listed = made(
        tmp_path, "route: {orientations: {lattice: tesseract}, tour: [1, 2, 3, 4, 5, 6, 7, 8]}\n" + LIMITS_60
    )
    assert "too long" not in page_of(listed)
    shortest = made(tmp_path, "route: {orientations: {lattice: tesseract}, tour: shortest}\n" + LIMITS_60)
    assert "No tour is shorter" in page_of(shortest)


def test_the_report_and_the_tour_command_say_the_same_of_a_searched_tour():
    designed = reference("gimbal-600-cell")
    (line,) = [describe_merits(designed.tour)[0]]
    assert line[0].upper() + line[1:] in page_of(designed)


def test_what_an_easing_costs_is_said_with_what_it_gives_and_the_key_that_changes_it(tmp_path):
    text = page_of(reference("gimbal-600-cell"))
    assert "The chosen easing, polynomial of degree 9, costs 5.93 % against the double-S of 22.6281 s, which continuity 2 allows; for that its jerk does not jump inside the legs; the key \"easing\" changes it, as in {basis: double-s} or {basis: auto, within: 1 %}." in text  # fmt: skip
    exact = made(tmp_path, LIST + LIMITS_60 + "easing: {basis: double-s}\n")
    assert "costs" not in page_of(exact)
    cubic = made(
        tmp_path,
        LIST + LIMITS_60 + "easing: {basis: spline, degree: 3, intervals: 8}\nnodes: {continuity: 2}\n",
    )
    assert "does not jump inside the legs" not in page_of(cubic)
    third = made(tmp_path, LIST + LIMITS_60 + "nodes: {continuity: 3}\n")
    assert "against the physical limit of" in page_of(third)
    assert "continuity 3 only lets a law come near to" in page_of(third)


def test_other_objectives_say_what_was_gained_at_equal_time():
    """Against the quintic stretched to the same times of arrival, by its closed form 720 θ²/T⁵ leg by leg."""
    designed = reference("camera-scan")
    arrivals, theta = (0.0, 3.0, 5.0, None, 16.0), designed.route.angles
    least = [smoothstep_duration(QUINTIC_PEAKS, a, (30 * DEG, 40 * DEG, 120 * DEG)) for a in theta[2:]]
    times = [3.0, 2.0, *(11.0 * t / sum(least) for t in least)]
    assert arrivals[-1] == pytest.approx(sum(times))
    quintic = sum(720 * a**2 / t**5 for a, t in zip(theta, times, strict=True))
    gain = measure_gain(designed)
    assert gain.reference == pytest.approx(quintic, rel=1e-6)
    assert gain.value == pytest.approx(
        measure_effort(designed.optimised.law, designed.optimised.certificate.continuity, 3), rel=1e-9
    )
    text = page_of(designed)
    assert (
        f"Its ∫|jerk|² dt is {gain.value:.5g} rad²/s⁵, {100 * (1 - gain.value / quintic):.1f} % less than"
        in text
    )
    assert "than the paper's quintic" not in text
    for entry in designed.baselines:  # in the given times they break limits; the worst is named first
        worst = max(entry.certificate.limits, key=lambda check: check.ratio)
        assert worst.ratio > 1
        assert f"{entry.name}: {worst.limit} reaches" in text


@pytest.mark.parametrize("objective", ["jerk", "torque", "snap"])
def test_the_gain_is_measured_for_every_objective_that_is_not_time(tmp_path, objective):
    continuity = "nodes: {continuity: 3}\n" if objective == "snap" else ""
    body = "body: {inertia: [12 kg*m^2, 10 kg*m^2, 8 kg*m^2]}\n" if objective == "torque" else ""
    designed = made(
        tmp_path,
        f"{LIST}{LIMITS_60}{body}{continuity}objective: {{minimise: {objective}, total_time: 20 s}}\n",
    )
    gain = measure_gain(designed)
    text = page_of(designed)
    assert "The law takes 20 s, as asked" in text
    if objective == "snap":
        assert gain.part is None
        assert "that of the quintic has no bound" in text
    else:
        assert 0 < gain.part < 1
        assert f"{100 * gain.part:.1f} % less than" in text
    quintic = next(b for b in designed.baselines if b.name == "quintic")
    assert quintic.law.duration == pytest.approx(20, rel=1e-12)
    if objective in ("energy", "torque"):  # a column of the table, the optimised law first
        rows = rows_of(render_report(designed, DIGEST)["report.html"], gain.objective.symbol)
        column = next(k for k, heading in enumerate(rows[0]) if gain.objective.symbol in heading)
        assert rows[1][column] == f"{gain.value:.5g}"
        assert rows[2][column] == f"{gain.reference:.5g}"


def test_baselines_keep_times_of_arrival_and_stop_at_the_node_of_one(tmp_path):
    designed = made(tmp_path, LIST + LIMITS_60 + "nodes: {dwell: 0.5 s, at: {2: {time: 6 s, dwell: 0 s}}}\n")
    for entry in designed.laws:
        arrival = {leg.target: leg.end_time for leg in entry.law.legs}
        assert arrival["2"] == pytest.approx(6.0, rel=1e-9)
        assert entry.certificate.findings() == []


def test_the_effort_of_a_law_that_jumps_has_no_bound(tmp_path):
    """∫|jerk|² dt where α jumps, and of the energy where ω does: ∞ in the page, null in JSON, never 0."""
    designed = made(
        tmp_path,
        LIST
        + "limits: {velocity: 60 deg/s, acceleration: 120 deg/s^2}\nnodes: {continuity: 1}\neasing: {basis: double-s}\n",
    )
    rows = {row.name: row for row in list_law_rows(designed)}
    assert rows["optimised"].smoothness == inf
    assert rows["optimised"].to_dict()["smoothness"] is None
    assert rows["quintic"].smoothness < inf
    assert measure_all_efforts(designed)["jerk"] == measure_all_efforts(designed)["snap"] == inf
    assert measure_all_efforts(designed)["energy"] < inf
    page = render_report(designed, DIGEST)["report.html"]
    assert [row[-2] for row in rows_of(page, "to physical")][1] == "∞"
    law = replace(designed.optimised.law, segments=designed.optimised.law.segments[:1])
    jolted = replace(law.segments[0], profile=_even(law.segments[0]))
    jumping = replace(law, segments=(jolted,))
    assert measure_effort(jumping, check_continuity(jumping), 2) == inf


def test_dwells_are_no_legs_and_nodes_with_a_dwell_are_not_passed(tmp_path):
    list_ = ", ".join(
        f"[{np.cos(a)}, {np.sin(a) * (k % 2)}, {np.sin(a) * (k % 2 == 0)}, 0]"
        for k, a in enumerate(np.linspace(0.1, 1.4, 31))
    )
    designed = made(
        tmp_path, f"route: {{orientations: {{list: [{list_}]}}}}\n{LIMITS_60}nodes: {{dwell: 1 s}}\n"
    )
    law = designed.optimised.law
    assert len(law.segments) == 61
    assert len(law.legs) == 30
    assert "legs 1 to 8 of 30" in page_of(designed)
    assert "in motion" in page_of(designed)
    straight = made(tmp_path, LIST + LIMITS_60 + "nodes: {at: {2: {dwell: 1 s}}}\n")
    assert "0 of its 2 inner nodes passed without a stop" in page_of(straight)
    stopped = made(tmp_path, LIST + LIMITS_60 + "nodes: {at: {2: {stop: true}}}\n")
    assert not any(node.passed for node in stopped.optimised.certificate.continuity.nodes)
    assert [n.passed for n in made(tmp_path, LIST + LIMITS_60).optimised.certificate.continuity.nodes] == [
        False,
        True,
        False,
        False,
    ]


def bars(designed):
    """Colours of the quintic's steps and of the law's bars."""
    drawn = render_report(designed, DIGEST)["easings.svg"]
    return [c for c, how in ((QUINTIC, "stroke"), (OPTIMISED, "fill")) if f"{how}: {c}" in drawn]


def test_grey_steps_stand_wherever_the_quintic_does(tmp_path):
    assert bars(made(tmp_path, f"{LIST}{LIMITS_60}baselines: [double-s, quintic]\n")) == [QUINTIC, OPTIMISED]
    assert bars(made(tmp_path, f"{LIST}{LIMITS_60}baselines: [double-s]\n")) == [OPTIMISED]


def test_easings_are_alike_only_if_all_their_pieces_are():
    def made_of(breaks, controls):
        return Profile.from_control_points(breaks, controls, 0)

    one = made_of([0.0, 0.5, 1.0], ([0.0, 0.5], [0.5, 0.7, 1.0]))
    other = made_of([0.0, 0.5, 1.0], ([0.0, 0.5], [0.5, 0.9, 1.0]))
    later = made_of([0.0, 0.6, 1.0], ([0.0, 0.5], [0.5, 0.7, 1.0]))
    again = made_of([0.0, 0.5, 1.0], ([0.0, 0.5], [0.5, 0.7, 1.0]))
    assert len({easing.key() for easing in (one, other, later, again)}) == 3


def _even(arc):
    """The arc's angle at a constant rate."""
    return Profile.single([0.0, 1.0], 0).scaled(arc.angle, arc.duration)


def test_torque_panels_limits_of_single_legs_and_active_limits():
    """The slew: a panel each for torque and momentum; a slow leg: its own row; which limits each leg uses up."""
    slew = reference("reaction-wheel-slew")
    files = render_report(slew, DIGEST)
    assert files["rates.svg"].count('id="axes_') == 5
    assert "Torque of reaction wheels: τ = Jα + ω×H" in page_of(slew)
    wrist = reference("wrist-calibration")
    page = render_report(wrist, DIGEST)["report.html"]
    own = next(row for row in rows_of(page, "proved peak") if row[0] == "velocity on 4–3")
    assert own[1] == "30 deg/s"
    assert own[4] == "4–3"
    active = {row[0]: row[5] for row in rows_of(page, "active limits")}
    assert "velocity on 4–3" in active["4–3"].split(", ")
    # legs about (1, 1, ±1)/√3: z is half as fast as the others, so only its limits are used up
    used = {label for leg in ("1–2", "2–4", "3–7") for label in active[leg].split(", ")}
    assert used <= {"velocity z", "acceleration z", "jerk z"}
    for leg in wrist.optimised.law.legs:
        peaks = {
            f"{name} {axis}": np.max(
                np.abs(wrist.optimised.law(np.linspace(leg.start_time, leg.end_time, 4001)[1:-1], k)[:, i])
            )
            for k, name in enumerate(("velocity", "acceleration", "jerk"), 1)
            for i, axis in enumerate("xyz")
        }
        for label in set(active[leg.name].split(", ")) - {"velocity on 4–3"}:
            name, axis = label.split()
            assert peaks[label] > 0.99 * wrist.optimised.law.limits[name]["xyz".index(axis)]


def test_a_net_momentum_is_noted_with_the_limits(tmp_path):
    body = "body: {inertia: [12 kg*m^2, 10 kg*m^2, 8 kg*m^2], actuator: wheels, momentum: [0 N*m*s, 0.3 N*m*s, 0 N*m*s]}\n"
    designed = made(
        tmp_path, LIST + body + "limits: {torque: 0.4 N*m, momentum: 3 N*m*s, jerk: 20 deg/s^3}\n"
    )
    text = page_of(designed)
    assert "torque: |H| of 0.3 N·m·s counts in full" in text
    assert "momentum: |H| of 0.3 N·m·s counts in full" in text


def test_many_legs_show_all_of_them():
    designed = reference("imu-calibration-120-cell")
    files = render_report(designed, DIGEST)
    assert len(rows_of(files["report.html"], "control points of f")) == 1 + 299
    assert "of 299" in page_of(designed)
    assert "overview.svg" in files
    assert len(files["report.html"].encode()) < 3e6


def test_one_row_stands_for_solutions_that_are_shown_alike():
    rows = list_run_rows(reference("paper-24-cell"))
    again = [replace(rows[0], iterations=rows[0].iterations + 7), *rows]
    joined = join_alike(again)
    assert [run.count for run in joined] == [10, 3]
    assert joined[0].iterations == rows[0].iterations + 7
    apart = replace(rows[0], duration=rows[0].duration + 1e-4)
    assert len(join_alike([apart, *rows])) == 3


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("camera-scan", ["∫|jerk|² dt against the quintic in the same time", "16 s", "reached at 3 s", "least jerk in a total time of 16 s"]),
        ("reaction-wheel-slew", ["torque 0.1, 0.1, 0.1 N·m about x, y, z", "reaction wheels; moments of inertia about x, y, z: 12, 10, 8 kg·m²", "rests for 5 s", "time in motion against the quintic", "time against the quintic"]),
        ("wrist-calibration", ["on single legs: 4-3 at most angular velocity 30 deg/s"]),
    ],
)  # fmt: skip
def test_problem_and_gains_are_told_in_the_words_of_the_problem(name, words):
    text = page_of(reference(name))
    for word in words:
        assert word in text


@pytest.mark.campaign
def test_a_thousand_different_legs_are_a_page_below_five_megabytes(tmp_path):
    rows = np.random.default_rng(5).normal(size=(1000, 4))
    listed = ", ".join(str((q / np.linalg.norm(q)).tolist()) for q in rows)
    easing = "easing: {basis: double-s}\n"
    designed = made(tmp_path, f"route: {{orientations: {{list: [{listed}]}}}}\n{LIMITS_60}{easing}")
    assert len(render_report(designed, DIGEST)["report.html"].encode()) < 5e6
