"""Time laws for a rigid body that visits a set of orientations: optimised, certified, reported.

Conventions, everywhere: quaternions are scalar first (w, x, y, z), Hamilton, active, body to
world, r_world = R(q) r_body; q and -q are one orientation. Body rates are in body axes, units
are SI with radians. A leg between two orientations turns the body by θ = 2 arccos|q_i·q_j|
about the unit axis n, and its easing s = f(τ), τ = (t - t_k)/T_k, gives
ω = θ f'(τ)/T n, α = θ f''(τ)/T² n, jerk j = θ f'''(τ)/T³ n.

    design(path or dict)  a problem's law, with its certificate and baselines: `.law`
    load("law.json")      a law from its file
    certify(law)          what is proved of it: `.holds`, `.findings()`
    quaternion            quaternion algebra on arrays
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from timelaw import quaternion as quaternion
    from timelaw.certificate import certify as certify
    from timelaw.face import design as design
    from timelaw.face import load as load

__version__ = "0.1.0"
__all__ = ["certify", "design", "load", "quaternion"]
_HOMES = {"design": "timelaw.face", "load": "timelaw.face", "certify": "timelaw.certificate"}


def __dir__() -> list[str]:
    """What the package is for; its rooms are imported by their names."""
    return [*__all__, "__doc__", "__name__", "__version__"]


def __getattr__(name: str) -> Any:
    """Load what is asked for on first use, so that `timelaw --help` starts without it."""
    if name == "quaternion":
        return import_module("timelaw.quaternion")
    if name in _HOMES:
        return getattr(import_module(_HOMES[name]), name)
    raise AttributeError(f"module 'timelaw' has no attribute {name!r}")
