"""The one expression of the whole motion [MMB2017]: its evaluator, its plain text read by Python, its LaTeX by matplotlib."""

import re

import numpy as np
import pytest
from matplotlib.mathtext import MathTextParser

from tests.laws import LAWS, law_of
from timelaw.export.exporter import Options
from timelaw.export.formula import evaluate_formula, evaluate_step, list_terms
from timelaw.export.registry import EXPORTERS
from timelaw.numerics.quaternion import normalise


def spare(law, t):
    """Those of the instants that are no ends of a term or span, where the formula is 0/0."""
    ends = {x for term in list_terms(law) for s in (term, *term.spans) for x in (s.a, s.b)}
    return np.array([x for x in t if x not in ends])


def read_plain(text):
    """The expression as Python reads it: powers, and brackets about vectors."""
    names = {"sqrt": np.sqrt, "sin": np.sin, "dot": np.dot, "array": np.array}
    for line in (line for line in text.splitlines() if not line.startswith("#")):
        head, body = line.split(" = ", 1)
        name, arguments = head.rstrip(")").split("(")
        body = re.sub(r"\[([^\]]*)\]", r"array([\1])", body).replace("^", "**")
        names[name] = eval(f"lambda {arguments}: {body}", names)
    return names["q"]


@pytest.mark.parametrize("name", LAWS)
def test_the_formula_is_the_law_everywhere_but_at_the_nodes(name):
    law = law_of(name)
    t = spare(law, np.linspace(0, law.duration, 3001)[1:-1])
    np.testing.assert_allclose(evaluate_formula(law, t), law(t), atol=2e-13)
    assert np.isnan(evaluate_formula(law, law.times)).all()  # 0/0, as the paper's step has it


@pytest.mark.parametrize("name", LAWS)
def test_the_plain_text_is_the_law_by_itself(name):
    law = law_of(name)
    q = read_plain(EXPORTERS["formula"].write(law, Options())[".txt"])
    t = spare(law, np.linspace(0, law.duration, 62)[1:-1])
    np.testing.assert_allclose([q(x) for x in t], law(t), atol=2e-13)


def test_the_step_is_the_papers():
    t = np.array([-1.0, 0.0, 0.5, 1.0, 2.0])
    np.testing.assert_array_equal(evaluate_step(t, 0.0, 1.0), [0, np.nan, 1, np.nan, 0])


def test_equal_legs_of_the_papers_tour_are_formula_1():
    """λ = (1/√3) Σ [1 + …]{λ_k sin(π/3 (1 - f_k)) + λ_(k+1) sin(π/3 f_k)}; the sum ends at k = 10."""
    law = law_of("paper")
    nodes = [segment.start for segment in law.segments] + [law.segments[-1].end]
    t = spare(law, np.linspace(0, law.duration, 500)[1:-1])
    value = np.zeros((len(t), 4))
    for k in range(11):
        a, b = law.times[k], law.times[k + 1]
        bracket = 1 + (t - a) / np.sqrt((t - a) ** 2) * (b - t) / np.sqrt((b - t) ** 2)
        turned = law.segments[k](((t - a) / (b - a)).clip(0, 1), 0, "right")
        f = 3 * np.arccos((turned @ normalise(nodes[k])).clip(-1, 1)) / np.pi
        terms = np.outer(np.sin(np.pi / 3 * (1 - f)), nodes[k]) + np.outer(
            np.sin(np.pi / 3 * f), nodes[k + 1]
        )
        value += bracket[:, None] * terms / np.sqrt(3)
    np.testing.assert_allclose(evaluate_formula(law, t), value, atol=1e-7)  # arccos loses half the digits


@pytest.mark.parametrize("name", ["spline", "points"])
def test_every_line_of_the_latex_can_be_set(name):
    text = EXPORTERS["formula"].write(law_of(name), Options())[".tex"]
    assert text.count(r"\begin{gather*}") == text.count(r"\end{gather*}") == 1
    body = re.search(r"\\begin\{gather\*\}\n(.*)\\end", text, re.DOTALL).group(1)
    lines = [line.removesuffix(" \\\\") for line in body.splitlines()]
    assert len(lines) > len(law_of(name).segments)
    for line in lines:
        MathTextParser("path").parse(f"${line}$")
