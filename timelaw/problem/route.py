"""The part of a problem file about the route: which orientations, in which order."""

from math import hypot
from pathlib import PurePath
from typing import Annotated, Any, Literal, Self, get_args

from pydantic import BeforeValidator, Field, model_validator

from timelaw.errors import shorten
from timelaw.numerics.turn import SAME_ORIENTATION
from timelaw.problem.bezier import Curves, refuse_mixed
from timelaw.problem.fields import NORM_TOLERANCE, Model, as_tuple, fault, quantity, quote, tour_or_labels
from timelaw.problem.forms import SEQUENCE, FormName, Numbers, read_numbers, refuse_half_form
from timelaw.units import ANGLE, MOST

LatticeName = Literal["16-cell", "tesseract", "24-cell", "600-cell", "120-cell"]
TourName = Literal["paper", "shortest", "fewest-stops", "least-turning", "fastest", "given"]
SEARCHED = ("shortest", "fewest-stops", "least-turning", "fastest")
SOURCES = ("lattice", "file", "list", "uniform")
LEAST_FILL, LARGEST_FILL = 1e-3, 3.2  # rad; half a turn is as far as orientations get
FINEST, COARSEST = 1e-14, 0.1  # rad; doubles resolve no less, and nobody measures as badly
CUSTOM = ("form", "sequence", "unit", "columns")
ANGLE_FILES = (".ang", ".ctf")  # have a form of their own, whose unit may be given
ALIASES = {"form": "as"}


class Uniform(Model):
    """A uniform set whose covering radius, the body's turn to the nearest one, is at most `fill`."""

    fill: Annotated[float, quantity(ANGLE, LEAST_FILL, LARGEST_FILL)]


def _unit(value: Any) -> Any:
    """Four numbers of norm one."""
    numbers = read_numbers(value)
    if len(numbers) != 4 or not abs(hypot(*numbers) - 1) <= NORM_TOLERANCE:
        raise fault("expected a unit quaternion [w, x, y, z]")
    return numbers


class Turned(Model):
    """Constant rotations: q becomes world ⊗ q ⊗ body, quaternions scalar first."""

    world: Annotated[tuple[float, ...], BeforeValidator(_unit)] = (1.0, 0.0, 0.0, 0.0)
    body: Annotated[tuple[float, ...], BeforeValidator(_unit)] = (1.0, 0.0, 0.0, 0.0)


class Orientations(Model):
    """Where the orientations come from, exactly one of the four, how they are written, what is done to them.

    `as` names how a file or list writes them, `unit` the unit of its angles, `sequence` the axes of Euler
    angles: capitals turn with the body, small letters about the fixed axes. `phase` takes one phase of a
    texture tool's map, `only` some of the labels, or ranges of them such as 9-20. `symmetry` is a crystal's
    rotation group, under which orientations count as the same; `duplicates: merge` keeps the first of those
    that are the same within `tolerance`. `precision` is the body's turn by which each may differ from what
    was meant, where the digits do not tell.
    """

    lattice: LatticeName | None = None
    file: str | None = None
    list: Annotated[tuple[Numbers, ...] | None, BeforeValidator(as_tuple)] = None
    uniform: Uniform | None = None
    form: Annotated[FormName | None, Field(alias="as")] = None
    sequence: Annotated[str | None, Field(pattern=SEQUENCE)] = None
    unit: Literal["deg", "rad"] | None = None
    phase: Annotated[int | None, Field(ge=0, le=255)] = None
    only: Annotated[tuple[str, ...] | None, BeforeValidator(lambda value: _labels(value))] = None
    columns: Annotated[
        tuple[str, ...] | tuple[int, ...] | None, BeforeValidator(lambda value: _columns(value))
    ] = None
    turned: Turned | None = None
    symmetry: Annotated[str | None, BeforeValidator(lambda value: _class(value))] = None
    duplicates: Literal["merge"] | None = None
    tolerance: Annotated[float, quantity(ANGLE, SAME_ORIENTATION, 0.2)] = SAME_ORIENTATION
    precision: Annotated[float | None, quantity(ANGLE, FINEST, COARSEST)] = None

    @model_validator(mode="after")
    def _one(self) -> Self:
        given = [key for key in SOURCES if key in self.model_fields_set]
        if len(given) != 1 or getattr(self, given[0]) is None:
            raise fault('give exactly one of "lattice", "file", "list", "uniform"')
        if self.list is not None and len(self.list) < 2:
            raise fault("a list needs at least two orientations")
        return self

    @model_validator(mode="after")
    def _columns_differ(self) -> Self:
        if self.columns is not None and not 0 < len(set(self.columns)) == len(self.columns):
            what = "names" if isinstance((*self.columns, "")[0], str) else "columns"
            raise fault(f"as many different {what} as the form has numbers are needed", "columns")
        if self.columns and isinstance(self.columns[0], int) and self.form is None:
            raise fault('numbers of columns do not say what is in them; give "as" too', "columns")
        return self

    @model_validator(mode="after")
    def _form_is_whole(self) -> Self:
        written = self.file is not None or self.list is not None
        for key in CUSTOM:
            if getattr(self, key) is not None and not (
                self.file is not None or (written and key != "columns")
            ):
                owners = '"file"' if key == "columns" else '"file" or "list"'
                raise fault(f"it describes what a {owners} holds", ALIASES.get(key, key))
        if self.phase is not None and not self._is_angle_file():
            raise fault("it belongs to the angle files of texture tools, .ang and .ctf", "phase")
        angles = ("unit",) if self._is_angle_file() else ()
        refuse_half_form(self.form, {"unit": self.unit, "sequence": self.sequence}, without_form=angles)
        return self

    def _is_angle_file(self) -> bool:
        return self.file is not None and PurePath(self.file).suffix.lower() in ANGLE_FILES


class RouteModel(Model):
    """Which orientations, in which order, and whether the body returns to the first; or curves one by one.

    `start` and `end` are labels of where a searched tour begins and ends; without them it may begin
    and end anywhere. The motion comes from `home`, an attitude besides, and goes back to it.
    """

    orientations: Orientations | None = None
    bezier: Curves | None = None
    tour: Annotated[TourName | tuple[str, ...], BeforeValidator(tour_or_labels(get_args(TourName)))] = "given"
    closed: bool = False
    home: Annotated[tuple[float, ...] | None, BeforeValidator(lambda value: _unit(value))] = None
    start: Annotated[str | None, BeforeValidator(lambda value: _label(value))] = None
    end: Annotated[str | None, BeforeValidator(lambda value: _label(value))] = None

    @model_validator(mode="after")
    def _orientations_or_curves(self) -> Self:
        if self.bezier is None:
            if self.orientations is None:
                raise fault('missing key "orientations"')
            return self
        refuse_mixed(self.bezier)
        for key in ("orientations", "tour", "closed", "home", "start", "end"):
            if key in self.model_fields_set:
                raise fault("Bézier curves follow each other as they are given; leave it away", key)
        return self

    @property
    def travels(self) -> bool:
        """Whether the body's origin moves."""
        return bool(self.bezier) and all(curve.points is not None for curve in self.bezier or ())

    @model_validator(mode="after")
    def _ends_make_sense(self) -> Self:
        for key in ("start", "end"):
            if getattr(self, key) is not None and self.tour not in SEARCHED:
                raise fault(f"it belongs to a tour that is searched: {', '.join(SEARCHED)}", key)
        if self.home is not None and self.closed:
            raise fault('the motion goes back home; leave "closed" away', "home")
        if self.end is not None and self.closed:
            raise fault('a closed tour ends where it starts; leave "end" away', "end")
        if self.start is not None and self.start == self.end:
            message = f'"{self.end}" is the start too; a tour that ends where it starts is "closed: true"'
            raise fault(message, "end")
        return self


def _columns(value: Any) -> Any:
    """Names of columns, or their numbers counted from 1."""
    if not isinstance(value, list):
        return value
    if all(isinstance(v, int) and not isinstance(v, bool) for v in value):
        if value and not 1 <= min(value) <= max(value) <= MOST:
            raise fault(f"{quote(value)}; columns are counted from 1")
    elif not all(isinstance(v, str) for v in value):
        raise fault("names of columns, or their numbers counted from 1, are needed")
    return tuple(value)


def _class(value: Any) -> Any:
    """A crystal class, which YAML may take for a number, as in 432."""
    return str(value) if isinstance(value, int) and not isinstance(value, bool) else value


def _labels(value: Any) -> tuple[str, ...]:
    if not isinstance(value, list) or not value:
        raise fault("a list of labels, or of ranges such as 9-20, is needed")
    return tuple(_label(label) for label in value)


def _label(value: Any) -> str:
    if isinstance(value, bool) or not isinstance(value, str | int):
        raise fault(f"a label is a number or a text, not {shorten(repr(value))}; a text may need quotes")
    return str(value)
