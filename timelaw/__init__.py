"""Time laws for a rigid body that visits a set of orientations: optimised, certified, reported.

Conventions, everywhere: quaternions are scalar first (w, x, y, z), Hamilton, active, body to
world, r_world = R(q) r_body; q and -q are one orientation. Body rates are in body axes, units
are SI with radians. A leg between two orientations turns the body by θ = 2 arccos|q_i·q_j|
about the unit axis n, and its easing s = f(τ), τ = (t - t_k)/T_k, gives
ω = θ f'(τ)/T n, α = θ f''(τ)/T² n, jerk j = θ f'''(τ)/T³ n.
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from timelaw.pipeline import Design as Design
    from timelaw.pipeline import design as design

__version__ = "0.1.0"
__all__ = ["Design", "__version__", "design"]


def __getattr__(name: str) -> Any:
    """Load the pipeline on first use, so that `timelaw --help` starts without it."""
    if name in ("design", "Design"):
        import timelaw.pipeline as pipeline

        return getattr(pipeline, name)
    raise AttributeError(f"module 'timelaw' has no attribute {name!r}")
