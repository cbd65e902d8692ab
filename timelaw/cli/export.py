"""`timelaw export`: the motion of a law file in the format of another program."""

from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np

from timelaw.certificate import certify
from timelaw.cli.console import print_json, print_table, say, say_findings
from timelaw.errors import EXIT_DONE, EXIT_FINDINGS, Fault, InputError, shorten
from timelaw.export.exporter import Exporter, Options
from timelaw.export.registry import EXPORTERS
from timelaw.files import write_files
from timelaw.law_file import read_law
from timelaw.motion import QuaternionLaw
from timelaw.motion.cycle import refuse_cycle, stretch_to_cycle
from timelaw.units import FREQUENCY, TIME, Kind, parse_quantity

RATES, CYCLES = (1e-9, 1e9), (1e-6, 1e3)  # Hz, s
WHERE = "export"


@dataclass(frozen=True)
class Request:
    """What the command line asks for."""

    law: str | None
    name: str | None
    output: str | None
    rate: str | None
    grid: str | None
    epoch: str | None
    single: bool


def run(request: Request, *, as_json: bool) -> int:
    """Write a law in another format; returns the exit code."""
    if request.law is None:
        raise InputError(Fault("Missing argument 'LAW': the law.json that timelaw design writes", WHERE))
    exporter, options = _find_format(request.name), _read_options(request)
    _refuse_unused(request, exporter)
    cycle = None if request.grid is None else _read(request.grid, TIME, CYCLES, "--grid")
    path = Path(request.law)
    law, document = read_law(path)
    findings = _prove(law, path)
    if cycle is not None:
        law = _stretch(law, document, cycle)
    place = path.parent / exporter.file_name if request.output is None else Path(request.output)
    if place.resolve() == path.resolve():
        raise InputError(Fault(f"-o {place} is the law file itself", WHERE))
    with np.errstate(all="ignore"):  # what a hostile law overflows is not finite in the file
        files = exporter.name_files(law, options, place)
    write_files({Path(name): content for name, content in files.items()})
    say(f"{law.name}, {law.duration:.9g} s: {', '.join(files)}; {exporter.carries}; lost: {exporter.loses}")
    say_findings(findings)
    code = EXIT_FINDINGS if findings else EXIT_DONE
    if as_json:
        found = {"name": law.name, "format": request.name, "duration": law.duration, "files": list(files)}
        print_json(
            {"ok": not findings, "exit_code": code, **found, **_describe(exporter), "findings": findings}
        )
    return code


def _prove(law: QuaternionLaw, path: Path) -> list[str]:
    """What does not hold of a law; one that is no motion is not exported.

    Raises:
        InputError: its geometry or its times do not fit together.
    """
    with np.errstate(over="ignore", invalid="ignore"):
        certificate = certify(law)
    if not all(check.holds for check in certificate.geometry):
        message = f"it is no motion that could be exported: {certificate.findings()[-1]}"
        raise InputError(Fault(f"{message}; see timelaw verify", "", str(path)))
    return certificate.findings()


def list_formats(*, as_json: bool) -> int:
    """Print what each format carries and loses."""
    print_table(
        ["format", "file", "carries", "lost"],
        [[name, e.file_name, e.carries, e.loses] for name, e in EXPORTERS.items()],
    )
    if as_json:
        print_json({"ok": True, "exit_code": 0, "formats": {n: _describe(e) for n, e in EXPORTERS.items()}})
    return EXIT_DONE


def _describe(exporter: Exporter) -> dict[str, Any]:
    return {"carries": exporter.carries, "lost": exporter.loses, "takes": list(exporter.takes)}


def _find_format(name: str | None) -> Exporter:
    listing = ", ".join(EXPORTERS)
    if name is None:
        raise InputError(Fault(f"--to FORMAT is needed: {listing}", WHERE))
    if name not in EXPORTERS:
        raise InputError(Fault(f'--to "{shorten(name)}"; allowed: {listing}', WHERE))
    return EXPORTERS[name]


def _read_options(request: Request) -> Options:
    plain = Options()
    rate = plain.rate if request.rate is None else _read(request.rate, FREQUENCY, RATES, "--rate")
    epoch = plain.epoch if request.epoch is None else _read_epoch(request.epoch)
    return Options(rate, epoch, request.single)


def _read(text: str, kind: Kind, within: tuple[float, float], option: str) -> float:
    try:
        value = parse_quantity(text, kind)
    except ValueError as error:
        raise InputError(Fault(f"{option}: {error}", WHERE)) from None
    if not within[0] <= value <= within[1]:
        message = f'{option} "{shorten(text)}" is out of range; {within[0]:g} to {within[1]:g} {kind.unit}'
        raise InputError(Fault(f"{message} are allowed", WHERE))
    return value


def _read_epoch(text: str) -> datetime:
    try:
        found = datetime.fromisoformat(text)
    except ValueError:
        message = f'--epoch "{shorten(text)}"; an instant like 2030-06-01T12:00:00 is needed'
        raise InputError(Fault(message, WHERE)) from None
    return found if found.tzinfo is None else found.astimezone(UTC).replace(tzinfo=None)


def _refuse_unused(request: Request, exporter: Exporter) -> None:
    """Options that would do nothing."""
    given = {"rate": request.rate, "epoch": request.epoch, "single": request.single or None}
    for option, value in given.items():
        if value is not None and option not in exporter.takes:
            users = ", ".join(name for name, e in EXPORTERS.items() if option in e.takes)
            message = f"--{option} does nothing for {request.name}; it belongs to {users}"
            raise InputError(Fault(message, WHERE))


def _stretch(law: QuaternionLaw, document: dict[str, Any], cycle: float) -> QuaternionLaw:
    """The law on a multiple of a control cycle, its limits proved again.

    Raises:
        InputError: times were given that it would no longer keep, or the limits do not hold.
    """
    provenance = document.get("provenance")
    given = provenance.get("given_times") if isinstance(provenance, dict) else None
    reason = refuse_cycle(law)
    if given:
        reason = f"the law keeps {shorten(str(given))}, which a stretch would change"
    if reason:
        raise InputError(Fault(f"--grid: {reason}", WHERE))
    found = stretch_to_cycle(law, cycle)
    findings = certify(found).findings()
    if findings:
        raise InputError(Fault(f"--grid: the stretched law is not certified: {findings[0]}", WHERE))
    say(f"stretched from {law.duration:.9g} s to {found.duration:.9g} s, and certified again")
    return found
