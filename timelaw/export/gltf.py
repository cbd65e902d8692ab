"""glTF 2.0 (binary): the body as a box with coloured axes, turned and moved by an animation.

glTF has quaternions x y z w and y upwards; a node above the body turns our z there, so that programs with z
upwards, such as Blender, show world coordinates as they are here.
"""

import json
import struct
from typing import Any

import numpy as np

from timelaw import __version__
from timelaw.errors import Fault, InputError
from timelaw.export.exporter import Exporter, Options
from timelaw.export.gltf_body import list_parts
from timelaw.export.samples import list_instants
from timelaw.motion import QuaternionLaw
from timelaw.numerics.array import Array
from timelaw.numerics.quaternion import angle_between

FLOAT, UNSIGNED_SHORT = 5126, 5123
VERTICES, INDICES = 34962, 34963
MAGIC, VERSION, JSON_CHUNK, BINARY_CHUNK = 0x46546C67, 2, 0x4E4F534A, 0x004E4942
Z_UP = [-float(np.sqrt(0.5)), 0.0, 0.0, float(np.sqrt(0.5))]  # a quarter turn about x
BETWEEN = (0.25, 0.5, 0.75)  # where the interpolation is compared with the law


class _Buffer:
    """The binary part, and what of it is what."""

    def __init__(self) -> None:
        self.data = bytearray()
        self.views: list[dict[str, Any]] = []
        self.accessors: list[dict[str, Any]] = []

    def add(self, values: Array, target: int | None = None, *, bounded: bool = False) -> int:
        """Append an array, and return the number of its accessor."""
        whole = target == INDICES
        stored = np.ascontiguousarray(values, dtype="<u2" if whole else "<f4")
        view = {"buffer": 0, "byteOffset": len(self.data), "byteLength": stored.nbytes}
        self.views.append(view if target is None else view | {"target": target})
        self.data += stored.tobytes() + bytes(-stored.nbytes % 4)
        width = 1 if stored.ndim == 1 else stored.shape[1]
        accessor: dict[str, Any] = {
            "bufferView": len(self.views) - 1,
            "componentType": UNSIGNED_SHORT if whole else FLOAT,
            "count": len(stored),
            "type": {1: "SCALAR", 3: "VEC3", 4: "VEC4"}[width],
        }
        if bounded:
            rows = stored.reshape(len(stored), width).astype(float)
            accessor |= {"min": rows.min(axis=0).tolist(), "max": rows.max(axis=0).tolist()}
        self.accessors.append(accessor)
        return len(self.accessors) - 1


def sample_keys(law: QuaternionLaw, rate: float) -> tuple[Array, Array]:
    """Times (m,) as single precision has them, strictly increasing, and quaternions (m, 4) of like signs."""
    times = np.unique(list_instants(law, rate).astype(np.float32)).astype(float)
    q = law(np.minimum(times, law.duration))
    signs = np.where(np.sum(q[1:] * q[:-1], axis=1) < 0, -1.0, 1.0)
    return times, q * np.concatenate([[1.0], np.cumprod(signs)])[:, None]


def measure_error(law: QuaternionLaw, times: Array, q: Array) -> float:
    """The largest angle [rad] between the law and the spherical interpolation that glTF prescribes."""
    worst = 0.0
    angle = np.arccos(np.clip(np.sum(q[1:] * q[:-1], axis=1), -1.0, 1.0))[:, None]
    for u in BETWEEN:
        with np.errstate(divide="ignore", invalid="ignore"):
            parts = np.sin([(1 - u) * angle, u * angle]) / np.sin(angle)
        first, last = np.where(angle > 0, parts, [[[1 - u]], [[u]]])
        t = np.clip((1 - u) * times[:-1] + u * times[1:], 0.0, law.duration)
        worst = max(worst, float(np.max(angle_between(first * q[:-1] + last * q[1:], law(t)))))
    return worst


def write_gltf(law: QuaternionLaw, options: Options) -> dict[str, bytes]:
    """One scene with one animation, all in one file; its largest error stands in `asset.extras`."""
    buffer = _Buffer()
    materials: list[dict[str, Any]] = []
    primitives: list[dict[str, Any]] = []
    for part in list_parts(law.shape):
        primitives.append(
            {
                "attributes": {
                    "POSITION": buffer.add(part.positions, VERTICES, bounded=True),
                    "NORMAL": buffer.add(part.normals, VERTICES),
                },
                "indices": buffer.add(part.indices, INDICES),
                "material": len(materials),
            }
        )
        surface = {"baseColorFactor": [*part.colour, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.8}
        materials.append({"name": part.name, "pbrMetallicRoughness": surface})
    times, q = sample_keys(law, options.rate)
    outputs = {"rotation": np.roll(q, -1, axis=1)}
    if law.travels:
        outputs["translation"] = law.place(np.minimum(times, law.duration))
    clock = buffer.add(times, bounded=True)
    samplers = [
        {"input": clock, "output": buffer.add(values), "interpolation": "LINEAR"}
        for values in outputs.values()
    ]
    channels = [{"sampler": index, "target": {"node": 1, "path": path}} for index, path in enumerate(outputs)]
    error = measure_error(law, times, q)
    if not np.isfinite(error):
        raise InputError(Fault("the law has no orientation at some instant", "", law.name))
    extras = {"largestAngleToLaw_rad": error}
    document = {
        "asset": {"version": "2.0", "generator": f"timelaw {__version__}", "extras": extras},
        "scene": 0,
        "scenes": [{"name": law.name, "nodes": [0]}],
        "nodes": [
            {"name": "world, z up", "rotation": Z_UP, "children": [1]},
            {"name": "body", "mesh": 0, "rotation": outputs["rotation"][0].tolist()},
        ],
        "meshes": [{"name": "body", "primitives": primitives}],
        "materials": materials,
        "animations": [{"name": law.name, "channels": channels, "samplers": samplers}],
        "accessors": buffer.accessors,
        "bufferViews": buffer.views,
        "buffers": [{"byteLength": len(buffer.data)}],
    }
    return {".glb": _pack(document, bytes(buffer.data))}


def _pack(document: dict[str, Any], data: bytes) -> bytes:
    """The two chunks of a binary glTF, each of a multiple of four bytes."""
    text = json.dumps(document, allow_nan=False).encode()
    text += b" " * (-len(text) % 4)
    data += bytes(-len(data) % 4)
    length = 12 + 8 + len(text) + 8 + len(data)
    head = struct.pack("<III", MAGIC, VERSION, length) + struct.pack("<II", len(text), JSON_CHUNK)
    return head + text + struct.pack("<II", len(data), BINARY_CHUNK) + data


GLTF = Exporter(
    "motion.glb",
    write_gltf,
    "glTF 2.0 animation of a box with axes x red, y green, z blue, as Blender reads it; its error is stated",
    "rates; single precision, and spherical interpolation between the samples",
)
