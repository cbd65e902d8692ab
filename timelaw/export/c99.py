"""One C99 header and one source with the law's tables: orientation and rates at any instant."""

import re
from collections.abc import Iterable, Sequence
from itertools import accumulate
from math import ceil, log2

import numpy as np

from timelaw.errors import Fault, InputError
from timelaw.export import c99_code as code
from timelaw.export.exporter import Exporter, Options
from timelaw.export.segment_tables import RATES, TableSegment, tabulate_segments
from timelaw.motion import QuaternionLaw
from timelaw.numerics.array import Array

WIDTH = 100  # characters of a line
ARITHMETIC = {True: 72, False: 40}  # operations besides polynomials: of curves, of turns
SUFFIXES, SIZES = {"double": "", "float": "f"}, {"double": 8, "float": 4}


def write_c99(law: QuaternionLaw, options: Options) -> dict[str, str]:
    """`NAME_evaluate(t, q, omega, alpha)`, and `NAME_place` where the origin moves; NAME is the files' stem.

    Raises:
        InputError: a number is too large for single precision.
    """
    real = "float" if options.single else "double"
    table, name = tabulate_segments(law), make_identifier(options.stem)
    header = f"{options.stem}.h"
    return {".c": _write_source(law, table, name, header, real), ".h": _write_header(law, table, name, real)}


def make_identifier(stem: str) -> str:
    """A name in C of what a file is called."""
    name = re.sub(r"[^A-Za-z0-9]", "_", stem)
    return name if name[:1].isalpha() else f"law_{name}"


def _write_header(law: QuaternionLaw, table: Sequence[TableSegment], name: str, real: str) -> str:
    pieces = [piece for segment in table for piece in segment.pieces]
    curved = {segment.curved for segment in table}
    size = SIZES[real]
    numbers = sum(f.size for piece in pieces for f in piece.functions) + 8 * len(table) + 1
    functions = len(pieces[0].functions)
    bytes_taken = numbers * size + len(pieces) * (2 * size + 8 * functions) + 8 * len(table)
    searches = _count_halvings(len(table)) + max(_count_halvings(len(s.pieces)) for s in table)
    place = code.PLACE_DECLARATION.format(name=name, real=real) if law.travels else ""
    return code.HEADER.format(
        title=re.sub(r"[^A-Za-z0-9._ -]", "_", law.name)[:WIDTH],
        segments=len(table),
        duration=_write_number(law.duration, real, ""),
        bytes=bytes_taken,
        operations=max(_count_operations(s) for s in table),
        comparisons=searches + 4,
        functions="one square root" if curved == {True} else "one sine and one cosine, or one square root",
        guard=f"{name.upper()}_H",
        prefix=name.upper(),
        suffix=SUFFIXES[real],
        name=name,
        real=real,
        place=place,
    )


def _count_halvings(count: int) -> int:
    """Of a binary search among so many."""
    return ceil(log2(count))


def _count_operations(segment: TableSegment) -> int:
    """Multiplications and additions of the costliest piece: three for each step of de Casteljau's scheme."""
    steps = (
        sum(len(f) * (len(f) - 1) // 2 * int(f.shape[1]) for f in piece.functions[:RATES])
        for piece in segment.pieces
    )
    return 3 * max(steps) + ARITHMETIC[segment.curved]


def _write_source(
    law: QuaternionLaw, table: Sequence[TableSegment], name: str, header: str, real: str
) -> str:
    pieces = [piece for segment in table for piece in segment.pieces]
    turns, curves = (any(segment.curved == kind for segment in table) for kind in (False, True))
    functions = len(pieces[0].functions)
    most = max(f.size for piece in pieces for f in piece.functions)
    lines = [code.TYPES.format(header=header, real=real, most=most, orders=functions)]
    lines += _list_tables(law, table, real)
    suffix = SUFFIXES[real]
    needed = {"COS": turns, "SIN": turns, "SQRT": curves}
    macros = [f"#define {m} {m.lower()}{suffix}\n" for m, there in needed.items() if there]
    lines += ["\n", *macros, code.BERNSTEIN]
    lines += [code.TURN] * turns + [code.CURVE] * curves
    lines.append(code.EVALUATE.format(name=name, choose=code.CHOOSE[turns, curves]))
    if law.travels:
        lines.append(code.PLACE.format(name=name))
    return "".join(lines)


def _list_tables(law: QuaternionLaw, table: Sequence[TableSegment], real: str) -> Iterable[str]:
    counts = accumulate((len(segment.pieces) for segment in table), initial=0)
    yield f"\nenum {{ SEGMENTS = {len(table)} }};\n"
    yield _declare("static const real times[SEGMENTS + 1]", _list_numbers(law.times, real))
    yield _declare("static const int first_piece[SEGMENTS + 1]", map(str, counts))
    curved = [segment.curved for segment in table]
    if not all(curved):
        for label, width, rows in (
            ("starts", 4, [segment.start for segment in table]),
            ("axes", 3, [segment.axis for segment in table]),
        ):
            groups = ("{" + ", ".join(_list_numbers(row, real)) + "}" for row in rows)
            yield _declare(f"static const real {label}[SEGMENTS][{width}]", groups)
    if any(curved) and (law.travels or not all(curved)):
        yield _declare("static const unsigned char curved[SEGMENTS]", (str(int(c)) for c in curved))
    entries, numbers, first = [], [], 0
    for segment in table:
        for start, piece in zip(segment.offsets, segment.pieces, strict=True):
            degrees = [len(f) - 1 for f in piece.functions]
            firsts = list(accumulate((f.size for f in piece.functions[:-1]), initial=first))
            first += sum(f.size for f in piece.functions)
            numbers += [text for f in piece.functions for text in _list_numbers(f.ravel(), real)]
            head = ", ".join(_list_numbers(np.array([start, piece.length]), real))
            entries.append(f"{{{head}, {{{_join(degrees)}}}, {{{_join(firsts)}}}}}")
    yield _declare("static const piece_t pieces[]", entries)
    yield _declare("static const real control[]", numbers)


def _join(values: Iterable[int]) -> str:
    return ", ".join(map(str, values))


def _declare(what: str, entries: Iterable[str]) -> str:
    """An array with its initialiser, in lines of moderate length."""
    lines, line = [], "   "
    for entry in entries:
        if len(line) + len(entry) + 2 > WIDTH and line.strip():
            lines.append(line)
            line = "   "
        line += f" {entry},"
    return f"\n{what} = {{\n" + "\n".join([*lines, line]) + "\n};\n"


def _list_numbers(values: Array, real: str) -> list[str]:
    suffix = SUFFIXES[real]
    return [_write_number(value, real, suffix) for value in values.tolist()]


def _write_number(value: float, real: str, suffix: str) -> str:
    """A constant of the type, with all the digits that it has there."""
    with np.errstate(over="ignore", under="ignore"):
        stored = np.float64(value) if real == "double" else np.float32(value)
    if not np.isfinite(stored):
        raise InputError(Fault(f"{value:.6g} is too large for single precision", "--single"))
    return str(stored + stored.dtype.type(0)) + suffix


C99 = Exporter(
    "law.c",
    write_c99,
    "C99 source and header: quaternion, ω, α at any t (place and velocity where it moves), exact",
    "jerk; labels",
    ("single",),
)
