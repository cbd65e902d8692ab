"""Easings u = f(τ) along Bézier curves, and how long each curve takes."""

from typing import Any

from timelaw.pipeline_bezier import BezierDesign
from timelaw.report.figures.drawn import Scene
from timelaw.report.figures.easings import draw_timings
from timelaw.report.figures.style import Canvas


def draw_curve_easings(scene: Scene, canvas: Canvas) -> Any:
    """f(τ) and f'(τ) of each curve over the smoothstep, and their durations."""
    design: BezierDesign = scene.design
    names = [curve.name for curve in design.curves]
    easings = scene.sample_easings(design.timings)
    return draw_timings(scene, easings, names, ("u = f(τ)", "its slope f′(τ)"), canvas)
