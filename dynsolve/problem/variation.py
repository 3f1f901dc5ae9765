"""`vary`: what may differ from student to student, and the text of a problem file with a choice made.

    vary:
      values.l1: [0.3, 0.4, 0.5]                  # a number from a list
      values.m1: {from: 1, to: 3, step: 0.5}      # or from a range
      dh.2.alpha: [90deg, -90deg]                 # any part of the file, list items counted from 1
      gravity: [[0, -g, 0], [-g, 0, 0]]
      friction: [absent, {q1: fv1}]               # a key that may be left out
      letters: {l1: [l1, a1, L1], q1: [q1, theta1]}
      within: 0.2                                 # how far from the median a variant may be

A choice changes the text of the file where that part stands, and nothing else of it.  Numbers and letters
change no derivation; every other part is structure.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from fractions import Fraction
from math import prod

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.rationals import rational_value
from dynsolve.errors import Finding, ProblemError, ReadError
from dynsolve.notation.characters import normalize
from dynsolve.problem.cells import read_cell
from dynsolve.problem.kinds import MapOf, OneOf, ValueKind, describe, did_you_mean, items
from dynsolve.problem.specification import PROBLEM
from dynsolve.problem.yaml_nodes import (
    Faults,
    FaultyNode,
    ListNode,
    MappingNode,
    ProblemText,
    ScalarNode,
    Span,
    YamlNode,
    as_source,
    read_nodes,
)

KEY, LETTERS, WITHIN, ABSENT, TEXT = "vary", "letters", "within", "absent", "text"
FORMULA = re.compile(r"\$[^$]*\$")
WIDTH = Fraction(1, 10)
"""How far from the median a variant may be, as a share of it, unless the file says otherwise."""

MOST = 1_000
"""The alternatives of one part, at most."""

_WORDS = frozenset({"title", "source", "edition", "convention", "find", "marks", "remarks", KEY})
"""The keys in which no letter is changed: words, and names of answers."""

_HELP = PROBLEM[KEY].help


class Part(Struct, frozen=True):
    """A part of the file that varies: the way to it, where it stands, and what may stand there.

    `told` is where `vary` names it.
    """

    path: str
    span: Span
    alternatives: tuple[str, ...]
    told: Span
    places: tuple[Span, ...] = ()
    """Where the alternatives of a list stand in the file."""

    @property
    def is_number(self) -> bool:
        """Whether only numbers differ, on which no derivation depends."""
        return self.path.startswith("values.")


class Variation(Struct, frozen=True):
    """What may vary in a problem file, and its text without `vary`."""

    text: str
    file: str
    parts: tuple[Part, ...]
    letters: Mapping[str, tuple[str, ...]]
    within: Fraction = WIDTH
    place: Span = (0, 0)
    """Where `letters` stands in the file."""

    @property
    def structure(self) -> tuple[Part, ...]:
        """The parts on which the derivation depends."""
        return tuple(part for part in self.parts if not part.is_number)

    @property
    def numbers(self) -> tuple[Part, ...]:
        """The parts that are numbers."""
        return tuple(part for part in self.parts if part.is_number)

    @property
    def structures(self) -> int:
        """In how many ways structure can be chosen."""
        return prod(len(part.alternatives) for part in self.structure)

    def structure_of(self, number: int) -> dict[str, str]:
        """The choice of structure of a way, counted from 0, by the way to each part."""
        return _choice(number, {part.path: part.alternatives for part in self.structure})

    @property
    def dressings(self) -> int:
        """In how many ways letters and numbers can be chosen."""
        return prod(len(part.alternatives) for part in self.numbers) * prod(map(len, self.letters.values()))

    def dressing(self, number: int) -> tuple[dict[str, str], dict[str, str]]:
        """The numbers and the letters of a way, counted from 0."""
        values = {part.path: part.alternatives for part in self.numbers}
        rest = number // prod(map(len, values.values()))
        return _choice(number, values), _choice(rest, self.letters)

    def choose(self, chosen: Mapping[str, str], letters: Mapping[str, str] | None = None) -> str:
        """The text of the file with these alternatives in their places, and other letters."""
        text = self.text
        for part in sorted(self.parts, key=lambda part: part.span, reverse=True):
            if part.path in chosen:
                text = _put(text, part, chosen[part.path])
        other = {name: new for name, new in (letters or {}).items() if name != new}
        return renamed(text, other) if other else text


def _choice(number: int, alternatives: Mapping[str, Sequence[str]]) -> dict[str, str]:
    """One of each, by the digits of a number whose places count them.

    >>> _choice(4, {"a": ["a1", "a2"], "b": ["b1", "b2", "b3"]})
    {'a': 'a1', 'b': 'b3'}
    """
    found = {}
    for name, each in alternatives.items():
        number, place = divmod(number, len(each))
        found[name] = each[place]
    return found


def _put(text: str, part: Part, new: str) -> str:
    """The text with an alternative in the place of a part; an `absent` key is left out with its line."""
    start, end = part.span
    key = part.path
    if start == end:  # a key that the file does not have
        return text if new == ABSENT else f"{text[:start].rstrip()}\n{key}: {new}\n{text[end:]}"
    if new != ABSENT:
        return f"{text[:start]}{new}{text[end:]}"
    begin = text.rfind(f"{key}:", 0, start)
    return f"{text[:begin]}{text[end:].lstrip(' ').removeprefix(chr(10))}"


def renamed(text: str, letters: Mapping[str, str]) -> str:
    """The text of a problem file with other names for its symbols, all at once.

    >>> renamed("dh: [{theta: q1*, a: l1}]  # l1", {"l1": "a1", "q1": "theta1"})
    'dh: [{theta: theta1*, a: a1}]  # l1'
    """
    pattern = re.compile(rf"(?<!\w)(?:{'|'.join(map(re.escape, letters))})(?=(?:_d?dot)?(?!\w))")
    root = read_nodes(Faults(as_source(text)))
    spans = _names(root, text) if isinstance(root, MappingNode) else ()
    for start, end in sorted(spans, reverse=True):
        new = pattern.sub(lambda found: letters[found[0]], text[start:end])
        text = text[:start] + new + text[end:]
    return text


def _names(root: MappingNode, text: str) -> Iterator[Span]:
    """Where names of symbols may stand: in values, in keys of mappings by symbol, in formulas of words."""
    for key, value in root.entries:
        if key.decoded == TEXT:
            yield from (found.span() for found in FORMULA.finditer(text, *value.span))
        elif key.decoded not in _WORDS:
            yield from scalars(value, key.decoded in _BY_SYMBOL)


def _is_by_symbol(kind: ValueKind) -> bool:
    """Whether a value is a mapping by symbol, or by coordinate."""
    if isinstance(kind, OneOf):
        return any(map(_is_by_symbol, kind.kinds))
    return isinstance(kind, MapOf) and kind.called.endswith(("by symbol", "by coordinate"))


_BY_SYMBOL = frozenset({"coordinates", *(key.name for key in PROBLEM.keys if _is_by_symbol(key.kind))})
"""The keys whose own keys are names of symbols."""


def scalars(node: YamlNode, by_symbol: bool = False) -> Iterator[Span]:
    """Where the texts of a node stand, the keys of a mapping `by_symbol` among them."""
    match node:
        case ScalarNode():
            yield node.span
        case ListNode():
            for item in node.items:
                yield from scalars(item)
        case MappingNode():
            for key, value in node.entries:
                if by_symbol:
                    yield key.span
                yield from scalars(value, key.decoded in _BY_SYMBOL)


# -- reading -----------------------------------------------------------------------------------------


def read_variation(content: str | bytes, file: str = "") -> Variation | None:
    """What varies in a problem file; None where nothing does.

    Raises ProblemError with every fault of `vary`.
    """
    faults = Faults(as_source(content, file))
    root = read_nodes(faults)
    if not isinstance(root, MappingNode):
        faults.raise_errors()
        return None
    found = variation_of(faults, root)
    faults.raise_errors()
    return found


def variation_of(faults: Faults, root: MappingNode) -> Variation | None:
    """The same of a file that is read; its faults are reported."""
    place = next((k for k, (key, _) in enumerate(root.entries) if key.decoded == KEY), None)
    if place is None:
        return None
    key, node = root.entries[place]
    text = faults.source.text
    begin = text.rfind("\n", 0, key.span[0]) + 1
    following = [other.span[0] for other, _ in root.entries[place + 1 :]]
    end = text.rfind("\n", 0, following[0]) + 1 if following else len(text)
    return _variation(faults, key, node, root, faults.source, (begin, end))


def variation_in_set(
    faults: Faults, key: ScalarNode, node: YamlNode, problem: ProblemText
) -> Variation | None:
    """What a `set.yaml` says of a problem: `key` is its name there; faults of the set are reported."""
    root = read_nodes(Faults(problem))
    assert isinstance(root, MappingNode)
    if any(own.decoded == KEY for own, _ in root.entries):
        faults.error(key.span, f"{key.decoded} has a `vary` of its own", "keep one of them")
        return None
    end = len(problem.text)
    return _variation(faults, key, node, root, problem, (end, end))


def _variation(
    faults: Faults, key: ScalarNode, node: YamlNode, root: MappingNode, problem: ProblemText, own: Span
) -> Variation | None:
    """What `node` says may vary in a problem, whose text has `vary` in the place `own`."""
    if not isinstance(node, MappingNode):
        if not isinstance(node, FaultyNode):
            faults.error(node.span, f"vary is a mapping, not {describe(node)}", _HELP)
        return None
    text, (begin, end) = problem.text, own
    parts: list[Part] = []
    letters: dict[str, tuple[str, ...]] = {}
    within, place_of_letters = WIDTH, key.span
    for name, value in node.entries:
        if name.decoded == LETTERS:
            letters, place_of_letters = _letters(faults, value), name.span
        elif name.decoded == WITHIN:
            within = _number(faults, value, "within") or WIDTH
        else:
            span = _place(faults, root, name)
            alternatives = _alternatives(faults, value, name.decoded)
            if span is not None and alternatives:
                places = tuple(item.span for item in value.items) if isinstance(value, ListNode) else ()
                parts.append(Part(name.decoded, span, alternatives, name.span, places))
    for part in parts:
        if whole := next((one.path for one in parts if part.path.startswith(f"{one.path}.")), ""):
            faults.error(part.told, f"{part.path} is a part of {whole}, which varies too", "keep one of them")
    if not (parts or letters) and not faults.errors:
        faults.error(key.span, "nothing varies", _HELP)
    moved = tuple(_behind(part, begin, end, len(text)) for part in parts)
    return Variation(text[:begin] + text[end:], problem.file, moved, letters, within, place_of_letters)


def _behind(part: Part, begin: int, end: int, last: int) -> Part:
    """The part where it stands in the text without `vary`."""
    start, stop = part.span
    if start == stop:  # it is added at the end
        start = stop = last
    shift = end - begin if start >= end else 0
    return replace(part, span=(start - shift, stop - shift))


def _place(faults: Faults, root: MappingNode, name: ScalarNode) -> Span | None:
    """Where a part stands; the empty place of a key of the file that is not given, None (reported) else."""
    node: YamlNode | None = root
    steps = name.decoded.split(".")
    for k, step in enumerate(steps):
        known: Sequence[str] = ()
        following: YamlNode | None = None
        if isinstance(node, MappingNode):
            known = [key.decoded for key, _ in node.entries]
            following = next((value for key, value in node.entries if key.decoded == step), None)
        elif isinstance(node, ListNode):
            known = [str(i) for i in range(1, len(node.items) + 1)]
            following = node.items[int(step) - 1] if step in known else None
        if following is None:
            if k == 0 and len(steps) == 1 and step in PROBLEM.names:
                return (0, 0)
            way, last = ".".join(steps[: k + 1]), steps[-1]
            usual = "give it there, so that it has a place; list items are counted from 1: masses.1.center"
            if k == 0 and step in PROBLEM.names:
                usual = f"give {step} with {last} in it, or let the whole of it vary: {step}: [absent, ...]"
            help = did_you_mean(step, known) or usual
            faults.error(name.span, f"the file has no {way}", help)
            return None
        node = following
    assert node is not None
    return node.span


def _alternatives(faults: Faults, node: YamlNode, path: str) -> tuple[str, ...]:
    """The texts of a list, or the numbers of a range."""
    if isinstance(node, MappingNode):
        return _range(faults, node, path)
    if not isinstance(node, ListNode):
        if not isinstance(node, FaultyNode):
            message = f"the alternatives of {path} are a list or a range, not {describe(node)}"
            faults.error(node.span, message, _HELP)
        return ()
    texts = tuple(faults.source.text[item.span[0] : item.span[1]] for item in node.items)
    if len(set(texts)) < max(len(texts), 2):
        faults.error(node.span, f"{path} needs at least two alternatives, each another one", _HELP)
    elif len(texts) > MOST:
        faults.error(node.span, f"{len(texts)} alternatives; at most {MOST} are read", "give fewer")
    elif any("\n" in text for text in texts):
        faults.error(node.span, f"an alternative of {path} stands on one line", "write it with [ ] or { }")
    else:
        return texts
    return ()


def _range(faults: Faults, node: MappingNode, path: str) -> tuple[str, ...]:
    """{from: 1, to: 3, step: 0.5}"""
    given = {key.decoded: value for key, value in node.entries}
    if set(given) != {"from", "to", "step"} or not path.startswith("values."):
        faults.error(node.span, f"{path} is no range", "values.m1: {from: 1, to: 3, step: 0.5}, or a list")
        return ()
    numbers = {key: _number(faults, value, f"{key} of {path}") for key, value in given.items()}
    first, last, step = (numbers[key] for key in ("from", "to", "step"))
    if first is None or last is None or step is None:
        return ()
    if step <= 0 or last <= first or (last - first) / step >= MOST:
        faults.error(node.span, f"{path}: this range is empty or too long", f"at most {MOST} steps upwards")
        return ()
    count = (last - first) // step + 1
    return tuple(_written(first + k * step) for k in range(count))


def _written(number: Fraction) -> str:
    """A number as a file has it: a decimal where there is a short one."""
    decimal = str(float(number))
    return decimal.removesuffix(".0") if Fraction(decimal) == number else str(number)


def _number(faults: Faults, node: YamlNode, what: str) -> Fraction | None:
    cell = read_cell(faults, node, what)
    value = rational_value(cell.tree) if cell is not None else None
    if cell is not None and value is None:
        faults.error(cell.span, f"{what} is not a number", "write 0.5, 2 or 1/3")
    return value


def _letters(faults: Faults, node: YamlNode) -> dict[str, tuple[str, ...]]:
    """The names that each symbol may have."""
    found: dict[str, tuple[str, ...]] = {}
    if not isinstance(node, MappingNode):
        faults.error(node.span, f"letters are a mapping, not {describe(node)}", "{l1: [l1, a1, L1]}")
        return found
    for key, value in node.entries:
        names = []
        for item in items(faults, value, f"the letters of {key.decoded}", "{l1: [l1, a1, L1]}"):
            if not isinstance(item, ScalarNode):
                faults.error(item.span, f"a letter is a name, not {describe(item)}", "{l1: [l1, a1, L1]}")
                continue
            try:
                names.append(normalize(item.decoded))
            except ReadError as error:
                faults.error(item.span, error.message, error.help)
        if names:
            found[key.decoded] = tuple(dict.fromkeys(names))
    taken = [name for names in found.values() for name in names]
    twice = next((name for name in taken if taken.count(name) > 1), "")
    if twice:
        faults.error(node.span, f"{twice} would be two things", "give each symbol letters of its own")
    return found


def faulty_alternatives(
    variation: Variation, source: ProblemText, read: Callable[[str, str], object]
) -> Iterator[Finding]:
    """What is wrong with the alternatives of lists, and with letters, each put into the file by itself.

    `read` reads the text of a problem file and its name, and raises ProblemError.
    """
    tried: list[tuple[str, Span, dict[str, str], dict[str, str]]] = [
        (f"{part.path}: {text}", place, {part.path: text}, {})
        for part in variation.parts
        for text, place in zip(part.alternatives, part.places, strict=False)
    ]
    tried += [
        (f"{name}: {new}", variation.place, {}, {name: new})
        for name, names in variation.letters.items()
        for new in names
    ]
    for what, place, chosen, letters in tried:
        try:
            read(variation.choose(chosen, letters), variation.file)
        except ProblemError as error:
            first = error.findings[0]
            yield source.finding(*place, f"with {what}: {first.message}", first.help, "faulty-alternative")
