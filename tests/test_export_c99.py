"""The C99 source: compiled strictly, called from Python, and equal to the law."""

import ctypes
import re
import subprocess
from dataclasses import replace

import numpy as np
import pytest

from tests.laws import LAWS, SMALL, law_of, quarter_turn
from tests.tools import need
from timelaw.errors import InputError
from timelaw.export.c99 import make_identifier
from timelaw.export.exporter import Options
from timelaw.export.formula import TERMS
from timelaw.export.registry import EXPORTERS
from timelaw.export.segment_tables import TABLES
from timelaw.law_file import read_law
from timelaw.motion.kinds import KINDS

STRICT = ["gcc", "-std=c99", "-Wall", "-Wextra", "-pedantic", "-Werror", "-Wconversion", "-O1"]
MAIN = """\
#include <stdio.h>
#include "law.h"
int main(void) { double q[4], w[3], a[3]; law_evaluate(LAW_DURATION / 2, q, w, a); printf("%.17g\\n", q[3]); return 0; }
"""


def compile_law(law, folder, **options):
    """The functions of a law's source, as a shared library."""
    files = EXPORTERS["c99"].name_files(law, Options(**options), folder / "law.c")
    for path, content in files.items():
        (folder / path).write_text(content)
    library = folder / f"{folder.name}.so"
    subprocess.run([*STRICT, "-shared", "-fPIC", folder / "law.c", "-lm", "-o", library], check=True)
    return ctypes.CDLL(str(library)), files


def call(function, number, t, *widths):
    """Arrays (m, w) of what a function writes for each t."""
    function.argtypes = [number, *[ctypes.POINTER(number)] * len(widths)]
    buffers = [(number * width)() for width in widths]
    rows = []
    for instant in t:
        function(instant, *buffers)
        rows.append([x for buffer in buffers for x in buffer])
    return np.split(np.array(rows), np.cumsum(widths)[:-1], axis=1)


def instants(law, count=400):
    return np.unique(np.concatenate([np.linspace(0, law.duration, count), law.times]))


@pytest.fixture
def gcc():
    need("gcc")


@pytest.mark.usefixtures("gcc")
@pytest.mark.parametrize("name", [*LAWS, "moving"])
def test_doubles_are_the_law_to_1e_12(name, tmp_path):
    law = law_of(name) if name in LAWS else read_law(SMALL / "moving.json")[0]
    library, _ = compile_law(law, tmp_path)
    t = instants(law)
    for order, values in enumerate(call(library.law_evaluate, ctypes.c_double, t, 4, 3, 3)):
        np.testing.assert_allclose(values, law(t, order), rtol=0, atol=1e-12)
    if law.travels:
        for order, values in enumerate(call(library.law_place, ctypes.c_double, t, 3, 3)):
            np.testing.assert_allclose(values, law.place(t, order), rtol=0, atol=1e-12)


@pytest.mark.usefixtures("gcc")
@pytest.mark.parametrize("name", ["paper", "mixed", "points"])
def test_single_precision_is_the_law_to_its_own(name, tmp_path):
    law = law_of(name)
    library, files = compile_law(law, tmp_path, single=True)
    assert "double" not in "".join(files.values())
    t = instants(law).astype(np.float32).clip(0, np.float32(law.duration))
    found = call(library.law_evaluate, ctypes.c_float, t.tolist(), 4, 3, 3)
    for order, (values, tolerance) in enumerate(zip(found, (1e-5, 2e-5, 1e-4), strict=True)):
        np.testing.assert_allclose(values, law(t.astype(float).clip(0, law.duration), order), atol=tolerance)


@pytest.mark.usefixtures("gcc")
def test_times_beyond_the_ends_are_taken_to_them(tmp_path):
    law = quarter_turn()
    library, _ = compile_law(law, tmp_path)
    before, after = call(library.law_evaluate, ctypes.c_double, [-1.0, 99.0], 4, 3, 3)[0]
    np.testing.assert_array_equal(before, [1, 0, 0, 0])
    np.testing.assert_allclose(after, [np.sqrt(0.5), 0, 0, np.sqrt(0.5)], atol=1e-15)


@pytest.mark.usefixtures("gcc")
def test_a_program_includes_the_header_and_links_without_more(tmp_path):
    _, files = compile_law(quarter_turn(), tmp_path)
    (tmp_path / "main.c").write_text(MAIN)
    subprocess.run([*STRICT, "main.c", "law.c", "-lm", "-o", "main"], cwd=tmp_path, check=True)
    done = subprocess.run(["./main"], cwd=tmp_path, check=True, capture_output=True, text=True)
    assert float(done.stdout) == pytest.approx(np.sin(np.pi / 8), abs=1e-15)
    source = "".join(files.values())
    assert not re.search(r"\b(malloc|calloc|realloc|free)\b", source)


def test_the_cost_is_said_and_is_that_of_the_largest_degree():
    """Degree 5 in an angle, 4 and 3 in its rates: 15 + 10 + 6 steps of three operations, and 40 more."""
    header = EXPORTERS["c99"].write(quarter_turn(), Options())[".h"]
    assert f"a call takes at most {3 * (15 + 10 + 6) + 40} multiplications" in " ".join(
        header.split()
    ).replace(" * ", " ")


def test_two_laws_can_stand_in_one_program():
    names = [make_identifier(stem) for stem in ("paper-24-cell", "4 seasons", "Übung", "_x")]
    assert names == ["paper_24_cell", "law_4_seasons", "law__bung", "law__x"]


def test_numbers_beyond_single_precision_are_refused():
    law = quarter_turn()
    huge = replace(law.segments[0], profile=law.segments[0].profile.scaled(1e45, 1.0))
    with pytest.raises(InputError, match="too large for single precision"):
        EXPORTERS["c99"].write(replace(law, segments=(huge,)), Options(single=True))
    EXPORTERS["c99"].write(replace(law, segments=(huge,)), Options())


def test_every_kind_of_segment_has_tables_and_terms():
    assert set(TABLES) == set(TERMS) == set(KINDS)
