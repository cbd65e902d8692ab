"""What editors say of each key of problem and study files."""

from timelaw.limits import LIMITS

BOUND = "bound on the norm, or a list of three for the body axes"
AXES = "in the world; a norm, or three for the world's axes"
LIMIT_WORDS = {
    "velocity": f"angular velocity: {BOUND}",
    "acceleration": f"angular acceleration: {BOUND}",
    "jerk": f"angular jerk: {BOUND}; needs continuity 2",
    "snap": f"angular snap: {BOUND}; needs continuity 3",
    "torque": f"torque from outside, or of the wheels: {BOUND}; needs the body's inertia",
    "momentum": f"momentum of the body, or stored in the wheels: {BOUND}; needs the body's inertia",
    "linear_velocity": f"velocity of the body's origin {AXES}; Bézier curves with points only",
    "linear_acceleration": f"acceleration of the body's origin {AXES}; Bézier curves with points only",
}
WRITTEN = "how the quaternions are written: wxyz, xyzw, rotation-vector, matrix, euler, axis-angle"
SEQUENCE = "axes of Euler angles: capitals turn with the body, small letters about fixed axes, as in ZYX"
WORDS: dict[str, dict[str, str]] = {
    "Problem": {
        "timelaw": "version of the problem file: 1",
        "name": "name of the motion; results go to results/NAME/",
        "route": "which orientations are visited, and in which order; or Bézier curves",
        "body": "the rigid body: inertia and actuator for torque and momentum, shape for pictures",
        "limits": "what may never be exceeded, proved for all t; at least one",
        "nodes": "continuity, dwells, stops and times at the nodes, rates at the ends",
        "motion": "arcs (the default), stopping where the axis turns; or through, past every node",
        "segments": 'rules for single legs, by the labels at their ends: "9-6": {duration: 4 s}',
        "easing": "the functions f(τ) on the legs",
        "objective": "time (the default), or {minimise: jerk, total_time: 60 s}",
        "baselines": "laws that the report shows beside: quintic, double-s",
        "output": "rate of samples.csv, and a control cycle",
    },
    "RouteModel": {
        "orientations": "a lattice, a uniform set, a file or a list",
        "bezier": "quaternion Bézier curves that follow each other, instead of orientations",
        "tour": "the order of visits: given, a search, paper (24-cell), or a list of labels",
        "closed": "true: return to the first orientation",
        "home": "unit quaternion [w, x, y, z] from which the motion sets out, and to which it returns",
        "start": "label where a searched tour begins",
        "end": "label where a searched tour ends",
    },
    "Orientations": {
        "lattice": "vertices of a regular 4-polytope, one of each antipodal pair",
        "file": "a table, a trajectory, an attitude file or a map, relative to this file",
        "list": "orientations written out, [w, x, y, z] unless `as` says otherwise",
        "uniform": "an evenly spread set of a stated covering radius",
        "as": "how a list or table is written: wxyz, xyzw, rotation-vector, matrix, euler, axis-angle",
        "sequence": SEQUENCE,
        "unit": "of angles: deg or rad",
        "phase": "the one phase of a .ang or .ctf map that is taken",
        "only": "labels, or ranges of them such as 9-20, that are taken",
        "columns": "names of a table's columns, or their numbers counted from 1",
        "turned": "constant rotations: q becomes world ⊗ q ⊗ body",
        "symmetry": "a crystal class such as m-3m, under which orientations count as the same",
        "duplicates": "merge: keep one of those that are the same",
        "tolerance": "how near orientations count as the same",
        "precision": "how far each may be from what was meant, where the digits do not tell",
    },
    "Uniform": {"fill": "largest turn to the nearest orientation: the covering radius"},
    "Turned": {"world": "unit quaternion on the left", "body": "unit quaternion on the right"},
    "BezierModel": {
        "quaternions": "control quaternions",
        "points": "control points of the origin's place",
        "weights": "lengths of the control quaternions, 1 unless given",
        "translation": "divided: the origin is at Σ B P / |Q|²; plain: at Σ B P",
        "as": WRITTEN,
        "sequence": SEQUENCE,
        "unit": "of angles: deg or rad",
    },
    "Body": {
        "inertia": "three principal moments, or three rows of three",
        "actuator": "external (the default) or wheels: whose torque is meant",
        "momentum": "total of body and wheels, in body axes at t = 0",
        "shape": "edges of the box that pictures show",
    },
    "Limits": {name: LIMIT_WORDS[name] for name in LIMITS},
    "Nodes": {
        "continuity": "1: ω continuous; 2: α too; 3: jerk too; 4: snap too",
        "dwell": "rest at every node",
        "at": "rules for single nodes, by label",
        "start": "rates with which the motion begins, or periodic",
        "end": "rates with which the motion ends",
    },
    "NodeRule": {
        "dwell": "rest at this node",
        "stop": "true: stop here, although the body could go on",
        "time": "be there at this time",
        "limits": "on the legs that meet here, besides the general limits",
    },
    "EndRates": {
        "velocity": "about the axis of the leg, or three in body axes",
        "acceleration": "about the axis of the leg, or three in body axes",
        "jerk": "about the axis of the leg, or three in body axes",
        "periodic": "true: a closed tour that goes round and round",
    },
    "SegmentRule": {"duration": "of this leg", "limits": "on this leg, besides the general limits"},
    "Motion": {
        "kind": "arcs, or through",
        "degree": "of the rational segments, or auto",
        "pieces": "a leg, or auto",
        "deviation": "how far the body may leave the arc of its leg",
    },
    "EasingModel": {
        "basis": "auto (the default), polynomial (where a degree is given alone), spline, or double-s",
        "degree": "of polynomials or splines",
        "intervals": "of a spline on a leg",
        "within": "of auto: how near to the physical limit",
    },
    "Goal": {
        "minimise": "what is made least",
        "total_time": "a time, or a multiple of the least one: 1.5 x minimum",
        "weight": "against time, instead of a total time",
    },
    "Output": {
        "rate": "rows per second in samples.csv",
        "grid": "control cycle: the motion ends on a multiple of it",
    },
    "StudyModel": {
        "timelaw-study": "version of the study file: 1",
        "name": "name of the study; results go to results/NAME/",
        "problem": "the problem file, relative to this one",
        "vary": "keys of the problem, each with a list of values or {from, to, steps}; all combinations",
        "effort": "drawn against total time",
    },
}
