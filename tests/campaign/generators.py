"""Seeded problems: a kind of problem over a scene, as the text of a problem file."""

import json
from dataclasses import dataclass

import numpy as np

from tests.campaign import least, settings, times
from tests.campaign.attitude import about
from tests.campaign.beziers import draw_problem
from tests.campaign.legs import lay
from tests.campaign.passing import ask_to_pass
from tests.campaign.scenes import NEARLY, SCENES, random_axis, written
from tests.campaign.spec import read_spec

ORDER = (
    "timelaw",
    "name",
    "route",
    "body",
    "limits",
    "motion",
    "nodes",
    "segments",
    "easing",
    "objective",
    "baselines",
)


@dataclass(frozen=True)
class Case:
    """A problem text; `number` and `seed` give it again, whatever the count."""

    seed: int
    number: int
    generator: str
    text: str


class Draft:
    """A problem in the making."""

    def __init__(self, rng, small: bool, name: str):
        self.rng, self.small = rng, small
        self.r = settings.continuity(rng)
        self.data: dict = {"timelaw": 1, "name": name}

    def node(self, key: str, value) -> None:
        self.data.setdefault("nodes", {})[key] = value

    def rule(self, label: str, rule: dict) -> None:
        self.data.setdefault("nodes", {}).setdefault("at", {}).setdefault(label, {}).update(rule)

    def limit(self, least_r: int = 1, **how) -> None:
        """Limits of rates, for a continuity of at least that."""
        self.r = max(self.r, least_r)
        self.data["limits"] = settings.limits(self.rng, self.r, **how)

    def ease(self, *, timed: bool = False) -> None:
        """An easing that suits limits and continuity, which is written down too."""
        jerk = "jerk" in self.data["limits"]
        self.data["easing"] = settings.easing(self.rng, self.r, self.small, timed=timed, jerk=jerk)
        if self.r != 2 or self.rng.random() < 0.3:
            self.node("continuity", self.r)

    def spec(self):
        return read_spec(write(self.data))


def write(data: dict) -> str:
    """The text of a problem file, a line for each part."""
    lines = [f"{key}: {json.dumps(data[key])}" for key in ORDER if data.get(key) not in (None, {})]
    return "\n".join(lines).replace('"timelaw": 1', "timelaw: 1") + "\n"


def least_time(draft: Draft) -> None:
    draft.limit()
    draft.ease()


def by_axis(draft: Draft) -> None:
    draft.limit(by_axis=0.9)
    draft.ease()


def snap(draft: Draft) -> None:
    draft.limit(3, snap=True)
    draft.ease()
    if draft.small:
        draft.data["easing"] = {"basis": "polynomial"}  # the cheapest by far


def torque(draft: Draft) -> None:
    """Torque and momentum, from outside or of wheels, beside rates or alone."""
    rng = draft.rng
    kind = rng.integers(3)
    draft.data["body"] = settings.body(rng, wheels=kind > 0, spin=kind == 2)
    draft.limit()
    if rng.random() < 0.4:
        draft.data["limits"] = {}
    draft.data["limits"]["torque"] = settings.bound(rng, 10 ** rng.uniform(-2, 2), "N*m", 0.4)
    if rng.random() < 0.6:
        draft.data["limits"]["momentum"] = settings.bound(rng, 1.0 + 10 ** rng.uniform(-1, 2), "N*m*s", 0.0)
    draft.ease()


def rules(draft: Draft) -> None:
    """Dwells, forced stops, slower legs."""
    draft.limit()
    rng = draft.rng
    if rng.random() < 0.4:
        draft.node("dwell", str(rng.choice(["0.5 s", "1e-6 s", "3 s", "0 s"])))
    labels = labels_of(draft)
    for label in labels[1:-1]:
        roll = rng.random()
        if roll < 0.25:
            draft.rule(label, {"dwell": str(rng.choice(["2 s", "1e-3 s", "0 s"]))})
        elif roll < 0.4 and not draft.spec().searched:
            draft.rule(label, {"stop": True})
        elif roll < 0.55:
            draft.rule(label, {"limits": slower(draft)})
    spec = draft.spec()
    if not spec.searched and len(labels) > 1 and rng.random() < 0.4:
        draft.data["segments"] = {f"{labels[0]}-{labels[1]}": {"limits": slower(draft)}}
    draft.ease()


def slower(draft: Draft) -> dict:
    """One of the limits, a norm, tighter or looser than the general one."""
    name = str(draft.rng.choice(list(draft.data["limits"])))
    spec = draft.spec()
    size = float(np.min(spec.limits[name])) * float(10 ** draft.rng.uniform(-1.5, 0.5))
    return {name: settings.quantity(draft.rng, size, settings.RATE_UNITS[name])}


def labels_of(draft: Draft) -> list[str]:
    """Labels by the tour where it is given, else all there are; none of a lattice."""
    draft.data.setdefault("limits", {"velocity": "1 rad/s"})
    spec = draft.spec()
    return spec.tour if isinstance(spec.tour, list) else list(spec.points)


def durations(draft: Draft) -> None:
    draft.limit()
    draft.ease(timed=True)
    spec = draft.spec()
    legs = times.known_legs(spec)
    if legs:
        draft.data["segments"] = times.durations(draft.rng, spec, legs)


def arrivals(draft: Draft) -> None:
    draft.limit()
    if draft.rng.random() < 0.3:
        draft.node("dwell", "0.25 s")
    draft.ease(timed=True)
    spec = draft.spec()
    legs = times.known_legs(spec)
    for label, rule in (times.arrivals(draft.rng, spec, legs) if legs else {}).items():
        draft.rule(label, rule)


def effort(draft: Draft) -> None:
    """The least of jerk, energy, torque, snap or the used part, in a given time."""
    rng = draft.rng
    what = str(rng.choice(["jerk", "energy", "torque", "snap", "peak"]))
    if what == "torque":
        draft.data["body"] = settings.body(rng, wheels=bool(rng.random() < 0.3), spin=False)
    draft.limit({"jerk": 2, "snap": 3}.get(what, 1))
    draft.ease(timed=True)
    spec = draft.spec()
    draft.data["objective"] = {
        "minimise": what,
        "total_time": times.total_time(rng, spec, times.known_legs(spec)),
    }


def weight(draft: Draft) -> None:
    """Time against jerk, energy or snap."""
    what = str(draft.rng.choice(["jerk", "energy", "snap"]))
    draft.limit({"jerk": 2, "snap": 3}.get(what, 1))
    draft.ease(timed=True)
    draft.data["objective"] = {"minimise": what, "weight": float(10 ** draft.rng.uniform(-3, 3))}


def moving(draft: Draft) -> None:
    """The motion begins or ends at speed."""
    draft.limit()
    draft.ease(timed=True)
    spec = draft.spec()
    legs = times.known_legs(spec)
    if legs and not spec.closed:
        for which, rates in times.end_rates(draft.rng, spec, legs).items():
            draft.node(which, rates)
    if draft.r >= 2 and draft.rng.random() < 0.15:
        draft.data["objective"] = {"minimise": "jerk", "total_time": times.total_time(draft.rng, spec, [])}


def boundary(draft: Draft) -> None:
    """A node just before, on, or after the end of a phase of the double-S over the whole run."""
    rng = draft.rng
    draft.limit(by_axis=0.0)
    axis, theta = random_axis(rng), float(rng.uniform(0.1, 6.0))
    draft.data["route"] = {"orientations": written(about(axis, np.array([0.0, theta / 2, theta])))}
    w, a, j, _ = lay(draft.spec(), ["1", "2"], draft.spec().points)[0].ceiling.rates
    phases = np.cumsum(least.phase_times(theta, w, a, j))
    edge = least.angle_after(float(rng.choice(phases[:4])), theta, w, a, j) / theta
    edge = min(max(edge * (1 + float(rng.choice(NEARLY)) * float(rng.choice([-1, 1]))), 1e-4), 0.5)
    places = np.array([0.0, edge, 1.0]) if rng.random() < 0.7 else np.array([0.0, edge, 1 - edge, 1.0])
    steps = np.unique(places * theta)
    if np.max(np.diff(steps)) < 3.1 and np.min(np.diff(steps)) > 2e-6:
        draft.data["route"] = {"orientations": written(about(axis, steps))}
    draft.ease()


def passing(draft: Draft) -> None:
    """Any other kind of problem, past the nodes without a stop."""
    kinds = (least_time, by_axis, snap, torque, rules, durations, arrivals, effort, weight, moving)
    kinds[int(draft.rng.choice(len(kinds), p=[0.3, 0.1, 0.05, 0.15, 0.1, *[0.06] * 5]))](draft)
    draft.data.pop("easing", None)
    nodes = draft.data.get("nodes", {})
    if nodes.get("continuity", 2) > 3:
        nodes["continuity"] = 3
    draft.data["motion"] = ask_to_pass(draft.rng, draft.data)


def bezier(draft: Draft) -> None:
    """Along Bézier curves."""
    draw_problem(draft)


KINDS = {
    f.__name__: (f, share)
    for f, share in (
        (least_time, 6),
        (by_axis, 2),
        (snap, 2),
        (torque, 4),
        (rules, 3),
        (durations, 4),
        (arrivals, 4),
        (effort, 4),
        (weight, 2),
        (moving, 4),
        (boundary, 3),
        (passing, 6),
        (bezier, 0),  # drawn by itself: what is drawn of the others stays as it is
    )
}
SELDOM = {"snap": 0.5, "passing": 2}  # among small cases: these cost most
CURVED = 0.05  # of the cases
WITHOUT_SCENE = ("boundary", "bezier")
BASELINES: tuple[list[str], ...] = (["quintic", "double-s"], ["quintic"], ["double-s"], [])


def make_case(seed: int, number: int, *, small: bool = False, kind: str | None = None) -> Case:
    """Case `number` of a seed, of one kind if it is named."""
    rng = np.random.default_rng([seed, number, int(small)])
    drawn, scene = _choose(rng, KINDS, SELDOM if small else {}), _choose(rng, SCENES, {})
    curved = np.random.default_rng([seed, number, int(small), len(KINDS)]).random() < CURVED
    kind = kind or ("bezier" if curved else drawn)
    draft = Draft(rng, small, f"case-{seed}-{number}")
    if kind != "bezier":
        draft.data["route"] = SCENES[scene][0](rng, small)
        if kind not in ("moving", "boundary") and scene in ("scatter", "body_axes") and rng.random() < 0.15:
            draft.data["route"]["closed"] = True
    KINDS[kind][0](draft)
    if kind != "bezier" and rng.random() < 0.4:
        draft.data["baselines"] = BASELINES[int(rng.integers(len(BASELINES)))]
    return Case(seed, number, kind if kind in WITHOUT_SCENE else f"{kind}/{scene}", write(draft.data))


def _choose(rng, registry, instead) -> str:
    shares = np.array([instead.get(name, share) for name, (_, share) in registry.items()], dtype=float)
    return str(rng.choice(list(registry), p=shares / shares.sum()))
