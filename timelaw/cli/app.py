"""Entry point: every way to end has its exit code, and with --json its object on stdout."""

import click

from timelaw import __version__
from timelaw.cli.console import describe_error, set_speech
from timelaw.cli.formats import ListingCommand
from timelaw.cli.last_word import print_object, wants_json
from timelaw.cli.options import speaking, take_number
from timelaw.errors import EXIT_BAD_INPUT, EXIT_DEFECT, EXIT_DONE, Fault, TimelawError
from timelaw.interrupts import Interrupted, check_interrupted, find_interrupt, say_last_words
from timelaw.time_limit import limit_time

SHORTEST, LONGEST = 1e-3, 1e8  # seconds, up to three years: what timers take
EXIT_CODES = """\b
Exit codes: 0 done and certified · 1 findings (a limit is broken, a node is missed)
2 the command line or a file is wrong · 3 no solution · 130 interrupted, 143 terminated"""


@click.group(
    no_args_is_help=False,
    epilog=EXIT_CODES,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
)
@click.version_option(__version__, "--version", prog_name="timelaw")
def timelaw() -> None:
    """Time laws for a rigid body that visits a set of orientations: optimised, certified, reported."""


@timelaw.command()
@click.argument("problem", type=click.Path())
@click.option("-o", "--output", type=click.Path(), help="Folder for the results  [default: results/<name>]")
@take_number(
    "--time-limit", SHORTEST, LONGEST, help="Seconds of wall time, after which the best law so far is taken."
)
@speaking
def design(problem: str, output: str | None, time_limit: float | None, as_json: bool) -> int:
    """Design the law of a PROBLEM file: law.json, samples.csv, report.html and its figures."""
    with limit_time(time_limit):
        from timelaw.cli.design import run

        return run(problem, output, as_json=as_json)


@timelaw.command()
@click.argument("study", type=click.Path())
@click.option("-o", "--output", type=click.Path(), help="Folder for the results  [default: results/<name>]")
@click.option(
    "--processes", type=click.IntRange(1), help="Designs made at a time  [default: one per processor]"
)
@click.option("--cluster", metavar="ADDRESS", help="Design on the workers of a Dask scheduler instead.")
@speaking
def sweep(study: str, output: str | None, processes: int | None, cluster: str | None, as_json: bool) -> int:
    """Design a problem over the varied keys of a STUDY file: sweep.csv and front.svg."""
    from timelaw.cli.sweep import run

    return run(study, output, processes, cluster, as_json=as_json)


@timelaw.command()
@click.argument("problem", type=click.Path())
@click.option(
    "-o",
    "--output",
    type=click.Path(),
    help="Orientation file (CSV) in the tour's order; with it, its picture (SVG).",
)
@click.option("--all", "all_legs", is_flag=True, help="Print every leg, however many there are.")
@click.option("--table", is_flag=True, help="Print the distances between all orientations too.")
@speaking
def tour(problem: str, output: str | None, all_legs: bool, table: bool, as_json: bool) -> int:
    """Show the tour of a PROBLEM file and the time it allows, without designing a law."""
    from timelaw.cli.tour import run

    return run(problem, output, all_legs=all_legs, table=table, as_json=as_json)


@timelaw.command()
@click.argument("laws", type=click.Path(), nargs=-1, required=True)
@click.option("-o", "--output", type=click.Path(), help="Folder for a page with overlays  [default: none]")
@click.option("--any-route", is_flag=True, help="Compare laws of different routes too.")
@speaking
def compare(laws: tuple[str, ...], output: str | None, any_route: bool, as_json: bool) -> int:
    """Compare LAWS: law files, folders of results, or problem files, which are designed first."""
    from timelaw.cli.compare import run

    return run(laws, output, any_route=any_route, as_json=as_json)


@timelaw.command()
@click.argument("law", type=click.Path())
@speaking
def verify(law: str, as_json: bool) -> int:
    """Prove the limits and nodes of a LAW file from that file alone."""
    from timelaw.cli.verify import run

    return run(law, as_json=as_json)


@timelaw.command()
@click.argument("law", type=click.Path())
@click.option("--what", default="traces", help="traces, frames, sphere or rates  [default: traces]")
@click.option("-o", "--output", required=True, type=click.Path(), help="The picture: .svg, .png or .pdf.")
@speaking
def plot(law: str, what: str, output: str, *, as_json: bool) -> int:
    """Draw a LAW file: the traces of the body axes, the body at the nodes, the route on S³, or the rates."""
    from timelaw.cli.plot import run

    return run(law, what, output, as_json=as_json)


@timelaw.command()
@click.argument("law", type=click.Path())
@click.option("-o", "--output", required=True, type=click.Path(), help="The film: .gif, .webp or .mp4.")
@take_number("--rate", 1, 50, default=25, show_default=True, help="Frames per second.")
@take_number("--speed", 1e-3, 1e6, default=1, show_default=True, help="Times as fast as it is.")
@click.option(
    "--size", type=click.IntRange(64, 2000), default=480, show_default=True, help="Pixels each way."
)
@speaking
def animate(law: str, output: str, rate: float, speed: float, size: int, *, as_json: bool) -> int:
    """Film the body of a LAW file as it moves, on the sphere of its axes' traces or in space."""
    from timelaw.cli.animate import run

    return run(law, output, rate=rate, speed=speed, size=size, as_json=as_json)


@timelaw.command(cls=ListingCommand)
@click.argument("law", type=click.Path(), required=False)
@click.option("--to", "name", metavar="FORMAT", help="The format, one of those below.")
@click.option("-o", "--output", type=click.Path(), help="File to write  [default: beside the law]")
@click.option("--rate", help='Samples per second, such as "100 Hz"  [default: 100 Hz]')
@click.option("--grid", help='End the motion on a multiple of a control cycle, such as "4 ms".')
@click.option(
    "--epoch", help="Instant of t = 0 in formats with calendar times  [default: 2000-01-01T12:00:00]"
)
@click.option("--single", is_flag=True, help="Numbers in single precision (c99).")
@click.option("--list", "listing", is_flag=True, help="Say of every format what it carries and what is lost.")
@speaking
def export(
    law: str | None,
    name: str | None,
    output: str | None,
    rate: str | None,
    grid: str | None,
    epoch: str | None,
    single: bool,
    listing: bool,
    as_json: bool,
) -> int:
    """Write the motion of a LAW file in the format of another program."""
    from timelaw.cli.export import Request, list_formats, run

    if listing:
        return list_formats(as_json=as_json)
    return run(Request(law, name, output, rate, grid, epoch, single), as_json=as_json)


@timelaw.command()
@click.argument("kind", type=click.Choice(["lattice", "table", "list"]), required=False)
@click.option("-o", "--output", type=click.Path(), help="File to write  [default: KIND.yaml]")
def new(kind: str | None, output: str | None) -> int:
    """Write a commented problem file to begin with: KIND is lattice, table or list."""
    from timelaw.cli.new import run

    return run(kind, output)


@timelaw.command()
@click.argument("kind", type=click.Choice(["problem", "study"]), default="problem")
@click.option("-o", "--output", type=click.Path(), help="File to write  [default: stdout]")
def schema(kind: str, output: str | None) -> int:
    """Print the JSON Schema of problem or study files, for editors."""
    from timelaw.cli.schema import run

    return run(kind, output)


@timelaw.command()
@click.argument("topic", required=False)
def docs(topic: str | None) -> int:
    """Show the page of the documentation on a TOPIC, or list what there is."""
    from timelaw.cli.docs import run

    return run(topic)


def run_command(arguments: list[str]) -> int:
    """Run the command line; returns the exit code of every end but a defect of ours, which is raised.

    Whatever is raised after a signal came is its doing: C code turns it into errors of its own.
    """
    try:
        return _run(arguments)
    except (Exception, KeyboardInterrupt) as error:
        interrupt = find_interrupt() or _find_interrupt_in(error)
        if interrupt is None:
            say_last_words()
            if wants_json(arguments):
                print_object(describe_error(TimelawError(f"a defect of timelaw: {error!r}"), EXIT_DEFECT))
            raise
        return _failed(arguments, TimelawError(str(interrupt)), interrupt.exit_code)


def _run(arguments: list[str]) -> int:
    set_speech(quiet=False, progress=True)
    try:
        code = timelaw.main(arguments, prog_name="timelaw", standalone_mode=False)
    except TimelawError as error:
        check_interrupted()
        return _failed(arguments, error)
    except click.UsageError as error:
        place = error.ctx.command_path if error.ctx else "timelaw"
        message = f"{error.format_message()} Try '{place} --help'."
        where = place.removeprefix("timelaw").strip()  # the name of the program comes before every message
        return _failed(arguments, TimelawError(Fault(message, where)), EXIT_BAD_INPUT)
    except click.ClickException as error:
        return _failed(arguments, TimelawError(error.format_message()), EXIT_BAD_INPUT)
    return code if isinstance(code, int) else EXIT_DONE


def _find_interrupt_in(error: BaseException) -> Interrupted | None:
    """Whether an error is an interrupt, from wherever; click makes an error of its own of it."""
    is_one = isinstance(error, click.Abort | KeyboardInterrupt)
    return Interrupted() if is_one else None


def _failed(arguments: list[str], error: TimelawError, code: int | None = None) -> int:
    code = error.exit_code if code is None else code
    say_last_words()
    for fault in error.faults:
        click.echo(f"timelaw: {fault}", err=True)
    if wants_json(arguments):
        print_object(describe_error(error, code))
    return code
