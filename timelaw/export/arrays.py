"""Samples as arrays, for NumPy (.npz) and MATLAB (.mat)."""

import io
from typing import Any, cast

import numpy as np

from timelaw.export.dynamics import measure_momentum, measure_torque
from timelaw.export.exporter import Exporter, Options
from timelaw.export.samples import NEAR_END, label_nodes, list_grid, number_segments
from timelaw.motion import QuaternionLaw

CARRIES = (
    "arrays of time, quaternion, ω, α, jerk; place, velocity, torque, momentum where known; segment, node"
)
LOSES = "all between the samples"


def gather_arrays(law: QuaternionLaw, rate: float) -> dict[str, Any]:
    """Arrays by name: q (m, 4) scalar first, vectors (m, 3) in SI, in body axes but for places.

    `node_times` (n+1,) and `node_labels` are those of the nodes.

    Raises:
        InputError: there would be more rows than are written.
    """
    t = list_grid(law, rate)
    names = ("q", "omega", "alpha", "jerk")
    found: dict[str, Any] = {"t": t} | dict(zip(names, law.evaluate(t, range(len(names))), strict=True))
    if law.travels:
        found |= {"place": law.place(t), "velocity": law.place(t, 1)}
    if law.body is not None:
        found |= {
            "torque": measure_torque(law, t),
            "momentum": measure_momentum(law, t),
            "inertia": law.body.inertia,
        }
    return found | {
        "segment": number_segments(law, t),
        "node": np.array(label_nodes(law, t, NEAR_END / rate)),
        "node_times": np.array(law.times),
        "node_labels": np.array(law.labels),
    }


def write_npz(law: QuaternionLaw, options: Options) -> dict[str, bytes]:
    """What `numpy.load` reads, without pickles."""
    file = io.BytesIO()
    np.savez_compressed(file, allow_pickle=False, **gather_arrays(law, options.rate))
    return {".npz": file.getvalue()}


def write_mat(law: QuaternionLaw, options: Options) -> dict[str, bytes]:
    """What MATLAB's and Octave's `load` read: columns, and cells of texts."""
    from scipy.io import savemat

    arrays = gather_arrays(law, options.rate)
    for name in ("node", "node_labels"):
        arrays[name] = np.array(arrays[name], dtype=object)[:, None]
    arrays["segment"] = arrays["segment"].astype(float)
    file = io.BytesIO()
    savemat(cast(Any, file), arrays, oned_as="column", do_compression=True)
    return {".mat": file.getvalue()}


NPZ = Exporter("samples.npz", write_npz, CARRIES, LOSES)
MAT = Exporter("samples.mat", write_mat, CARRIES, LOSES)
