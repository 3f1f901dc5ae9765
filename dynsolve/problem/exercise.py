"""What a problem file says about the exercise: numbers, units, marks, what is asked for."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from math import radians

from dynsolve.algebra.angles import angle_from_tree
from dynsolve.algebra.ring_plan import rational_value
from dynsolve.errors import AlgebraError, ReadError
from dynsolve.notation.evaluate import evaluate
from dynsolve.notation.names import normalize
from dynsolve.notation.tree import Node as Tree
from dynsolve.problem.answer_names import AnswerNames
from dynsolve.problem.cells import Cell, read_cell
from dynsolve.problem.fields import Fields, describe, did_you_mean, items
from dynsolve.problem.model import FIND
from dynsolve.problem.sheet import Sheet
from dynsolve.problem.source import Faults
from dynsolve.problem.specification import PROBLEM
from dynsolve.problem.yaml_nodes import Faulty, Scalar, YamlNode
from dynsolve.problem.yaml_nodes import Mapping as MappingNode

_UNIT = re.compile(r"[A-Za-zµμΩ°%0-9²³⁻¹·*/^ .()-]{1,30}")
_FIND_HELP = PROBLEM["find"].help


@dataclass(frozen=True, slots=True)
class Exercise:
    """The optional keys of a file."""

    find: tuple[str, ...]
    marks: Mapping[str, Fraction]
    values: Mapping[str, Fraction]
    written: Mapping[str, str]
    units: Mapping[str, str]


def read_exercise(report: Faults, fields: Fields, sheet: Sheet) -> Exercise:
    """The values, units, marks and answers asked for; everything wrong with them is reported."""
    forces = [
        f"{'tau' if kind == 'revolute' else 'f'}{i}" for i, (_, kind) in enumerate(sheet.table.coordinates, 1)
    ]
    names = None  # as long as the table or a body is faulty, which answers there are is not known
    if sheet.table.sound and not any(body.faulty for body in sheet.bodies):
        names = AnswerNames(len(sheet.table.rows), forces, [body.name for body in sheet.bodies])
    values, written = _read_values(report, fields.get("values"))
    return Exercise(
        find=_read_find(report, fields.get("find"), names) or FIND,
        marks=_read_marks(report, fields.get("marks"), names),
        values=values,
        written=written,
        units=_read_units(report, fields.get("units")),
    )


def _read_find(report: Faults, node: YamlNode | None, names: AnswerNames | None) -> tuple[str, ...]:
    listed = (node,) if isinstance(node, Scalar) and node.text else items(report, node, "find", _FIND_HELP)
    found: dict[str, None] = {}
    for item in listed:
        name = _answer(report, item, names)
        if name in found:
            report.error(item.span, f"{name} is asked for twice", "keep one of them")
        elif name:
            found[name] = None
    return tuple(found)


def _answer(report: Faults, node: YamlNode, names: AnswerNames | None) -> str | None:
    if isinstance(node, Faulty):
        return None
    if not isinstance(node, Scalar):
        report.error(node.span, f"the name of an answer is expected, not {describe(node)}", _FIND_HELP)
        return None
    if names is None:
        return node.text
    canonical = names.canonical(node.text)
    if canonical is None:
        help = (
            did_you_mean(node.text, names.examples())
            or f"answers are {', '.join(FIND)}, P, K, L, K1, tau1, d11, ..."
        )
        report.error(node.span, f"`{node.text[:40]}` is no answer of this problem", help)
    return canonical


def _entries(report: Faults, node: YamlNode | None, key: str) -> tuple[tuple[Scalar, YamlNode], ...]:
    if isinstance(node, MappingNode):
        return node.entries
    if node is not None and not isinstance(node, Faulty):
        report.error(node.span, f"{key} is a mapping, not {describe(node)}", PROBLEM[key].help)
    return ()


def _read_marks(report: Faults, node: YamlNode | None, names: AnswerNames | None) -> dict[str, Fraction]:
    marks: dict[str, Fraction] = {}
    for key, value in _entries(report, node, "marks"):
        name = _answer(report, key, names)
        points = _number(report, value, f"the marks for {key.decoded}")
        if points is not None and points < 0:
            report.error(value.span, f"the marks for {key.decoded} are negative", "write 0 or more points")
        elif name in marks:
            report.error(
                key.span, f"{name} has marks already, under another of its names", "keep one of them"
            )
        elif name and points is not None:
            marks[name] = points
    return marks


def _read_values(report: Faults, node: YamlNode | None) -> tuple[dict[str, Fraction], dict[str, str]]:
    """The values as numbers, and as they are written."""
    values: dict[str, Fraction] = {}
    written: dict[str, str] = {}
    for key, value in _entries(report, node, "values"):
        name = _symbol(report, key)
        number = _number(report, value, f"the value of {key.decoded}", angles=True)
        if name in values:
            report.error(key.span, f"{name} has a value already, in another spelling", "keep one of them")
        elif name and number is not None and isinstance(value, Scalar):
            values[name], written[name] = number, value.text
    return values, written


def _read_units(report: Faults, node: YamlNode | None) -> dict[str, str]:
    units: dict[str, str] = {}
    for key, value in _entries(report, node, "units"):
        name = _symbol(report, key)
        if isinstance(value, Scalar) and _UNIT.fullmatch(value.decoded):
            if name:
                units[name] = value.decoded
        elif not isinstance(value, Faulty):
            report.error(
                value.span,
                f"the unit of {key.decoded} cannot be {describe(value)}",
                "write m, kg, m/s^2, kg m^2",
            )
    return units


def _symbol(report: Faults, key: Scalar) -> str | None:
    try:
        return normalize(key.decoded)
    except ReadError as error:
        at = key.start + error.offset
        report.error((at, at + error.length), error.message, error.help)
        return None


def _number(report: Faults, node: YamlNode, what: str, *, angles: bool = False) -> Fraction | None:
    """A number, an angle in radians where `angles`; None (reported) for what is none."""
    cell = read_cell(report, node, what)
    if cell is None:
        return None
    value = rational_value(cell.tree)
    if value is None and angles:
        value = _radians(cell.tree) or _constant(cell)
    if value is None:
        help = "write a number: 0.4, 2, 1/3" + (", sqrt(2)/2, or 30deg" if angles else "")
        report.error(cell.span, f"{what} is not a number", help)
    return value


def _radians(tree: Tree) -> Fraction | None:
    """The value in radians of a constant angle: 30deg, pi/6."""
    try:
        angle = angle_from_tree(tree)
    except AlgebraError:
        return None
    return Fraction(radians(float(angle.degrees))) if angle.is_constant else None


def _constant(cell: Cell) -> Fraction | None:
    """The value of a formula without names, a root among its parts; to double precision."""
    if cell.names:
        return None
    try:
        return Fraction(evaluate(cell.tree, {}))
    except (ArithmeticError, ValueError):
        return None
