"""Samples as other programs read them: pandas, NumPy, MATLAB's format; and what they say of torque and nodes."""

import io
import tracemalloc
from itertools import islice

import numpy as np
import pandas
import pytest
from scipy.io import loadmat
from scipy.spatial.transform import Rotation

from tests.laws import LAWS, SHIPPED, law_of, quarter_turn
from timelaw.export.exporter import Options
from timelaw.export.registry import EXPORTERS
from timelaw.files import write_file
from timelaw.results_folder import write_results

RATES = (("w", 1), ("a", 2), ("j", 3))


def read_csv(law, rate=10.0):
    """By pandas, without an option."""
    text = EXPORTERS["csv"].write(law, Options(rate))[".csv"]
    return pandas.read_csv(io.StringIO("".join(text)))


@pytest.mark.parametrize("name", LAWS)
def test_pandas_reads_the_samples_without_an_option(name):
    law, table = law_of(name), read_csv(law_of(name))
    t = table["t"].to_numpy().clip(0, law.duration)
    np.testing.assert_allclose(table[["qw", "qx", "qy", "qz"]], law(t), atol=1e-14)
    for letter, order in RATES:
        values = table[[letter + axis for axis in "xyz"]].to_numpy()
        np.testing.assert_allclose(values, law(t, order), rtol=1e-9, atol=1e-9)
    assert table["t"].iloc[-1] == pytest.approx(law.duration, abs=1e-13)
    np.testing.assert_allclose(np.diff(table["t"])[:-1], 0.1, atol=1e-12)
    assert ("tx" in table) == (law.body is not None)
    assert ("vx" in table) == law.travels


def test_columns_of_a_law_with_all_of_them_stand_in_one_order():
    assert list(read_csv(law_of("points")))[14:] == ["x", "y", "z", "vx", "vy", "vz", "segment", "node"]
    assert list(read_csv(law_of("curves")))[14:] == ["tx", "ty", "tz", "hx", "hy", "hz", "segment", "node"]


def test_segment_and_node_say_where_the_body_is():
    law, table = law_of("dwells"), read_csv(law_of("dwells"), 50.0)
    for number, segment in enumerate(law.segments, 1):
        rows = table[table["segment"] == number]
        assert len(rows)
        assert rows["t"].between(segment.start_time - 1e-9, segment.end_time + 1e-9).all()
        if not segment.moves:
            assert set(rows["node"].astype(str).str.removesuffix(".0")) == {segment.at}
            np.testing.assert_array_equal(rows[["wx", "wy", "wz"]].to_numpy(), 0.0)
        else:
            assert rows["node"].iloc[1:-1].isna().all()


def test_labels_that_csv_has_to_quote_come_back():
    law = quarter_turn()
    object.__setattr__(law.segments[0], "origin", 'a "first", 100 % of two')
    table = read_csv(law)
    assert table["node"].iloc[0] == 'a "first", 100 % of two'
    assert table["node"].iloc[-1] == "b"


def test_three_million_rows_are_made_as_they_are_written():
    """The first rows do not wait for the last, and memory is one block; the text is that of fewer rows."""
    law = law_of("paper")
    rate = 3e6 / law.duration
    tracemalloc.start()
    text = EXPORTERS["csv"].write(law, Options(rate))[".csv"]
    head, first, second = islice(text, 3)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 40e6
    rows = np.array([[float(cell) for cell in row.split(",")[:5]] for row in (first + second).splitlines()])
    assert head.startswith("t,qw,qx,qy,qz,")
    np.testing.assert_allclose(rows[:, 0], np.arange(len(rows)) / rate, rtol=1e-14)
    np.testing.assert_allclose(rows[:, 1:], law(rows[:, 0]), atol=1e-14)
    assert "".join(islice(text, 3)) == head + first + second


def test_blocks_are_written_as_one_text(tmp_path):
    law = law_of("dwells")
    text = EXPORTERS["csv"].write(law, Options(20000 / law.duration))[".csv"]
    blocks = list(text)
    assert len(blocks) == 4
    write_file(tmp_path / "samples.csv", text)
    write_results(tmp_path / "out", "design", {"samples.csv": text})
    for path in (tmp_path / "samples.csv", tmp_path / "out" / "samples.csv"):
        assert path.read_text() == "".join(blocks)


def differentiate(t, values):
    """Central differences, of the second order."""
    return np.gradient(values, t, axis=0, edge_order=2)[2:-2]


@pytest.mark.parametrize("name", ["curves", "spline"])
def test_the_torque_of_wheels_is_what_their_momentum_loses(name):
    """In body axes d(H - Jω)/dt = -(Jα + ω×H), and H keeps its place in the world."""
    law = law_of(name)
    table = read_csv(law, 20000 / law.duration)
    inside = law.segments[0].end_time * 0.9
    table = table[table["t"] < inside]
    t, torque, stored = (table[c].to_numpy() for c in ("t", ["tx", "ty", "tz"], ["hx", "hy", "hz"]))
    np.testing.assert_allclose(differentiate(t, stored), -torque[2:-2], atol=2e-5)
    turns = Rotation.from_quat(table[["qw", "qx", "qy", "qz"]].to_numpy(), scalar_first=True)
    total = stored + table[["wx", "wy", "wz"]].to_numpy() @ law.body.inertia.T
    np.testing.assert_allclose(
        turns.apply(total), turns[0].apply(total[0])[None].repeat(len(t), 0), atol=1e-9
    )


def test_the_torque_from_outside_is_what_the_momentum_gains_in_the_world():
    inertia = [[3.0, 0.2, 0.0], [0.2, 4.0, -0.1], [0.0, -0.1, 5.0]]
    law = quarter_turn(axis=(0.6, 0.0, 0.8), inertia=inertia)
    table = read_csv(law, 4000.0)
    turns = Rotation.from_quat(table[["qw", "qx", "qy", "qz"]].to_numpy(), scalar_first=True)
    momentum = turns.apply(table[["hx", "hy", "hz"]].to_numpy())
    torque = turns.apply(table[["tx", "ty", "tz"]].to_numpy())
    np.testing.assert_allclose(differentiate(table["t"].to_numpy(), momentum), torque[2:-2], atol=1e-4)
    assert np.max(np.abs(torque)) > 5


@pytest.mark.parametrize("name", [*SHIPPED, "curves", "points"])
def test_numpy_reads_its_arrays_bit_for_bit(name):
    law = law_of(name)
    content = EXPORTERS["npz"].write(law, Options(20.0))[".npz"]
    with np.load(io.BytesIO(content)) as arrays:  # without pickles
        found = dict(arrays)
    t = found["t"]
    for order, key in enumerate(("q", "omega", "alpha", "jerk")):
        np.testing.assert_array_equal(found[key], law(t, order))
    np.testing.assert_array_equal(found["node_times"], law.times)
    assert found["node_labels"].tolist() == list(law.labels)
    assert ("torque" in found, "place" in found) == (law.body is not None, law.travels)


@pytest.mark.parametrize("name", [*SHIPPED, "curves", "points"])
def test_matlabs_format_has_columns_and_cells(name, tmp_path):
    law = law_of(name)
    path = tmp_path / "samples.mat"
    path.write_bytes(EXPORTERS["mat"].write(law, Options(20.0))[".mat"])
    found = loadmat(path)
    t = found["t"]
    assert t.shape == (len(t), 1)
    for order, key in enumerate(("q", "omega", "alpha", "jerk")):
        np.testing.assert_array_equal(found[key], law(t[:, 0], order))
    assert [cell.item() for cell in found["node_labels"][:, 0]] == list(law.labels)
    assert found["segment"].dtype == float
