"""The part of a problem file about limits: the keys of the registry, each with its unit."""

from typing import TYPE_CHECKING, Annotated, Any, Self

from pydantic import create_model, model_validator

from timelaw.limits import LIMITS, Bounds
from timelaw.problem.fields import Model, bounds, fault


class LimitsModel(Model):
    """Bounds on the body's motion, each on a norm or on three body axes, each optional."""

    @model_validator(mode="after")
    def _some(self) -> Self:
        if not self.given():
            raise fault(f"at least one of {', '.join(LIMITS)} must be given")
        if not any(LIMITS[name].sufficient for name in self.given()):
            *others, last = [name for name, kind in LIMITS.items() if kind.sufficient]
            names = ", ".join(self.given())
            message = f"{names} alone is not enough; limit the {', '.join(others)} or {last} too"
            raise fault(message)
        return self

    def given(self) -> dict[str, Bounds]:
        """The limits that are set, by name, in SI."""
        return {name: value for name, value in self if value is not None}


if TYPE_CHECKING:
    Limits = LimitsModel
else:
    _FIELDS: dict[str, Any] = {
        name: (Annotated[Bounds | None, bounds(kind.quantity)], None) for name, kind in LIMITS.items()
    }
    Limits = create_model("Limits", __base__=LimitsModel, __doc__=LimitsModel.__doc__, **_FIELDS)
