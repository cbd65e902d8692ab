"""CCSDS Attitude Ephemeris Messages in keyword-value notation, versions 1.0 and 2.0, as orientations.

A message turns frame A into frame B, or with ATTITUDE_DIR = B2A the other way. Where B is the body QC, Q1,
Q2, Q3 are w, x, y, z here; where A is the body the sense is the other one, and the conjugate is taken.
Rates are left alone.
"""

import re
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from timelaw.errors import shorten
from timelaw.files import stream_lines
from timelaw.numerics.array import Array
from timelaw.numerics.quaternion import conjugate
from timelaw.orientations.attitude_rows import join_segments, normalise_rows, read_sequence
from timelaw.orientations.rows import make_fault, read_number

MAX_BYTES = 50_000_000
MOST_ROWS = 500_000
VERSIONS = ("1.0", "2.0")
BODY = re.compile(r"(SC_?BODY|SC|BODY|ACC|CSS|DSS|ESS|FSS|GYRO|IMU|AST|INSTRUMENT|STARTRACKER|TAM)(_\w+)?")
QUATERNION, EULER = "QUATERNION", "EULER_ANGLE"
WIDTHS = {QUATERNION: 4, EULER: 3}


@dataclass
class _Segment:
    """One metadata block with its keys, each with its line, and the rows after it."""

    line: int
    version: str
    keys: dict[str, tuple[str, int]] = field(default_factory=dict)
    lines: list[int] = field(default_factory=list)
    rows: list[list[float]] = field(default_factory=list)

    def get(self, key: str, default: str = "") -> str:
        return self.keys.get(key, (default, self.line))[0].upper()

    def place(self, key: str) -> int:
        return self.keys.get(key, ("", self.line))[1]


def read_aem(path: Path) -> tuple[Array, tuple[str, ...]]:
    """Unit quaternions (N, 4), body to world, and notes.

    Raises:
        InputError: with file, line and what is needed.
    """
    segments = [segment for segment in _read_segments(path) if segment.rows]
    if sum(len(segment.rows) for segment in segments) < 2:
        raise make_fault("fewer than two attitudes; at least two are needed", path)
    converted = [_convert(segment, path) for segment in segments]
    notes = tuple(dict.fromkeys(note for _, found in converted for note in found))
    return join_segments([rows for rows, _ in converted]), notes


def _read_segments(path: Path) -> list[_Segment]:
    """The blocks of a message."""
    segments: list[_Segment] = []
    version, inside = "", False
    for line, raw in enumerate(stream_lines(path, MAX_BYTES), 1):
        text = raw.strip()
        if not text or text.startswith("COMMENT"):
            continue
        key, separator, value = (part.strip() for part in text.partition("="))
        if not version:
            version = _read_version(key, value, path, line)
        elif text == "META_START":
            segments.append(_Segment(line, version))
            inside = True
        elif text in ("META_STOP", "DATA_START", "DATA_STOP"):
            inside = False
        elif separator:
            if inside:
                segments[-1].keys[key.upper()] = (value, line)
        elif inside or not segments:
            raise make_fault(f'"{shorten(text)}" stands where a key is expected', path, line)
        else:
            _add_row(segments[-1], text.split(), path, line)
    if not version:
        raise make_fault("not an attitude ephemeris message: CCSDS_AEM_VERS is missing", path)
    return segments


def _read_version(key: str, value: str, path: Path, line: int) -> str:
    if key.startswith("<"):
        raise make_fault("this is XML; the keyword-value notation (KVN) is read", path, line)
    if key != "CCSDS_AEM_VERS":
        raise make_fault("not an attitude ephemeris message: CCSDS_AEM_VERS comes first", path, line)
    if value not in VERSIONS:
        raise make_fault(f'version "{shorten(value)}"; {" and ".join(VERSIONS)} are read', path, line)
    return value


def _add_row(segment: _Segment, cells: list[str], path: Path, line: int) -> None:
    """An epoch, the attitude, and rates."""
    kind = segment.get("ATTITUDE_TYPE").split("/")[0]
    width = WIDTHS.get(kind)
    if width is None:
        message = f"ATTITUDE_TYPE {segment.get('ATTITUDE_TYPE') or 'is missing'}"
        place = segment.place("ATTITUDE_TYPE")
        raise make_fault(f"{message}; quaternions and Euler angles are read", path, place)
    if len(cells) < 1 + width:
        raise make_fault(f"{len(cells)} values; an epoch and {width} numbers are needed", path, line)
    segment.rows.append([read_number(cell, path, line) for cell in cells[1 : 1 + width]])
    segment.lines.append(line)
    if len(segment.rows) > MOST_ROWS:
        raise make_fault(f"more than {MOST_ROWS} attitudes", path, line)


def _convert(segment: _Segment, path: Path) -> tuple[Array, tuple[str, ...]]:
    """Unit quaternions (N, 4) of one segment."""
    rows, notes = np.array(segment.rows), tuple[str, ...]()
    if rows.shape[1] == WIDTHS[QUATERNION]:
        first = _choose(segment, "QUATERNION_TYPE", {"LAST": False, "FIRST": True}, path)
        rows, notes = normalise_rows(rows if first else np.roll(rows, 1, axis=1), segment.lines, path)
    else:
        from scipy.spatial.transform import Rotation

        if "EULER_ROT_SEQ" not in segment.keys:
            raise make_fault("Euler angles need EULER_ROT_SEQ", path, segment.line)
        sequence = read_sequence(segment.get("EULER_ROT_SEQ"), path, segment.place("EULER_ROT_SEQ"))
        turns = Rotation.from_euler(sequence, rows, degrees=True)
        rows = np.asarray(turns.as_quat(scalar_first=True))
    return (conjugate(rows) if _goes_back(segment, path) else rows), notes


def _goes_back(segment: _Segment, path: Path) -> bool:
    """Whether the message turns the body into the world: one of its frames is the body's."""
    bodies = [bool(BODY.fullmatch(segment.get(key))) for key in ("REF_FRAME_A", "REF_FRAME_B")]
    if bodies[0] == bodies[1]:
        frames = f"{segment.get('REF_FRAME_A') or '?'} and {segment.get('REF_FRAME_B') or '?'}"
        message = f"frames {frames}: one of them must be the body's, such as SC_BODY_1"
        raise make_fault(message, path, segment.place("REF_FRAME_A"))
    return bodies[0] != _choose(segment, "ATTITUDE_DIR", {"A2B": False, "B2A": True}, path)


def _choose(segment: _Segment, key: str, choices: dict[str, bool], path: Path) -> bool:
    """What version 1.0 says by a key that it must have; later ones mean the first of the choices."""
    usual = next(iter(choices)) if segment.version != VERSIONS[0] else ""
    given = segment.get(key, usual)
    if given not in choices:
        said = f'"{given}"' if given else "is missing, which version 1.0 must have"
        raise make_fault(f"{key} {said}; {' or '.join(choices)} is needed", path, segment.place(key))
    return choices[given]
