"""The exercise in a problem file: numbers, units, marks, words, the answers asked for and their names."""

from __future__ import annotations

import re
from collections.abc import Mapping
from difflib import get_close_matches
from fractions import Fraction
from math import radians

from msgspec import Struct, field
from msgspec.structs import replace

from dynsolve.algebra.angles import angle_from_tree
from dynsolve.algebra.rationals import rational_value
from dynsolve.errors import AlgebraError, ReadError
from dynsolve.notation.characters import normalize
from dynsolve.notation.text import read
from dynsolve.notation.tree import Node as Tree
from dynsolve.notation.tree_values import evaluate
from dynsolve.problem.cells import Cell, read_cell
from dynsolve.problem.kinds import Fields, describe, items, nearest
from dynsolve.problem.model import FIND, Remark, Wording
from dynsolve.problem.parsed import ParsedFile
from dynsolve.problem.specification import PROBLEM
from dynsolve.problem.yaml_nodes import Faults, FaultyNode, ListNode, MappingNode, ScalarNode, YamlNode
from dynsolve.quantities.families import FAMILIES
from dynsolve.quantities.index import Quantities

# What was meant by a word that is no name of an answer: torque is tau, kinetic energy K

_CLOSE = 0.84


def answer_meant(names: Quantities, text: str) -> str:
    """The question whether an answer was meant, or a family of them, or nothing.

    >>> from dynsolve.quantities.owners import Owners
    >>> from dynsolve.robot.model import Coordinate, JointType
    >>> names = Quantities(Owners(1, (Coordinate("q1", JointType.REVOLUTE, 1),), ("1",), frozenset("1")))
    >>> [answer_meant(names, word) for word in ("Torques", "kinetic energy 1", "inertia-matrix", "foo")]
    ['did you mean `tau`?', 'did you mean `K1`?', 'did you mean `D`?', '']

    Of a family that has no such member the others are told, and no other family's.

    >>> names = Quantities(Owners(2, (Coordinate("q1", JointType.REVOLUTE, 1),), ("1", "p")))
    >>> answer_meant(names, "Jv2")
    'answers of this kind are `Jv1`, `Jvp`'
    """
    words = text.strip().lower()[:60]
    digits = words[len(words.rstrip("0123456789")) :]
    stems = ((family.stem, family.terms) for family in FAMILIES)
    called = {_folded(term): stem for stem, terms in stems for term in terms if names.members(stem)}
    close = get_close_matches(_folded(words), called, 1, _CLOSE)
    meant = called[close[0]] if close else ""
    if meant and digits:
        meant = names.canonical(meant + digits) or meant
    stem = text.strip().rstrip("0123456789")
    members = [
        name
        for name in names.examples()
        if re.fullmatch(rf"{re.escape(stem)}\{{\w\}}", names[name].family.name)
    ]
    if len(members) > 1 and not meant:
        return f"answers of this kind are {', '.join(f'`{name}`' for name in members)}"
    meant = meant or nearest(text, members or names.examples())
    return f"did you mean `{meant}`?" if meant else ""


def _folded(words: str) -> str:
    """The letters of words, without the sign of a plural."""
    return re.sub(r"[^a-z]", "", words).removesuffix("s")


# Remarks of a problem's author on results


def read_remarks(faults: Faults, node: YamlNode | None, names: Quantities | None) -> tuple[Remark, ...]:
    """The remarks of a file; `names` are None where the robot is faulty, and nothing is known of answers."""
    if node is None or isinstance(node, FaultyNode):
        return ()
    if not isinstance(node, MappingNode):
        faults.error(node.span, f"remarks is a mapping, not {describe(node)}", PROBLEM["remarks"].help)
        return ()
    found: dict[str, Remark] = {}
    for key, value in node.entries:
        texts = _texts(faults, value, key.decoded)
        name = key.decoded if names is None else names.canonical(key.decoded)
        if name is None:
            meant = answer_meant(names, key.decoded) if names else ""
            message = f"`{key.decoded[:40]}` is no result of this problem"
            faults.error(key.span, message, meant or "results are P1, Kv1, K, L, tau1, D, d11, ...")
        elif name in found:
            faults.error(key.span, f"{name} has a remark already", "write both as a list of lines")
        elif texts:
            found[name] = Remark(name, key.decoded, texts)
    return tuple(found.values())


def _texts(faults: Faults, node: YamlNode, of: str) -> tuple[str, ...]:
    """The lines of text of a remark."""
    lines = node.items if isinstance(node, ListNode) else (node,)
    for line in lines:
        if not isinstance(line, FaultyNode) and not (isinstance(line, ScalarNode) and line.decoded.strip()):
            faults.error(
                line.span, f"the remark on {of} is words, not {describe(line)}", PROBLEM["remarks"].help
            )
    return tuple(" ".join(line.decoded.split()) for line in lines if isinstance(line, ScalarNode))


# The words of an exercise sheet

BEFORE, GIVEN = "before", "given"
"""What `text` may have beside the names of answers."""


def read_text(faults: Faults, node: YamlNode | None, names: Quantities | None) -> Wording:
    """What `text` says: words that stand before, or words by `before`, `given` and the names of answers."""
    if not isinstance(node, MappingNode):
        return Wording(_worded(faults, node, "text") if node is not None else "")
    found: dict[str, str] = {}
    for key, value in node.entries:
        name = key.decoded if key.decoded in (BEFORE, GIVEN) else _answer(faults, key, names)
        if name in found:
            faults.error(key.span, f"{name} has words already", "keep one of them")
        elif name:
            found[name] = _worded(faults, value, f"the text on {key.decoded}")
    return Wording(found.pop(BEFORE, ""), found.pop(GIVEN, ""), found)


def _worded(faults: Faults, node: YamlNode, what: str) -> str:
    """Words on one line; those between dollar signs are formulas."""
    if isinstance(node, FaultyNode):
        return ""
    if not (isinstance(node, ScalarNode) and node.decoded.strip()):
        faults.error(node.span, f"{what} is words, not {describe(node)}", PROBLEM["text"].help)
        return ""
    words, *pieces = node.decoded.split("$")
    if len(pieces) % 2:
        faults.error(node.span, f"{what}: a formula has no closing $", "write $m1*g$, or leave the sign out")
        return ""
    for formula in pieces[::2]:
        try:
            read(formula)
        except ReadError as error:
            faults.error(node.span, f"{what}: ${formula[:40]}$: {error.message}", error.help)
    return " ".join("$".join((words, *pieces)).split())


# Numbers, units, marks, the answers asked for

_UNIT = re.compile(r"[A-Za-zµμΩ°%0-9²³⁻¹·*/^ .()-]{1,30}")
_FIND_HELP = PROBLEM["find"].help


class Exercise(Struct, frozen=True):
    """The optional keys of a file."""

    find: tuple[str, ...]
    marks: Mapping[str, Fraction]
    values: Mapping[str, Fraction]
    written: Mapping[str, str]
    units: Mapping[str, str]
    remarks: tuple[Remark, ...] = ()
    text: Wording = field(default_factory=Wording)
    asked: frozenset[str] = frozenset()
    """The answers asked for that a derivation has only where they are."""


def read_exercise(faults: Faults, fields: Fields, parsed: ParsedFile) -> Exercise:
    """The values, units, marks and answers asked for; everything wrong with them is reported."""
    names = None  # as long as the table or a body is faulty, which answers there are is not known
    if parsed.sound and not {"find", "marks", "remarks", "text"}.isdisjoint(fields):
        names = Quantities(parsed.owners)
    values, written = _read_values(faults, fields.get("values"))
    find = _read_find(faults, fields.get("find"), names)
    marks = _read_marks(faults, fields.get("marks"), names)
    return Exercise(
        find=find or tuple(marks) or (("definite",) if parsed.is_of_matrices else FIND),
        marks=marks,
        values=values,
        written=written,
        units=_read_units(faults, fields.get("units")),
        remarks=read_remarks(faults, fields.get("remarks"), names),
        text=read_text(faults, fields.get("text"), names),
        asked=frozenset(
            name for name in (*find, *marks) if names is not None and names[name].family.stage.asked_for
        )
        or frozenset(("definite",) if parsed.is_of_matrices else ()),
    )


def _read_find(faults: Faults, node: YamlNode | None, names: Quantities | None) -> tuple[str, ...]:
    listed = (
        (node,) if isinstance(node, ScalarNode) and node.text else items(faults, node, "find", _FIND_HELP)
    )
    found: dict[str, None] = {}
    for item in listed:
        for name in _answers(faults, item, names):
            if name in found:
                faults.error(item.span, f"{name} is asked for twice", "keep one of them")
            found[name] = None
    return tuple(found)


def _answers(faults: Faults, node: YamlNode, names: Quantities | None) -> tuple[str, ...]:
    """The answers that an item of `find` asks for: one, or all of a family."""
    family = names.members(node.text) if names is not None and isinstance(node, ScalarNode) else ()
    if family:
        return family
    name = _answer(faults, node, names)
    return (name,) if name else ()


def _answer(faults: Faults, node: YamlNode, names: Quantities | None) -> str | None:
    if isinstance(node, FaultyNode):
        return None
    if not isinstance(node, ScalarNode):
        faults.error(node.span, f"the name of an answer is expected, not {describe(node)}", _FIND_HELP)
        return None
    if names is None:
        return node.text
    canonical = names.canonical(node.text)
    if canonical is None and (key := _lacking(names, node.text)):
        faults.error(node.span, f"`{node.text}` is found from `{key}`, which is not given", PROBLEM[key].help)
    elif canonical is None:
        help = answer_meant(names, node.text) or f"answers are {', '.join(FIND)}, P, K, L, K1, tau1, d11, ..."
        faults.error(node.span, f"`{node.text[:40]}` is no answer of this problem", help)
    return canonical


def _lacking(names: Quantities, text: str) -> str:
    """The key without which alone a file has no answer of this name; nothing where that is not why."""
    return next(
        (
            family.needs
            for family in FAMILIES
            if family.name == text
            and family.needs in PROBLEM.names
            and replace(names.owners, given=names.owners.given | {family.needs}).has(family)
        ),
        "",
    )


def _entries(faults: Faults, node: YamlNode | None, key: str) -> tuple[tuple[ScalarNode, YamlNode], ...]:
    if isinstance(node, MappingNode):
        return node.entries
    if node is not None and not isinstance(node, FaultyNode):
        faults.error(node.span, f"{key} is a mapping, not {describe(node)}", PROBLEM[key].help)
    return ()


def _read_marks(faults: Faults, node: YamlNode | None, names: Quantities | None) -> dict[str, Fraction]:
    marks: dict[str, Fraction] = {}
    for key, value in _entries(faults, node, "marks"):
        name = _answer(faults, key, names)
        points = _number(faults, value, f"the marks for {key.decoded}")
        if points is not None and points < 0:
            faults.error(value.span, f"the marks for {key.decoded} are negative", "write 0 or more points")
        elif name in marks:
            faults.error(
                key.span, f"{name} has marks already, under another of its names", "keep one of them"
            )
        elif name and points is not None:
            marks[name] = points
    return marks


def _read_values(faults: Faults, node: YamlNode | None) -> tuple[dict[str, Fraction], dict[str, str]]:
    """The values as numbers, and as they are written."""
    values: dict[str, Fraction] = {}
    written: dict[str, str] = {}
    for key, value in _entries(faults, node, "values"):
        name = _symbol(faults, key)
        number = _number(faults, value, f"the value of {key.decoded}", angles=True)
        if name in values:
            faults.error(key.span, f"{name} has a value already, in another spelling", "keep one of them")
        elif name and number is not None and isinstance(value, ScalarNode):
            values[name], written[name] = number, value.text
    return values, written


def _read_units(faults: Faults, node: YamlNode | None) -> dict[str, str]:
    units: dict[str, str] = {}
    for key, value in _entries(faults, node, "units"):
        name = _symbol(faults, key)
        if isinstance(value, ScalarNode) and _UNIT.fullmatch(value.decoded):
            if name:
                units[name] = value.decoded
        elif not isinstance(value, FaultyNode):
            faults.error(
                value.span,
                f"the unit of {key.decoded} cannot be {describe(value)}",
                "write m, kg, m/s^2, kg m^2",
            )
    return units


def _symbol(faults: Faults, key: ScalarNode) -> str | None:
    try:
        return normalize(key.decoded)
    except ReadError as error:
        at = key.start + error.offset
        faults.error((at, at + error.length), error.message, error.help)
        return None


def _number(faults: Faults, node: YamlNode, what: str, *, angles: bool = False) -> Fraction | None:
    """A number, an angle in radians where `angles`; None (reported) for what is none."""
    cell = read_cell(faults, node, what)
    if cell is None:
        return None
    value = rational_value(cell.tree)
    if value is None and angles:
        value = _radians(cell.tree) or _constant(cell)
    if value is None:
        help = "write a number: 0.4, 2, 1/3" + (", sqrt(2)/2, or 30deg" if angles else "")
        faults.error(cell.span, f"{what} is not a number", help)
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
