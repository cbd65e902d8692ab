"""The one expression of a whole motion as plain text, which programs can evaluate, and as LaTeX [MMB2017]."""

import re
from collections.abc import Iterator, Sequence
from math import comb

from timelaw.export.exporter import Exporter, Options
from timelaw.export.formula import Span, Term, list_terms
from timelaw.motion import QuaternionLaw
from timelaw.numerics.array import Array

HEAD = """\
# {name}: the orientation as one expression in t [s], 0 < t < {duration} [MMB2017]
# q = [w, x, y, z], Hamilton, active, body to world; H is 1 between a and b, 0 elsewhere, 0/0 at a and b:
# the expression has no value at the nodes, nor where the pieces of an easing meet
H(t, a, b) = (1 + (t - a)/sqrt((t - a)^2)*(b - t)/sqrt((b - t)^2))/2
"""
TEX_HEAD = r"""% {name}: needs amsmath; the expression is 0/0 at the nodes and where the pieces of an easing meet
\begin{{gather*}}
H_{{a,b}}(t) = \frac{{1}}{{2}} \left[ 1 + \frac{{t - a}}{{\sqrt{{(t - a)^2}}}} \cdot \frac{{b - t}}{{\sqrt{{(b - t)^2}}}} \right] \\
"""  # noqa: E501
TEX_END = "\\end{gather*}\n"


def write_formula(law: QuaternionLaw, options: Options) -> dict[str, str]:  # noqa: ARG001
    """The plain text, and LaTeX."""
    terms = list_terms(law)
    return {".txt": _write_plain(law, terms), ".tex": _write_tex(law, terms)}


def _clean(name: str) -> str:
    return re.sub(r"[^A-Za-z0-9._ -]", "_", name)


def _write_plain(law: QuaternionLaw, terms: Sequence[Term]) -> str:
    lines, parts = [], []
    for k, term in enumerate(terms, 1):
        step = f"H(t, {term.a!r}, {term.b!r})"
        if term.spans:
            name = f"Q{k}" if term.arc is None else f"f{k}"
            lines.append(f"{name}(t) = {_plain_spans(term.spans)}")
        if not term.spans:
            parts.append(f"{step}*{_plain_vector(term.start)}")
        elif term.arc is None:
            parts.append(f"{step}*Q{k}(t)/sqrt(dot(Q{k}(t), Q{k}(t)))")
        else:
            before = f"{_plain_vector(term.start)}*sin({term.arc!r}*(1 - f{k}(t)))"
            after = f"{_plain_vector(term.end)}*sin({term.arc!r}*f{k}(t))"
            parts.append(f"{step}*({before} + {after})/sin({term.arc!r})")
    head = HEAD.format(name=_clean(law.name), duration=repr(law.duration))
    return head + "\n".join([*lines, "q(t) = " + " + ".join(parts)]) + "\n"


def _plain_spans(spans: Sequence[Span]) -> str:
    """Σ H·polynomial; of a single piece the segment's own H is enough."""
    found = []
    for span in spans:
        u = f"((t - {span.a!r})/{span.b - span.a!r})"
        polynomial = " + ".join(
            "*".join([_plain_coefficient(c), *_powers(u, f"(1 - {u})", i, len(span.control) - 1, "^{}")])
            for i, c in _nonzero(span.control)
        )
        found.append(f"H(t, {span.a!r}, {span.b!r})*({polynomial})" if len(spans) > 1 else polynomial)
    return " + ".join(found)


def _nonzero(control: Array) -> Iterator[tuple[int, Array]]:
    """The coefficients c_i C(n, i) that are not zero; of none the last one."""
    degree = len(control) - 1
    rows = [(i, row * comb(degree, i)) for i, row in enumerate(control)]
    yield from [pair for pair in rows if pair[1].any()] or rows[-1:]


def _powers(u: str, v: str, i: int, degree: int, power: str) -> Iterator[str]:
    """u^i and (1 - u)^(n - i), those with exponents of zero left out."""
    for base, exponent in ((u, i), (v, degree - i)):
        if exponent:
            yield base + (power.format(exponent) if exponent > 1 else "")


def _plain_coefficient(c: Array) -> str:
    return repr(float(c[0])) if len(c) == 1 else _plain_vector(c)


def _plain_vector(v: Array) -> str:
    return "[" + ", ".join(repr(x + 0.0) for x in v.tolist()) + "]"


def _write_tex(law: QuaternionLaw, terms: Sequence[Term]) -> str:
    parts, lines = [], []
    for k, term in enumerate(terms, 1):
        step = rf"H_{{t_{{{k - 1}}},t_{{{k}}}}}(t)"
        lines.append(rf"t_{{{k}}} = {_tex_number(term.b)}")
        if not term.spans:
            parts.append(rf"{step}\, \lambda_{{{k}}}")
            lines.append(rf"\lambda_{{{k}}} = {_tex_vector(term.start)}")
            continue
        name = f"Q_{{{k}}}" if term.arc is None else f"f_{{{k}}}"
        if term.arc is None:
            parts.append(rf"{step}\, \frac{{{name}}}{{\sqrt{{{name} \cdot {name}}}}}")
        else:
            arc = rf"\vartheta_{{{k}}}"
            ends = rf"\lambda_{{{k}}} \sin({arc} (1 - {name})) + \mu_{{{k}}} \sin({arc} {name})"
            parts.append(rf"{step}\, \frac{{{ends}}}{{\sin {arc}}}")
            lines.append(
                rf"{arc} = {_tex_number(term.arc)}, \quad \lambda_{{{k}}} = {_tex_vector(term.start)}, \quad "
                rf"\mu_{{{k}}} = {_tex_vector(term.end)}"
            )
        lines += _tex_spans(name, term.spans)
    whole = r" \\" + "\n" + "+ "
    expression = r"\lambda(t) = " + whole.join(parts)
    head = TEX_HEAD.format(name=_clean(law.name))
    return (
        head
        + (r" \\" + "\n").join([expression, rf"t_{{0}} = {_tex_number(terms[0].a)}", *lines])
        + "\n"
        + TEX_END
    )


def _tex_spans(name: str, spans: Sequence[Span]) -> Iterator[str]:
    """A line for each piece."""
    for index, span in enumerate(spans):
        u = rf"\left( \frac{{t - {_tex_number(span.a)}}}{{{_tex_number(span.b - span.a)}}} \right)"
        v = rf"\left( \frac{{{_tex_number(span.b)} - t}}{{{_tex_number(span.b - span.a)}}} \right)"
        polynomial = " + ".join(
            r" \, ".join([_tex_coefficient(c), *_powers(u, v, i, len(span.control) - 1, "^{{{}}}")])
            for i, c in _nonzero(span.control)
        )
        if len(spans) > 1:
            step = rf"H_{{{_tex_number(span.a)},{_tex_number(span.b)}}}(t)"
            polynomial = rf"{step} \left[ {polynomial} \right]"
        yield f"{'+ ' if index else name + ' = '}{polynomial}"


def _tex_coefficient(c: Array) -> str:
    return _tex_number(float(c[0])) if len(c) == 1 else _tex_vector(c)


def _tex_vector(v: Array) -> str:
    return r"\left( " + ", ".join(_tex_number(x + 0.0) for x in v.tolist()) + r" \right)"


def _tex_number(value: float) -> str:
    """Brackets about what is negative, and powers of ten."""
    mantissa, sign, exponent = repr(value).partition("e")
    text = rf"{mantissa} \cdot 10^{{{int(exponent)}}}" if sign else mantissa
    return rf"\left( {text} \right)" if value < 0 or sign else text


FORMULA = Exporter(
    "formula.txt",
    write_formula,
    "the orientation as one algebraic expression [MMB2017], as plain text and LaTeX",
    "rates, place; it is 0/0 at the nodes",
    (),
)
