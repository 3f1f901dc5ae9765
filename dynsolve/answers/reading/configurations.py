r"""Answers that are sets: singular configurations, and the branches of the inverse kinematics.

    singular: [sin(q2) = 0, "q2 = 0 and sin(q3) = 0"]
    inverse:
      - {q1: atan2(py, px), q3: ±acos((px^2 + py^2 - l1^2 - l2^2)/(2*l1*l2)), q2: ...}

Alternatives are the items of a list; equations that hold together are joined by `and`, or are a
list of their own.  A branch is a mapping from coordinates to formulas, or a list of these in the order
of the coordinates; `none` is no branch at all.  `±` stands for two branches
(alternatives), linked with every other ± of the same branch, and against every ∓ of it; `k*pi`
with a letter that means nothing else, for all whole multiples.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from functools import partial
from itertools import groupby, islice, product

from dynsolve.answers.reading import yaml_values
from dynsolve.answers.reading.displays import chain
from dynsolve.answers.reading.equation_reader import EquationReader
from dynsolve.answers.reading.loose_lists import loose_node
from dynsolve.answers.reading.right_side import RightSide, read_right_side
from dynsolve.answers.reading.set_text import alternatives, joined
from dynsolve.answers.reading.tokens.lexer import Token
from dynsolve.answers.reading.tokens.prepare import prepared
from dynsolve.answers.reading.vocabulary import Vocabulary
from dynsolve.answers.reading.yaml_values import NotYaml, YamlNode
from dynsolve.answers.submission import ConfigurationAnswer, Part, Place
from dynsolve.errors import ReadError
from dynsolve.notation.build import negated, total
from dynsolve.notation.tree import ZERO, Node, Reference
from dynsolve.notation.walk import names_in, walk, with_atan2_exchanged
from dynsolve.quantities.family import Kind
from dynsolve.quantities.spelling import key

MOST_ITEMS = 64
"""More alternatives, with every ± written out, are not read."""

_EITHER = re.compile(r"±|\\pm\b|\+/-")
_OPPOSITE = re.compile(r"∓|\\mp\b|-/\+")
_NONE = re.compile(r"(?:none|no solutions?|empty|unreachable|out of reach|∅)\.?", re.IGNORECASE)


def read_configurations(
    reader: EquationReader,
    name: str,
    place: Place,
    text: str,
    node: YamlNode | None,
    *,
    takes_x_first: bool = False,
) -> None:
    """Read the alternatives of a set; what cannot be read makes the answer unreadable, with its reason.

    `takes_x_first` says that the student's atan2 takes x first.
    """
    kind = reader.vocabulary.quantities[name].family.kind
    written = text.strip() if node is None else ""
    try:
        source, root = (text, _parsed(text)) if node is None else (text, node)
        written = source[root.start : root.end].strip()
        items = list(islice(_alternatives(reader.vocabulary, source, root, kind), MOST_ITEMS + 1))
        if len(items) > MOST_ITEMS:
            raise ReadError(f"more than {MOST_ITEMS} alternatives", 0, 1, "write fewer")
        read = tuple(tuple(_part(reader.vocabulary, *part) for part in item) for item in items)
        if kind is Kind.EQUATIONS:
            _check_values(reader.vocabulary, items, read)
        if takes_x_first:
            read = tuple(tuple(_turned_round(part) for part in item) for item in read)
    except ReadError as error:
        found = ConfigurationAnswer(name, place, written, fault=error.message, expected=error.help)
    else:
        found = ConfigurationAnswer(name, place, written, read)
    reader.found.configurations.append(found)


def _check_values(vocabulary: Vocabulary, items: Iterable[_Item], read: Iterable[Sequence[Part]]) -> None:
    """The 0 of `[0, pi]` is a value of an unknown coordinate."""
    for item, parts in zip(items, read, strict=True):
        for (_, text), part in zip(item, parts, strict=True):
            if "=" not in text and not _has_coordinate(vocabulary, part.node):
                raise ReadError(f"`{text.strip()[:60]}` is no equation", 0, 1, "write [q2 = 0, q2 = pi]")


def _parsed(text: str) -> YamlNode:
    """A value that stands in a file that YAML refuses, read by itself."""
    try:
        (root,) = yaml_values.documents(text)
    except (NotYaml, ValueError):
        found = loose_node(text)
        if found is None:
            raise ReadError(
                "a bracket never closes", 0, 1, "write a list: [sin(q2) = 0, cos(q3) = 0]"
            ) from None
        return found
    return root


_Item = tuple[tuple[str, str], ...]
"""An alternative: (coordinate or nothing, text) for each of its formulas."""


def _alternatives(vocabulary: Vocabulary, text: str, root: YamlNode, kind: Kind) -> Iterator[_Item]:
    items = yaml_values.items_of(text, root) if root.style == "list" else [root]
    if kind is Kind.BRANCHES:
        yield from _branches(vocabulary, text, root, items)
    elif not (len(items) == 1 and _is_none(text, items[0])):
        for texts in _texts(text, items):
            each = [
                alternatives(one, partial(_is_name, vocabulary), partial(_is_value, vocabulary))
                for one in texts
            ]
            for chosen in product(*each):
                yield from _signed(tuple(("", equation) for one in chosen for equation in one))


def _branches(
    vocabulary: Vocabulary, text: str, root: YamlNode, items: Sequence[YamlNode]
) -> Iterator[_Item]:
    if _is_none(text, root):
        return
    names = [q.name for q in vocabulary.coordinates]
    if items and all(item.style not in ("list", "mapping") for item in items):
        if all("=" in yaml_values.word(text, item) for item in items):
            yield from _in_equations([yaml_values.word(text, item) for item in items])
            return
        items = [root]
    for item in items:
        yield from _signed(tuple(_branch(text, item, names)))


def _in_equations(texts: Iterable[str]) -> Iterator[_Item]:
    """`q2 = acos(x), q1 = ...`: the formulas of a branch as equations; each name once in a branch."""
    branch: dict[str, str] = {}
    for equation in (equation for text in texts for equation in joined(text)):
        left, _, right = equation.partition("=")
        if left.strip() in branch:
            yield from _signed(tuple(branch.items()))
            branch = {}
        branch[left.strip()] = right
    yield from _signed(tuple(branch.items()))


def _texts(text: str, items: Iterable[YamlNode]) -> Iterator[list[list[str]]]:
    """What holds together, each as texts of which one holds; the texts of a list are alternatives."""
    for is_text, found in groupby(items, lambda item: item.style not in ("list", "mapping")):
        if is_text:
            yield [[yaml_values.word(text, item) for item in found]]
            continue
        for item in found:
            if item.style == "mapping":
                yield [[equation] for equation in _equations(text, item)]
            else:
                yield [[yaml_values.word(text, one)] for one in yaml_values.items_of(text, item)]


def _branch(text: str, node: YamlNode, names: Sequence[str]) -> Iterator[tuple[str, str]]:
    """The formulas of a branch, by coordinate; those of a list in the order of the coordinates."""
    if node.style == "mapping":
        yield from yaml_values.pairs_of(text, node)
        return
    items = yaml_values.items_of(text, node) if node.style == "list" else []
    if len(items) != len(names):
        help = "write a mapping for each branch: {q1: atan2(py, px), q2: ...}"
        raise ReadError("a branch gives a formula for each coordinate", 0, 1, help)
    for name, item in zip(names, items, strict=True):
        yield name, yaml_values.word(text, item)


def _is_none(text: str, node: YamlNode) -> bool:
    return node.style not in ("list", "mapping") and bool(_NONE.fullmatch(yaml_values.word(text, node)))


def _equations(text: str, node: YamlNode) -> Iterator[str]:
    """{q1: [pi/2, -pi/2], q2: 0}: a value, or one of several, for each coordinate."""
    for name, value in node.entries():
        items = yaml_values.items_of(text, value) if value.style == "list" else [value]
        values = " or ".join(yaml_values.word(text, item) for item in items)
        yield f"{yaml_values.word(text, name)} = {values}"


def _signed(parts: _Item) -> Iterator[_Item]:
    """Both signs of every ± as alternatives of their own."""
    if any(_EITHER.search(text) or _OPPOSITE.search(text) for _, text in parts):
        for sign, other in (("+", "-"), ("-", "+")):
            yield tuple((name, _OPPOSITE.sub(other, _EITHER.sub(sign, text))) for name, text in parts)
    else:
        yield parts


def _is_name(vocabulary: Vocabulary, letter: str) -> bool:
    """Whether a letter means something in the problem or to the student."""
    return vocabulary.symbol(key(letter)) is not None


def _is_value(vocabulary: Vocabulary, text: str) -> bool:
    """Whether no coordinate stands in a text, which may begin with ±."""
    try:
        return not _has_coordinate(vocabulary, _value(vocabulary, prepared(_EITHER.sub("+", text))))
    except ReadError:
        return False


def _has_coordinate(vocabulary: Vocabulary, node: Node) -> bool:
    return not names_in(node).isdisjoint(q.name for q in vocabulary.coordinates)


def _part(vocabulary: Vocabulary, name: str, text: str) -> Part:
    """A formula of an alternative: of a coordinate, or what is 0."""
    members = [_value(vocabulary, tokens) for tokens in chain(prepared(text))]
    if not name:
        if len(members) == 1:
            return Part("", members[0])
        if len(members) == 2:
            return Part("", members[0] if _is_zero(members[1]) else total([members[0], negated(members[1])]))
        raise ReadError(f"`{text.strip()[:60]}` is no equation", 0, 1, "write sin(q2) = 0")
    found = vocabulary.symbol(key(name))
    q = vocabulary.coordinate(found.value) if found is not None and isinstance(found.value, Node) else None
    if q is None:
        raise ReadError(f"{name} is no coordinate", 0, 1, "a branch gives a formula for each coordinate")
    return Part(q.name, members[-1])


def _turned_round(part: Part) -> Part:
    return Part(part.coordinate, with_atan2_exchanged(part.node))


def _is_zero(node: Node) -> bool:
    return node == ZERO


def _value(vocabulary: Vocabulary, tokens: list[Token]) -> Node:
    found = read_right_side(vocabulary, tokens)
    if not isinstance(found, RightSide):
        raise found
    if found.free:
        raise ReadError(f"{found.free[0]} is no name of this problem", 0, 1, "write it in its symbols")
    if not isinstance(found.value, Node):
        raise ReadError("a single expression is expected", 0, 1, "write one formula")
    for part in walk(found.value):
        if isinstance(part, Reference):
            raise ReadError(f"{part} stands in it", 0, 1, "write it in the coordinates: sin(q2) = 0")
    return found.value
