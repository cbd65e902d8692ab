"""Moving pictures as files: GIF and WebP frame by frame, MP4 by ffmpeg; only what is encoded is kept."""

import io
import shutil
import struct
import subprocess
import tempfile
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np

from timelaw.errors import InputError, TimelawError
from timelaw.progress import Progress
from timelaw.report.animation.change import CLEAR, list_changes
from timelaw.report.animation.film import HOLD, Film

BITS = 8  # of a pixel in a GIF: 256 colours
FOREVER = b"\x21\xff\x0bNETSCAPE2.0\x03\x01\x00\x00\x00"
ANIMATED, TRANSPARENT = 0x02, 0x10  # of a WebP's head
QUIET = ("-hide_banner", "-loglevel", "error", "-y")
RAW = ("-f", "rawvideo", "-pix_fmt", "rgb24")
CODING = ("-an", "-c:v", "libx264", "-pix_fmt", "yuv420p", "-movflags", "+faststart")


def write_gif(film: Film, progress: Progress | None = None) -> bytes:
    """GIF89a, shown again and again; frames hold what changes."""
    from PIL import Image
    from PIL.GifImagePlugin import getdata

    content = io.BytesIO()
    palette = _list_colours(film)
    content.write(b"GIF89a" + struct.pack("<HHBBB", film.size, film.size, 0xF0 | (BITS - 1), 0, 0))
    content.write(palette + FOREVER)
    for change in list_changes(film, progress):
        image = Image.fromarray(change.pixels).convert("P")
        image.putpalette(palette)
        shown: dict[str, Any] = {"duration": change.delay, "disposal": 1, "transparency": CLEAR}
        for block in getdata(image, (change.left, change.top), **shown):
            content.write(block)
    content.write(b";")
    return content.getvalue()


def _list_colours(film: Film) -> bytes:
    """256 colours of three bytes, the last of them never seen."""
    found = bytes(film.palette.getpalette()[: 3 * CLEAR])
    return found.ljust(3 << BITS, b"\0")


def write_webp(film: Film, progress: Progress | None = None) -> bytes:
    """WebP without loss, shown again and again; frames hold what changes, at even corners as it asks."""
    from PIL import Image

    colours = np.frombuffer(_list_colours(film), dtype=np.uint8).reshape(-1, 3)
    table = np.column_stack([colours, np.full(len(colours), 255, dtype=np.uint8)])
    table[CLEAR] = 0
    head = struct.pack("<B3x", ANIMATED | TRANSPARENT) + _small(film.size - 1) + _small(film.size - 1)
    content = io.BytesIO()
    content.write(_chunk(b"VP8X", head) + _chunk(b"ANIM", struct.pack("<IH", 0xFFFFFFFF, 0)))
    for change in list_changes(film, progress, grid=2):
        file = io.BytesIO()
        Image.fromarray(table[change.pixels]).save(file, "WEBP", lossless=True, method=4)
        height, width = change.pixels.shape
        place = [change.left // 2, change.top // 2, width - 1, height - 1, change.delay]
        frame = b"".join(map(_small, place)) + b"\0"
        content.write(_chunk(b"ANMF", frame + _take_image(file.getvalue())))
    body = b"WEBP" + content.getvalue()
    return b"RIFF" + struct.pack("<I", len(body)) + body


def _small(number: int) -> bytes:
    """Three bytes."""
    return number.to_bytes(3, "little")


def _chunk(name: bytes, data: bytes) -> bytes:
    """With its length, and even."""
    return name + struct.pack("<I", len(data)) + data + b"\0" * (len(data) % 2)


def _take_image(file: bytes) -> bytes:
    """The chunk that is the image itself in a WebP of one frame."""
    at = 12
    while file[at : at + 4] != b"VP8L":
        at += 8 + (length := struct.unpack("<I", file[at + 4 : at + 8])[0]) + length % 2
    length = struct.unpack("<I", file[at + 4 : at + 8])[0]
    return file[at : at + 8 + length + length % 2]


def write_mp4(film: Film, progress: Progress | None = None) -> bytes:
    """H.264 by ffmpeg, to which frames are handed one by one.

    Raises:
        InputError: there is no ffmpeg, or the size is odd.
        TimelawError: ffmpeg failed.
    """
    program = shutil.which("ffmpeg")
    if program is None:
        raise InputError("an .mp4 needs the program ffmpeg, which is not installed; .gif and .webp do not")
    if film.size % 2:
        raise InputError(f"--size {film.size}: an .mp4 needs an even number of pixels")
    with tempfile.TemporaryDirectory(prefix="timelaw-") as folder:
        file = Path(folder) / "motion.mp4"
        given = ("-s", f"{film.size}x{film.size}", "-r", f"{film.rate:g}", "-i", "-")
        line = [program, *QUIET, *RAW, *given, *CODING, str(file)]
        with (Path(folder) / "words").open("w+b") as words:
            _hand_over(film, line, words, progress)
        return file.read_bytes()


def _hand_over(film: Film, line: list[str], words: Any, progress: Progress | None) -> None:
    """All frames, the last as often as it stays; what ffmpeg says goes to a file.

    Raises:
        TimelawError: it failed.
    """
    process = subprocess.Popen(line, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=words)
    frames: Any = process.stdin
    try:
        for image in film.draw_frames(progress):
            frames.write(last := image.tobytes())
        for _ in range(round(HOLD * film.rate)):
            frames.write(last)
    except BrokenPipeError:
        pass  # it has ended, and said why
    except BaseException:
        process.kill()
        process.wait()
        raise
    finally:
        with suppress(BrokenPipeError):  # what is left of a frame
            frames.close()
    if process.wait():
        words.seek(0)
        said = words.read().decode("utf-8", "replace").strip().splitlines() or ["it says nothing"]
        raise TimelawError(f"ffmpeg failed: {said[-1]}")


FORMATS: dict[str, Callable[[Film, Progress | None], bytes]] = {
    ".gif": write_gif,
    ".webp": write_webp,
    ".mp4": write_mp4,
}
