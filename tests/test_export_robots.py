"""Robots' formats: ROS 2 messages by their definitions, TUM trajectories by evo, glTF by pygltflib and trimesh."""

import io
import json
import shutil
import struct
import subprocess

import numpy as np
import pytest
import trimesh
import yaml
from evo.tools.file_interface import read_tum_trajectory_file
from pygltflib import GLTF2
from rosbags.typesys import Stores, get_typestore
from scipy.spatial.transform import Rotation, Slerp

from tests.laws import SHIPPED, angles_between, law_of, quarter_turn
from timelaw.export.exporter import Options
from timelaw.export.registry import EXPORTERS
from timelaw.export.ros import write_number

TYPES = get_typestore(Stores.ROS2_HUMBLE)
KIND = "trajectory_msgs/msg/MultiDOFJointTrajectory"


def build(kind, data):
    """A message of the definitions from plain data, as `ros2 topic pub` fills one: each field by its type."""
    fields = TYPES.fielddefs[kind][1]
    assert set(data) <= {name for name, _ in fields}, kind
    return TYPES.types[kind](**{name: fill(hint, data[name]) for name, hint in fields})


def fill(hint, value):
    node, detail = hint
    if node.name == "NAME":
        return build(detail, value)
    if node.name == "BASE":
        wanted = {"float64": float, "string": str}.get(detail[0], int)
        assert type(value) is wanted, (detail, value)
        return value
    return [fill(detail[0], item) for item in value]


@pytest.mark.parametrize("name", [*SHIPPED, "mixed", "points"])
def test_ros_takes_the_message_and_gives_the_motion_in_world_axes(name):
    law = law_of(name)
    text = "".join(EXPORTERS["ros"].write(law, Options(5.0))[".yaml"])
    message = build(KIND, yaml.load(text, yaml.CSafeLoader))
    again = TYPES.deserialize_cdr(TYPES.serialize_cdr(message, KIND), KIND)
    assert (again.joint_names, again.header.frame_id) == (["body"], "world")
    points = again.points
    ticks = [p.time_from_start.sec * 10**9 + p.time_from_start.nanosec for p in points]
    assert np.all(np.diff(ticks) > 0)
    t = (np.array(ticks) / 1e9).clip(0, law.duration)
    turns = [p.transforms[0].rotation for p in points]
    q = np.array([[r.w, r.x, r.y, r.z] for r in turns])
    assert np.max(angles_between(q, law(t))) < 1e-8
    world = Rotation.from_quat(law(t), scalar_first=True)
    for field, order in (("velocities", 1), ("accelerations", 2)):
        given = [getattr(p, field)[0] for p in points]
        angular = np.array([[g.angular.x, g.angular.y, g.angular.z] for g in given])
        np.testing.assert_allclose(angular, world.apply(law(t, order)), atol=1e-6)
        linear = np.array([[g.linear.x, g.linear.y, g.linear.z] for g in given])
        np.testing.assert_allclose(linear, law.place(t, order) if law.travels else 0 * linear, atol=1e-6)


def test_world_axes_are_not_body_axes_where_it_shows():
    """A body that is turned by a quarter about z, and then turns about its own x, turns about y of the world."""
    law = law_of("mixed")
    t = 4.0
    assert np.max(np.abs(law.rotation(t) @ law(t, 1) - law(t, 1))) > 0.05


@pytest.mark.parametrize("value", [1e-05, -2.5e-17, 1e22, 0.0, 1.0, 123456.789])
def test_numbers_are_numbers_in_yaml_1_1(value):
    assert yaml.safe_load(write_number(value)) == value
    assert isinstance(yaml.safe_load(write_number(value)), float)


@pytest.mark.parametrize("name", [*SHIPPED, "mixed", "points"])
def test_evo_reads_the_trajectory(name, tmp_path):
    law = law_of(name)
    path = tmp_path / "trajectory.tum"
    path.write_text("".join(EXPORTERS["tum"].write(law, Options(20.0))[".tum"]))
    found = read_tum_trajectory_file(path)
    t = found.timestamps.clip(0, law.duration)
    assert found.check()[0]
    assert np.max(angles_between(found.orientations_quat_wxyz, law(t))) < 1e-13
    np.testing.assert_allclose(found.positions_xyz, law.place(t) if law.travels else 0, atol=1e-14)


def read_accessor(gltf, number):
    """Numbers of an accessor, by the specification."""
    accessor = gltf.accessors[number]
    view = gltf.bufferViews[accessor.bufferView]
    kind, size = {5126: ("f", 4), 5123: ("H", 2)}[accessor.componentType]
    width = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[accessor.type]
    count = accessor.count * width
    data = gltf.binary_blob()[view.byteOffset : view.byteOffset + count * size]
    return np.array(struct.unpack(f"<{count}{kind}", data)).reshape(accessor.count, width)


@pytest.mark.parametrize("name", [*SHIPPED, "points"])
def test_gltf_animates_the_body_within_the_error_that_it_states(name, tmp_path):
    law = law_of(name)
    path = tmp_path / "motion.glb"
    path.write_bytes(EXPORTERS["gltf"].write(law, Options(30.0))[".glb"])
    gltf = GLTF2().load(path)
    (animation,) = gltf.animations
    channels = {c.target.path: animation.samplers[c.sampler] for c in animation.channels}
    assert set(channels) == {"rotation", "translation"} if law.travels else {"rotation"}
    sampler = channels["rotation"]
    times, q = read_accessor(gltf, sampler.input)[:, 0], read_accessor(gltf, sampler.output)
    assert np.all(np.diff(times) > 0)
    assert gltf.accessors[sampler.input].max == [pytest.approx(law.duration, rel=1e-7)]
    assert np.all(np.sum(q[1:] * q[:-1], axis=1) > 0)
    np.testing.assert_allclose(np.linalg.norm(q, axis=1), 1, atol=1e-6)
    t = np.linspace(0, times[-1], 2000)
    between = Slerp(times, Rotation.from_quat(q))(t).as_quat(scalar_first=True)
    worst = np.max(angles_between(between, law(t.clip(0, law.duration))))
    stated = gltf.asset.extras["largestAngleToLaw_rad"]
    assert worst <= stated + 1e-6  # single precision
    assert stated < 1e-2
    if law.travels:
        np.testing.assert_allclose(
            read_accessor(gltf, channels["translation"].output),
            law.place(times.clip(0, law.duration)),
            atol=1e-6,
        )


VALIDATE = """
const v = require("gltf-validator"), fs = require("fs");
v.validateBytes(new Uint8Array(fs.readFileSync(process.argv[1]))).then((r) => console.log(JSON.stringify(r.issues)));
"""


def find_validator():
    """Whether Khronos' validator can be called: an npm package that nothing here installs."""
    node = shutil.which("node")
    found = node and subprocess.run(
        [node, "-e", 'require("gltf-validator")'], capture_output=True, check=False
    )
    return bool(found) and found.returncode == 0


@pytest.mark.skipif(not find_validator(), reason="there is no gltf-validator")
@pytest.mark.parametrize("name", ["paper", "points"])
def test_khronos_validator_finds_nothing(name, tmp_path):
    path = tmp_path / "motion.glb"
    path.write_bytes(EXPORTERS["gltf"].write(law_of(name), Options(30.0))[".glb"])
    done = subprocess.run(["node", "-e", VALIDATE, path], capture_output=True, text=True, check=True)
    issues = json.loads(done.stdout)
    assert issues["messages"] == []


def test_gltf_shows_a_box_with_coloured_axes_and_z_upwards():
    scene = trimesh.load(
        io.BytesIO(EXPORTERS["gltf"].write(quarter_turn(), Options(30.0))[".glb"]), file_type="glb"
    )
    meshes = scene.geometry.values()
    assert len(meshes) == 4
    for mesh in meshes:
        mesh.merge_vertices(merge_norm=True, merge_tex=True)
        assert mesh.is_watertight
        assert mesh.volume > 0  # faces look outwards
    colours = [mesh.visual.material.main_color[:3].tolist() for mesh in meshes]
    assert [int(np.argmax(c)) for c in colours[1:]] == [0, 1, 2]
    extents = sorted(next(iter(meshes)).extents.tolist())
    assert extents == [0.5, 0.75, 1.0]
    for axis, mesh in enumerate(list(meshes)[1:]):
        assert int(np.argmax(mesh.bounds[1])) == axis
    frame = scene.graph.get("world, z up")[0]
    np.testing.assert_allclose(frame[:3, :3] @ [0, 0, 1], [0, 1, 0], atol=1e-12)
