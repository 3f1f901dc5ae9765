r"""Sines and cosines by their first letter: `c\theta_1`, `s(q_1 + q_2)`, `C_{\theta_1}`, `c_{1-2}`."""

from __future__ import annotations

from dynsolve.answers.reading.grammar.forms import Form
from dynsolve.answers.reading.grammar.reader import Reader
from dynsolve.answers.reading.grammar.references import only_coordinates
from dynsolve.answers.reading.grids import Value
from dynsolve.answers.reading.vocabulary import Vocabulary
from dynsolve.errors import ReadError
from dynsolve.notation.tree import (
    Function,
    Negative,
    Node,
    Sum,
    Symbol,
)
from dynsolve.quantities.spelling import key
from dynsolve.robot.model import JointType


def is_short_function(reader: Reader) -> bool:
    r"""Whether a bare c or s here is a cosine or a sine: `c\theta_1`, `s(q_1 + q_2)`."""
    token, after = reader.token, reader.peek()
    if token.kind != "name" or token.text not in ("c", "s", "C", "S") or token.dots:
        return False
    if reader.vocabulary.symbol(token.text) is not None or reader.naming:
        return False
    if after.kind == "(":
        if reader.peek(2).kind == "number" and reader.peek(3).kind == ")":
            return False
        if "vectors" in reader.options and only_coordinates(reader, reader.position + 1):
            return False
        return token.text in "cs" or not only_coordinates(reader, reader.position + 1)
    if after.kind == "letter":
        return after.text in ("theta", "phi", "alpha", "beta", "psi", "gamma")
    if after.kind != "name" or after.dots:
        return False
    meaning = reader.vocabulary.symbol(key(after.text))
    q = reader.vocabulary.coordinate(meaning.value) if meaning and isinstance(meaning.value, Symbol) else None
    return q is not None and q.type is JointType.REVOLUTE


def short_function(reader: Reader, form: Form) -> Function:
    """C_{theta_1}, s_{q_1 + q_2}, c_{1-2}: the sine or cosine of the angle in the index."""
    angle: Value | None = _digits_angle(reader.vocabulary, form)
    if angle is None:
        angle = reader.inner(form.angle, naming=False)
    if not isinstance(angle, Node):
        raise ReadError(
            "this index is no angle",
            form.start,
            form.end - form.start,
            "write c_1, c_{12} or \\cos(\\theta_1)",
        )
    return Function("sin" if form.base in "sS" else "cos", angle)


def _digits_angle(vocabulary: Vocabulary, form: Form) -> Node | None:
    """The angle of an index such as 1+2 or 2-1."""
    if not all(t.kind in ("number", "+", "-") for t in form.angle):
        return None
    terms: list[Node] = []
    sign = "+"
    for token in form.angle:
        if token.kind != "number":
            sign = token.kind
            continue
        part = vocabulary.angle_of(token.text)
        if part is None:
            return None
        terms.append(Negative(part) if sign == "-" else part)
    if not terms:
        return None
    return terms[0] if len(terms) == 1 else Sum(tuple(terms))
