"""`timelaw animate`: a law's motion as a moving picture, from its file alone."""

from pathlib import Path

from timelaw.cli.console import print_json, say, show_progress
from timelaw.errors import EXIT_DONE, InputError, shorten
from timelaw.files import write_file
from timelaw.law_file import read_law

MOST_FRAMES = 20_000  # ten minutes and more of drawing, a hundred megabytes


def run(path: str, output: str, *, rate: float, speed: float, size: int, as_json: bool) -> int:
    """Film the law file at `path`; returns the exit code."""
    from timelaw.report.animation.film import Film
    from timelaw.report.animation.formats import FORMATS
    from timelaw.report.pictures.sampling import refuse_undefined

    file = Path(output)
    suffix = file.suffix.lower()
    if suffix not in FORMATS:
        raise InputError(f'-o "{shorten(output)}": a name that ends in {", ".join(FORMATS)} is needed')
    law, _ = read_law(Path(path))
    refuse_undefined(law)
    film = Film(law, rate, speed, size)
    if film.count > MOST_FRAMES:
        least = law.duration * rate / MOST_FRAMES
        message = f"{film.count} frames; at most {MOST_FRAMES} are drawn, choose a --speed above {least:.3g}"
        raise InputError(f"{message}, or a lower --rate")
    with show_progress() as progress:
        content = FORMATS[suffix](film, progress)
    write_file(file, content)
    told = f"{film.count} frames of {law.name}, {law.duration / speed:.4g} s"
    say(f"{told}, {len(content) / 1e6:.3g} MB: {file}")
    if as_json:
        found = {"name": law.name, "files": [str(file)], "frames": film.count, "bytes": len(content)}
        print_json({"ok": True, "exit_code": EXIT_DONE, **found})
    return EXIT_DONE
