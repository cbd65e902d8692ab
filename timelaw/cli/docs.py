"""`timelaw docs`: the pages of the documentation, wrapped on a terminal, as they are elsewhere."""

import re
import sys
from importlib.resources import files

from timelaw.errors import EXIT_DONE, Fault, InputError, shorten
from timelaw.interrupts import finish_work

SUFFIX = ".md"
LINK = re.compile(r"\[([^\]]+)\]\(([\w-]+)\.md\)")  # from page to page


def run(topic: str | None) -> int:
    """Print the page on a topic, or the titles of all; returns the exit code."""
    pages = read_pages()
    if topic is None:
        _write("".join(f"{name:{max(map(len, pages))}}  {_title(page)}\n" for name, page in pages.items()))
        return EXIT_DONE
    name = topic.removesuffix(SUFFIX)  # as links from page to page have it
    if name not in pages:
        raise InputError(Fault(f'"{shorten(topic)}" is no topic; there are: {", ".join(pages)}', "docs"))
    if sys.stdout.isatty():
        _show(pages[name])
    else:
        _write(pages[name])
    return EXIT_DONE


def read_pages() -> dict[str, str]:
    """The pages that the package holds, by their topics."""
    found = {page.name: page for page in (files("timelaw") / "docs").iterdir() if page.name.endswith(SUFFIX)}
    return {name.removesuffix(SUFFIX): found[name].read_text(encoding="utf-8") for name in sorted(found)}


def _title(page: str) -> str:
    return page.partition("\n")[0].removeprefix("# ")


def _write(text: str) -> None:
    with finish_work():
        sys.stdout.write(text)
        sys.stdout.flush()


def _show(page: str) -> None:
    """For people: Markdown set for the terminal, links as the command that follows them."""
    from rich.console import Console
    from rich.markdown import Markdown

    Console().print(Markdown(LINK.sub(r"\1 (`timelaw docs \2`)", page), hyperlinks=False))
