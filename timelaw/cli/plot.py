"""`timelaw plot`: one picture of a law, from its file alone."""

from pathlib import Path

from timelaw.cli.console import print_json, say
from timelaw.errors import EXIT_DONE, InputError, shorten
from timelaw.files import write_file
from timelaw.law_file import read_law


def run(path: str, what: str, output: str, *, as_json: bool) -> int:
    """Draw the law file at `path`; returns the exit code."""
    from timelaw.report.pictures.registry import PICTURES
    from timelaw.report.pictures.render import SUFFIXES, render_picture
    from timelaw.report.pictures.sampling import refuse_undefined

    if what not in PICTURES:
        raise InputError(f'--what "{shorten(what)}": allowed: {", ".join(PICTURES)}')
    file = Path(output)
    if file.suffix.lower() not in SUFFIXES:
        raise InputError(f'-o "{shorten(output)}": a name that ends in {", ".join(SUFFIXES)} is needed')
    law, _ = read_law(Path(path))
    refuse_undefined(law)
    write_file(file, render_picture(law, what, file.suffix.lower()))
    say(f"{PICTURES[what].title}: {file}")
    if as_json:
        print_json({"ok": True, "exit_code": EXIT_DONE, "name": law.name, "files": [str(file)]})
    return EXIT_DONE
