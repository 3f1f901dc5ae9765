r"""Answers that are sets: singular configurations, and the branches of the inverse kinematics.

    singular: [sin(q2) = 0, "q2 = 0 and sin(q3) = 0"]
    inverse:
      - {q1: atan2(py, px), q3: ±acos((px^2 + py^2 - l1^2 - l2^2)/(2*l1*l2)), q2: ...}

Alternatives are the items of a list; equations that hold together are joined by `and`, or are a
list of their own.  A branch is a mapping from coordinates to formulas, or a list of these in the order
of the coordinates; `none` is no branch at all.  `±` stands for two branches
(alternatives), linked with every other ± of the same branch, and against every ∓ of it; `k*pi`
with a letter that means nothing else, for all whole multiples.

    [{q2: \arccos\frac{a}{b}, q1: \operatorname{atan2}(y, x)}, {q2: ..., q1: ...}]

A brace opens a mapping where an item begins and a name with a colon follows; every other one belongs
to a formula.  A comma parts items outside of all inner brackets.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import partial
from itertools import groupby, islice, product

from dynsolve.answers.reading import yaml_values
from dynsolve.answers.reading.displays import chain
from dynsolve.answers.reading.equation_reader import EquationReader
from dynsolve.answers.reading.grids import MAX_LENGTH, symbols_in
from dynsolve.answers.reading.left_side import RightSide, read_right_side
from dynsolve.answers.reading.lexer import Token
from dynsolve.answers.reading.prepare import prepared
from dynsolve.answers.reading.set_text import alternatives, joined
from dynsolve.answers.reading.sources import is_balanced, levels
from dynsolve.answers.reading.vocabulary import Vocabulary
from dynsolve.answers.reading.yaml_values import MAX_DEPTH, YamlNode
from dynsolve.answers.verdict import ConfigurationAnswer, Place
from dynsolve.errors import ReadError
from dynsolve.notation.build import negated, total
from dynsolve.notation.tree import (
    ZERO,
    Function,
    Node,
    Reference,
    Symbol,
    mapped,
    names_in,
    walk,
    with_atan2_exchanged,
)
from dynsolve.quantities import families
from dynsolve.quantities.family import Kind
from dynsolve.quantities.letters import key
from dynsolve.questions.constraints import REDUCED
from dynsolve.questions.judging import Part

# Formulas of sets and branches: read, and asked which coordinates and names stand in them

_FIRST = r"(?:(?<=[=(,{])|(?<=[=(,{] )|\A)\s*"
EITHER = re.compile(rf"±|\\pm\b|\+/-|{_FIRST}\+-")
OPPOSITE = re.compile(rf"∓|\\mp\b|-/\+|{_FIRST}-\+")
"""One of two signs, and the other; `+-` is one where nothing stands before it."""


def value(vocabulary: Vocabulary, tokens: list[Token]) -> Node:
    """The formula that tokens are; raises ReadError where they are none, or an answer stands in it."""
    found = read_right_side(vocabulary, tokens)
    if not isinstance(found, RightSide):
        raise found.with_traceback(None)
    if found.free:
        raise ReadError(f"{found.free[0]} is no name of this problem", 0, 1, "write it in its symbols")
    if not isinstance(found.value, Node):
        raise ReadError("a single expression is expected", 0, 1, "write one formula")
    formula = _with_forces(vocabulary, found.value)
    for part in walk(formula):
        if isinstance(part, Reference):
            raise ReadError(f"{part} stands in it", 0, 1, "write it in the coordinates: sin(q2) = 0")
    return formula


def _with_forces(vocabulary: Vocabulary, node: Node) -> Node:
    """The formula with generalized forces as symbols, where equations of motion are among the sets."""
    named = vocabulary.quantities
    if REDUCED.name not in named:
        return node

    def put(part: Node) -> Node:
        if isinstance(part, Reference) and named[part.quantity].family in (families.TAU, families.FORCE):
            place = part.row or named[part.quantity].index[0]
            return Symbol(vocabulary.inputs[place - 1])
        return part

    return mapped(node, put)


def has_coordinate(vocabulary: Vocabulary, node: Node) -> bool:
    """Whether a coordinate stands in a formula."""
    return not names_in(node).isdisjoint(q.name for q in vocabulary.coordinates)


def _value_of(vocabulary: Vocabulary, text: str) -> Node | None:
    """The formula that a text is, None where it is none."""
    try:
        return value(vocabulary, prepared(text))
    except ReadError:
        return None


def coordinate_named(vocabulary: Vocabulary, name: str) -> str:
    """The coordinate that a text is the name of; empty for any other."""
    node = _value_of(vocabulary, name)
    q = vocabulary.coordinate(node)
    return q.name if q is not None and not (isinstance(node, Symbol) and node.dots) else ""


def function_named(vocabulary: Vocabulary, name: str) -> Function | None:
    """The sine or cosine of a coordinate that a text is the name of: c_2."""
    node = _value_of(vocabulary, name)
    return node if isinstance(node, Function) and vocabulary.coordinate(node.argument) is not None else None


def names_within(vocabulary: Vocabulary, text: str) -> frozenset[str]:
    """The names of symbols in a formula; none where it cannot be read."""
    one_sign = OPPOSITE.sub("+", EITHER.sub("+", text))
    try:
        return frozenset().union(
            *(names_in(value(vocabulary, part)) for part in chain(prepared(one_sign))[-1:])
        )
    except ReadError:
        return frozenset()


# Lists and mappings in a text that YAML refuses, found by their brackets alone

_KEY = re.compile(r"""\s*("[^"\n]{1,80}"|'[^'\n]{1,80}'|[\w\\{}^]{1,80}?)\s*:""")


def loose_node(text: str) -> YamlNode | None:
    """What a text says as a list, a mapping or a scalar; None where a bracket never closes."""
    if len(text) > MAX_LENGTH or not is_balanced(text):
        return None
    return _node(text, 0, len(text), MAX_DEPTH)


def _node(text: str, start: int, end: int, depth: int) -> YamlNode:
    content = text[start:end]
    start, end = end - len(content.lstrip()), start + len(content.rstrip())
    start = min(start, end)
    opening, closing = text[start : start + 1], text[end - 1 : end]
    if depth and opening == "[" and closing == "]":
        pieces = _pieces(text, start + 1, end - 1)
        return YamlNode("list", start, end, inside=[_node(text, *piece, depth - 1) for piece in pieces])
    if depth and opening == "{" and closing == "}" and _KEY.match(text, start + 1):
        return _mapping(text, start, end, depth)
    is_quoted = end - start > 1 and opening in "'\"" and opening == closing
    return YamlNode(opening if is_quoted else "", start, end)


def _mapping(text: str, start: int, end: int, depth: int) -> YamlNode:
    """{key: value, ...}; a piece without a key goes on with the value before it."""
    node = YamlNode("mapping", start, end)
    for first, last in _pieces(text, start + 1, end - 1):
        name = _KEY.match(text, first, last)
        if name is None:
            node.inside[-1] = _node(text, node.inside[-1].start, last, depth - 1)
            continue
        node.inside.append(_node(text, name.start(1), name.end(1), 0))
        node.inside.append(_node(text, name.end(), last, depth - 1))
    return node


def _pieces(text: str, start: int, end: int) -> list[tuple[int, int]]:
    """Where the items stand that commas part, outside of brackets."""
    found, first = [], start
    for at, level in enumerate(levels(text[start:end]), start):
        if text[at] == "," and level == 0:
            found.append((first, at))
            first = at + 1
    return [*found, (first, end)] if text[first:end].strip() else found


# Answers that are sets: singular configurations, and the branches of the inverse kinematics

CONDITIONS = "when"
"""The key beside a branch for the conditions under which it holds."""

MOST_ITEMS = 64
"""More alternatives, with every ± written out, are not read."""

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
    root = node or yaml_values.root_of(text) or loose_node(text)
    if root is None:
        error = ReadError("a bracket never closes", 0, 1, "write a list: [sin(q2) = 0, cos(q3) = 0]")
        reader.found.configurations.append(_answer(name, place, text.strip(), (), error))
        return
    alternatives, fault = _read(reader.vocabulary, kind, _alternatives(reader.vocabulary, text, root, kind))
    if takes_x_first:
        alternatives = tuple(
            tuple(Part(part.coordinate, with_atan2_exchanged(part.node)) for part in one)
            for one in alternatives
        )
    written = text[root.start : root.end].strip()
    reader.found.configurations.append(_answer(name, place, written, alternatives, fault))


def read_equations(reader: EquationReader, name: str, texts: Sequence[str], place: Place) -> None:
    """Read a set that is given by equations alone: alternatives, or formulas of branches in their order."""
    kind = reader.vocabulary.quantities[name].family.kind
    items = _in_equations(texts) if kind is Kind.BRANCHES else _of_texts(reader.vocabulary, [texts])
    found, fault = _read(reader.vocabulary, kind, items)
    reader.found.configurations.append(_answer(name, place, "; ".join(texts), found, fault))


def is_set(vocabulary: Vocabulary, text: str) -> bool:
    """Whether a text is read as alternatives of equations in coordinates."""
    try:
        found, fault = _read(vocabulary, Kind.EQUATIONS, _of_texts(vocabulary, [[text]]))
    except ReadError:
        return False
    nodes = [part.node for one in found for part in one]
    if fault is not None or not nodes or not names_in(*nodes).isdisjoint(vocabulary.reached):
        return False
    return all(has_coordinate(vocabulary, node) for node in nodes)


def are_motions(vocabulary: Vocabulary, text: str) -> bool:
    """Whether every equation of a text holds an acceleration, and none a multiplier."""
    try:
        found, fault = _read(vocabulary, Kind.CONDITIONS, _of_texts(vocabulary, [[text]]))
    except ReadError:
        return False
    nodes = [part.node for one in found for part in one]
    return fault is None and all(any(s.dots == 2 for s in symbols_in(node)) for node in nodes)


def _read(
    vocabulary: Vocabulary, kind: Kind, alternatives: Iterator[_Item]
) -> tuple[tuple[tuple[Part, ...], ...], ReadError | None]:
    """The alternatives as trees, or why they cannot be read."""
    try:
        items = list(islice(alternatives, MOST_ITEMS + 1))
        if len(items) > MOST_ITEMS:
            raise ReadError(f"more than {MOST_ITEMS} alternatives", 0, 1, "write fewer")
        read = tuple(tuple(_parts(vocabulary, item)) for item in items)
        if kind is Kind.EQUATIONS:
            _check_values(vocabulary, items, read)
    except ReadError as error:
        return (), error
    return read, None


def _answer(
    name: str, place: Place, text: str, read: tuple[tuple[Part, ...], ...], fault: ReadError | None
) -> ConfigurationAnswer:
    if fault is None:
        return ConfigurationAnswer(name, place, text, read)
    return ConfigurationAnswer(name, place, text, fault=fault.message, expected=fault.help)


def _check_values(vocabulary: Vocabulary, items: Iterable[_Item], read: Iterable[Sequence[Part]]) -> None:
    """The 0 of `[0, pi]` is a value of an unknown coordinate."""
    for item, parts in zip(items, read, strict=True):
        for (_, text), part in zip(item, parts, strict=True):
            if "=" not in text and not has_coordinate(vocabulary, part.node):
                raise ReadError(f"`{text.strip()[:60]}` is no equation", 0, 1, "write [q2 = 0, q2 = pi]")


_Item = tuple[tuple[str, str], ...]
"""An alternative: (coordinate or nothing, text) for each of its formulas."""


def _alternatives(vocabulary: Vocabulary, text: str, root: YamlNode, kind: Kind) -> Iterator[_Item]:
    items = yaml_values.items_of(text, root) if root.style == "list" else [root]
    if kind is Kind.BRANCHES:
        yield from _branches(vocabulary, text, root, items)
    elif not (len(items) == 1 and _is_none(text, items[0])):
        for texts in _texts(text, items):
            yield from _of_texts(vocabulary, texts)


def _of_texts(vocabulary: Vocabulary, texts: Iterable[Sequence[str]]) -> Iterator[_Item]:
    """Every choice of one alternative of each of several texts, which hold together."""

    def is_name(letter: str) -> bool:
        return vocabulary.symbol(key(letter)) is not None

    each = [alternatives(one, is_name, partial(_is_value, vocabulary)) for one in texts]
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
        yield from (pair for pair in yaml_values.pairs_of(text, node) if pair[0] != CONDITIONS)
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
    for name, given in node.entries():
        items = yaml_values.items_of(text, given) if given.style == "list" else [given]
        values = " or ".join(yaml_values.word(text, item) for item in items)
        yield f"{yaml_values.word(text, name)} = {values}"


def _signed(parts: _Item) -> Iterator[_Item]:
    """Both signs of every ± as alternatives of their own."""
    if any(EITHER.search(text) or OPPOSITE.search(text) for _, text in parts):
        for sign, other in (("+", "-"), ("-", "+")):
            yield tuple((name, OPPOSITE.sub(other, EITHER.sub(sign, text))) for name, text in parts)
    else:
        yield parts


def _is_value(vocabulary: Vocabulary, text: str) -> bool:
    """Whether no coordinate stands in a text, which may begin with ±."""
    node = _value_of(vocabulary, EITHER.sub("+", text))
    return node is not None and not has_coordinate(vocabulary, node)


def _parts(vocabulary: Vocabulary, item: _Item) -> Iterator[Part]:
    """The formulas of an alternative; a sine or cosine that is given stands for itself until its angle is."""
    known: dict[Node, Node] = {}
    for name, text in item:
        turned = function_named(vocabulary, name) if name else None
        if turned is not None:
            known[turned] = _replaced(value(vocabulary, chain(prepared(text))[-1]), known)
            continue
        part = _part(vocabulary, name, text)
        yield Part(part.coordinate, _replaced(part.node, known)) if name else part
        known = {node: value for node, value in known.items() if part.coordinate not in names_in(node)}


def _replaced(node: Node, known: Mapping[Node, Node]) -> Node:
    return mapped(node, lambda part: known.get(part, part)) if known else node


def _part(vocabulary: Vocabulary, name: str, text: str) -> Part:
    """A formula of an alternative: of a coordinate, or what is 0."""
    tokens = chain(prepared(text))
    if not name:
        members = [value(vocabulary, member) for member in tokens]
        if len(members) == 1:
            return Part("", members[0])
        if len(members) == 2:
            first, second = members
            return Part("", first if second == ZERO else total([first, negated(second)]))
        raise ReadError(f"`{text.strip()[:60]}` is no equation", 0, 1, "write sin(q2) = 0")
    coordinate = coordinate_named(vocabulary, name)
    if not coordinate:
        raise ReadError(f"{name} is no coordinate", 0, 1, "a branch gives a formula for each coordinate")
    return Part(coordinate, value(vocabulary, tokens[-1]))
