"""The equations of one file, read in order: what each is an answer to, and what it defines.

A session keeps what the student defined so far and gathers the answers.  Of a chain
a = b = c the names are found first; then every member that is a value is one answer
to each of them, and what consists of names alone is left alone as a definition.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from dynsolve.answers.reading import measure
from dynsolve.answers.reading.derivatives import UnknownVariable
from dynsolve.answers.reading.displays import Display, Equation, chain, equations, is_label
from dynsolve.answers.reading.forms import Form
from dynsolve.answers.reading.grids import Abstract, Grid, Value, transposed
from dynsolve.answers.reading.limits import MAX_ANSWERS, MAX_DEFINITIONS, MAX_MEMBERS
from dynsolve.answers.reading.lookup import UnknownName
from dynsolve.answers.reading.prepare import Macro, cut_names, expand, simplified
from dynsolve.answers.reading.reader import Reader
from dynsolve.answers.reading.scan import Token, scan
from dynsolve.answers.reading.vocabulary import Meaning, Vocabulary, key
from dynsolve.answers.submission import Answer, NotRecognized, Place, referred
from dynsolve.errors import ReadError
from dynsolve.notation.printing import PLAIN, Style
from dynsolve.notation.tree import (
    ZERO,
    Function,
    Matrix,
    Negative,
    Node,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
    Words,
)
from dynsolve.notation.unicode import printable, to_unicode

_WAYS: tuple[frozenset[str], ...] = (frozenset(), frozenset({"inertia"}), frozenset({"spaces"}))
"""How a value may be read: as it stands; a bare I_1 as the moment of inertia; blanks between entries."""

_LONGEST_SHOWN = 2_000

_EXPECTED = "a formula is made of numbers, the problem's symbols, + - * / ^, sin, cos, tan and sqrt"


@dataclass(frozen=True, slots=True)
class Name:
    """The answers that a side of an equation may name."""

    candidates: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Unknown:
    """A side that is a name which means nothing; `simple` where it is that name alone."""

    key: str
    family: tuple[str, ...]
    simple: bool
    message: str


@dataclass(frozen=True, slots=True)
class Read:
    """A member that was read, with what its value is made of."""

    value: Value
    references: tuple[str, ...]
    notes: tuple[str, ...]
    free: tuple[str, ...]
    is_definition: bool


@dataclass(frozen=True, slots=True)
class _Pending:
    """An equation whose left side has an index that is none: taken for the one answer that is absent."""

    family: tuple[str, ...]
    answers: tuple[Answer, ...]
    refused: NotRecognized
    at: int


class Session:
    """Reads equation after equation of one hand-in."""

    def __init__(self, vocabulary: Vocabulary, style: Style = PLAIN) -> None:
        self.vocabulary, self.style = vocabulary, style
        self.macros: dict[str, Macro] = {}
        self.answers: list[Answer] = []
        self.pending: list[_Pending] = []
        self.not_recognized: list[NotRecognized] = []
        self.chains = 0
        self._model: list[Answer] = []

    # Displays

    def display(self, display: Display) -> None:
        """Read the equations of one display."""
        try:
            tokens = simplified(expand(scan(display.text), self.macros))
        except ReadError as error:
            self._unscanned(display, error)
            return
        for equation in equations(tokens, display.label):
            if len(self.answers) < MAX_ANSWERS:
                self._equation(equation, display)

    def _unscanned(self, display: Display, error: ReadError) -> None:
        """A display that has no tokens: its left side alone may still say what it answers."""
        head, _, _ = display.text.partition("=")
        try:
            tokens = simplified(expand(scan(head), self.macros))
            name = self._side(tokens[:-1])
        except ReadError:
            name = None
        place = display.locate(error.offset, error.length)
        if isinstance(name, Name):
            self.chains += 1
            self._unreadable(name.candidates, display, error, display.label, (self.chains, 1))
        else:
            self.not_recognized.append(NotRecognized(_shown(display.text), display.label, place))

    def _equation(self, equation: Equation, display: Display) -> None:
        self.chains += 1
        members = equation.members
        if len(members) > MAX_MEMBERS:
            start = members[0][0].start
            place = display.locate(start, 1)
            self.not_recognized.append(NotRecognized(_shown(display.text[start:]), equation.label, place))
            return
        sides = self._sides(members)
        names = list(dict.fromkeys(side.candidates for side in sides if isinstance(side, Name)))
        owners = tuple(name for candidates in names for name in candidates)
        read: list[tuple[int, Read | ReadError]] = []
        for index, member in enumerate(members):
            if not isinstance(sides[index], (Name, Unknown)):
                read.append((index, self.member(member, owners)))
        if names and self._is_own_letter(members, names, read):
            self.define(key(members[0][0].text), next(f for _, f in read if isinstance(f, Read)))
        elif names:
            self._judged(names, read, equation, display)
        else:
            self._without_name(sides, read, equation, display)

    def answer(self, name: str, place: Place, display: Display) -> None:
        """Read the value that an answer file gives under a name."""
        self.chains += 1
        side = self._key(name)
        if not isinstance(side, Name):
            family = side.family if isinstance(side, Unknown) else ()
            refused = NotRecognized(_shown(f"{name}: {display.text}"), "", place)
            if not family:
                self.not_recognized.append(refused)
                return
            side = Name(family[:1])
        before = len(self.answers)
        self._given(side.candidates, display)
        if isinstance(self._key(name), Unknown):
            made = tuple(self.answers[before:])
            del self.answers[before:]
            self.pending.append(_Pending(family, made, refused, before))

    def _key(self, name: str) -> Name | Unknown | None:
        """What a key of an answer file names."""
        if name.startswith("I") and name in self.vocabulary.shapes:
            return Name((name,))
        try:
            return self._side(simplified(scan(name))[:-1])
        except ReadError:
            return None

    def _given(self, candidates: tuple[str, ...], display: Display) -> None:
        """The members of a value, each of them an answer."""
        label = display.label
        try:
            tokens = simplified(expand(scan(display.text), self.macros))
        except ReadError as error:
            self._unreadable(candidates, display, error, label, (self.chains, 0))
            return
        members = chain(tokens)
        if len(members) > MAX_MEMBERS:
            fault = ReadError(f"more than {MAX_MEMBERS} members of one chain", 0, 1, "write the value alone")
            self._unreadable(candidates, display, fault, label, (self.chains, 0))
            return
        side = self._side(members[0]) if len(members) > 1 else None
        if isinstance(side, Name) and set(side.candidates) & set(candidates):
            members = members[1:]
        for index, member in enumerate(members):
            where = (self.chains, index)
            if not member:
                fault = ReadError("nothing stands on one side of this `=`", 0, 1, "write the value alone")
                self._unreadable(candidates, display, fault, label, where)
                continue
            found = self.member(member, candidates)
            if isinstance(found, Read) and isinstance(found.value, Abstract):
                found = ReadError(
                    found.value.why, member[0].start, 1, "write it in the symbols of the problem"
                )
            if isinstance(found, ReadError):
                self._unreadable(candidates, display, found, label, where)
            else:
                self._value([candidates], found, member, label, display, where)

    def _is_own_letter(
        self,
        members: list[list[Token]],
        names: list[tuple[str, ...]],
        read: list[tuple[int, Read | ReadError]],
    ) -> bool:
        """Whether `h = ...` defines an abbreviation, its value having no shape of what books call h."""
        if len(names) > 1 or len(members[0]) > 1 or key(members[0][0].text) in self.vocabulary.shapes:
            return False
        values = [found.value for _, found in read if isinstance(found, Read) and not found.is_definition]
        return bool(values) and not any(self._fitted(names[0], value) for value in values)

    # What the sides are

    def _sides(self, members: list[list[Token]]) -> list[Name | Unknown | None]:
        """What each member names: the first one, those before the last, and the last if no other does."""
        found: list[Name | Unknown | None] = []
        for index, member in enumerate(members):
            side = None
            last = index == len(members) - 1
            if index == 0:
                side = self._side(member)
            elif not last or not any(isinstance(side, Name) for side in found):
                side = self._side(member)
                if isinstance(side, Unknown) or (last and self._is_symbol(member)):
                    side = None
            elif member[0].kind in ("begin", "["):
                side = self._side(member)
                side = side if isinstance(side, Name) else None
            found.append(side)
        return found

    def _is_symbol(self, member: list[Token]) -> bool:
        """Whether a member alone is a symbol of the problem, which wins on a right-hand side."""
        text = key("".join(t.text for t in member if t.kind in ("name", "letter", "number")))
        script = any(t.kind == "command" and t.text == "script" for t in member)
        return len(member) < 6 and not script and text in self.vocabulary.symbols

    def _side(self, member: list[Token]) -> Name | Unknown | None:
        """The name that a side is, None where it is something else."""
        if len(member) > 200:
            return None
        tokens = cut_names(member, self.vocabulary, naming=True)
        reader = Reader(tokens, self.vocabulary, naming=True)
        try:
            value = reader.value()
        except UnknownName as error:
            simple = self._is_simple(tokens, error.form)
            return Unknown(
                self._defined_key(error.form), error.family if simple else (), simple, error.message
            )
        except UnknownVariable as error:
            return Unknown("", error.family, False, error.message)
        except ReadError:
            return None
        candidates = self._named(value, reader.candidates)
        return Name(candidates) if candidates else None

    def _is_simple(self, tokens: list[Token], form: Form) -> bool:
        """Whether the side is this name and nothing else."""
        scripts = form.scripts
        whole = bool(tokens) and form.start <= tokens[0].end and form.end >= tokens[-1].start
        return whole and not scripts.powers and not scripts.transposed and len(tokens) < 12

    def _defined_key(self, form: Form) -> str:
        return form.key + "'" * form.dots

    def _named(self, value: Value, candidates: tuple[str, ...]) -> tuple[str, ...]:
        """The answers that a value consisting of placeholders alone names."""
        if isinstance(value, Symbol) and (found := referred(value.name)):
            return candidates if found[0] in candidates else (found[0],)
        if force := self._force(value):
            return (force,)
        if isinstance(value, Grid):
            if value.quantity:
                return candidates if value.quantity in candidates else (value.quantity,)
            return self._whole(value)
        return ()

    def _force(self, value: Value) -> str:
        """The force that d/dt(∂L/∂q̇_i) - ∂L/∂q_i is."""
        for q in self.vocabulary.coordinates:
            terms = (Symbol(f"@ddt{q.index}"), Negative(Symbol(f"@dLdq{q.index}")))
            if value == Sum(terms):
                return q.force
        return ""

    def _whole(self, value: Grid) -> tuple[str, ...]:
        """The matrix whose entries are all names: [tau_1; f_2] is tau."""
        vocabulary = self.vocabulary
        n = len(vocabulary.coordinates)
        forces = [q.force for q in vocabulary.coordinates]
        numbers = range(1, n + 1)
        wholes: dict[str, list[list[str]]] = {
            "tau": [[force] for force in forces],
            "g": [[f"g{i}"] for i in numbers],
            "D": [[f"d{i}{j}" for j in numbers] for i in numbers],
            "C": [[f"C{i}{j}" for j in numbers] for i in numbers],
        }
        written = [
            [entry.name[1:] if isinstance(entry, Symbol) else "" for entry in row] for row in value.rows
        ]
        return next(((name,) for name, rows in wholes.items() if rows == written), ())

    # Members

    def member(self, member: list[Token], owners: tuple[str, ...] = ()) -> Read | ReadError:
        """A member's value, or why it has none; readings that take a bolder guess come last.

        `owners` are the answers it may be a value of.
        """
        if not member:
            return ReadError("there is nothing here", 0, 1, _EXPECTED)
        tokens = cut_names(member, self.vocabulary)
        first: Read | ReadError | None = None
        for options in _WAYS:
            if options and not _may_help(options, tokens):
                continue
            found = self._read(tokens, owners, options)
            if isinstance(found, Read) and self._has_shape(found, owners):
                return found
            if first is None or (isinstance(first, ReadError) and isinstance(found, Read)):
                first = found
        assert first is not None
        if isinstance(first, Read):
            return first
        return ReadError(first.message, max(first.offset, member[0].start), max(first.length, 1), first.help)

    def _read(
        self, tokens: list[Token], owners: tuple[str, ...], options: frozenset[str]
    ) -> Read | ReadError:
        owner = owners[0] if owners else ""
        reader = Reader(tokens, self.vocabulary, owner=owner, options=options)
        try:
            value = reader.value()
            definition = isinstance(value, Abstract) or is_names_only(reader, self.vocabulary)
            if not definition:
                self._check_shape(value, owners)
            if not isinstance(value, Abstract):
                measure.check(value.node if isinstance(value, Grid) else value)
        except ReadError as error:
            return error
        except RecursionError:
            return ReadError("this is nested too deeply", 0, 1, "write it in fewer levels")
        return Read(value, tuple(reader.references), tuple(reader.notes), tuple(reader.free), definition)

    def _has_shape(self, found: Read, owners: tuple[str, ...]) -> bool:
        """Whether a value has the shape of one of the answers it is given for."""
        value = found.value
        if isinstance(value, Abstract) or not owners:
            return True
        shapes = [self.vocabulary.shapes.get(owner) for owner in owners]
        if isinstance(value, Grid):
            return any(shape and value.shape in (shape, shape[::-1]) for shape in shapes)
        return value == ZERO or None in shapes or (1, 1) in shapes

    def _check_shape(self, value: Value, owners: tuple[str, ...]) -> None:
        """Raise ReadError for a matrix where only a scalar belongs."""
        if isinstance(value, Grid) and owners and not any(self.vocabulary.shapes.get(o) for o in owners):
            rows, columns = value.shape
            message = f"{owners[0]} is one expression; this is a {rows}×{columns} matrix"
            raise ReadError(message, help="check what is transposed, and what is a vector")

    # Chains with a name

    def _judged(
        self,
        names: list[tuple[str, ...]],
        read: list[tuple[int, Read | ReadError]],
        equation: Equation,
        display: Display,
    ) -> None:
        readable = [index for index, found in read if isinstance(found, Read) and not found.is_definition]
        for index, found in read:
            chain = (self.chains, index)
            if isinstance(found, ReadError):
                if not readable or index > readable[-1]:
                    for candidates in names:
                        self._unreadable(candidates, display, found, equation.label, chain)
            elif not found.is_definition:
                self._value(names, found, equation.members[index], equation.label, display, chain)

    def _value(
        self,
        names: list[tuple[str, ...]],
        found: Read,
        tokens: list[Token],
        label: str,
        display: Display,
        chain: tuple[int, int],
    ) -> None:
        parts = self._model_parts(found.value) if any(c[0] == "tau" for c in names) else {}
        for name, part in parts.items():
            piece = replace(found, value=part)
            self._add((name,), piece, tokens, label, display, chain)
        for candidates in names:
            before = len(self.answers)
            self._add(candidates, found, tokens, label, display, chain)
            if parts and candidates[0] == "tau":
                self._model += self.answers[before:]
                del self.answers[before:]

    def _model_parts(self, value: Value) -> dict[str, Value]:
        """D, C and g of a model [..][q̈] + [..][q̇] + [..]."""
        if not isinstance(value, Grid) or not value.terms:
            return {}
        n = len(self.vocabulary.coordinates)
        parts: dict[str, Value] = {}
        for term in value.terms:
            if term.factors:
                left, right = term.factors
                name = {2: "D", 1: "C"}.get(right.is_rates, "")
                if left.shape != (n, n):
                    return {}
                part: Value = left
            else:
                name, part = "g", term
            if not name or name in parts:
                return {}
            parts[name] = part
        return parts if "D" in parts else {}

    def _add(
        self,
        candidates: tuple[str, ...],
        found: Read,
        tokens: list[Token],
        label: str,
        display: Display,
        chain: tuple[int, int],
    ) -> None:
        """One answer; under the first of its names that has the shape of the value."""
        start, end = tokens[0].start, max(token.end for token in tokens)
        place = display.locate(start, end - start)
        text = display.text[start:end]
        fitted = self._fitted(candidates, found.value)
        if not fitted:
            error = self._misfit(candidates, found.value, start, end)
            self._unreadable(candidates, display, error, label, chain)
            return
        name, node, note = fitted[0]
        note = "" if display.plain and "row" in note else note
        notes = (*found.notes, note) if note else found.notes
        self.answers.append(
            Answer(
                name=name,
                label=label,
                node=node,
                place=place,
                text=_shown(text),
                read_as=to_unicode(with_names(node) if found.references else node, self.style),
                notes=notes,
                alternatives=tuple(other for other, _, _ in fitted[1:]),
                references=found.references,
                free=found.free,
                occurrence=chain,
            )
        )

    def _fitted(self, candidates: tuple[str, ...], value: Value) -> list[tuple[str, Node, str]]:
        """(name, tree, note) of the candidates that a value can be, of its very shape if any is."""
        exact: list[tuple[str, Node, str]] = []
        loose: list[tuple[str, Node, str]] = []
        for name in candidates:
            shape = self.vocabulary.shapes.get(name)
            if shape is None:
                if isinstance(value, Node):
                    exact.append((name, value, ""))
            elif isinstance(value, Grid):
                if value.shape == shape:
                    exact.append((name, value.node, ""))
                elif value.shape == shape[::-1] and 1 in shape:
                    turned = transposed(value)
                    assert isinstance(turned, Grid)
                    loose.insert(0, (name, turned.node, "the row is read as a column"))
                else:
                    loose.append((name, value.node, ""))
            elif shape == (1, 1) and isinstance(value, Node):
                exact.append((name, Matrix(((value,),)), ""))
            elif value == ZERO:
                rows, columns = shape
                zeros = Matrix(((ZERO,) * columns,) * rows)
                loose.append((name, zeros, "0 is read as the matrix of zeros"))
        return exact or loose

    def _misfit(self, candidates: tuple[str, ...], value: Value, start: int, end: int) -> ReadError:
        name = candidates[0]
        shape = self.vocabulary.shapes.get(name)
        found = f"a {value.shape[0]}×{value.shape[1]} matrix" if isinstance(value, Grid) else "one expression"
        wanted = f"a {shape[0]}×{shape[1]} matrix" if shape else "one expression"
        return ReadError(
            f"{name} is {wanted}; this is {found}", start, max(end - start, 1), f"write {wanted}"
        )

    def _unreadable(
        self,
        candidates: tuple[str, ...],
        display: Display,
        error: ReadError,
        label: str,
        chain: tuple[int, int],
    ) -> None:
        self.answers.append(
            Answer(
                name=candidates[0],
                label=label,
                node=None,
                place=display.locate(error.offset, error.length),
                text=_shown(display.text),
                fault=error.message,
                expected=error.help or _EXPECTED,
                alternatives=candidates[1:],
                occurrence=chain,
            )
        )

    # Chains without a name

    def _without_name(
        self,
        sides: list[Name | Unknown | None],
        read: list[tuple[int, Read | ReadError]],
        equation: Equation,
        display: Display,
    ) -> None:
        values = [
            found for _, found in read if isinstance(found, Read) and not isinstance(found.value, Abstract)
        ]
        first = sides[0]
        tokens = equation.members[0]
        place = display.locate(tokens[0].start, max(tokens[-1].end - tokens[0].start, 1))
        whole = display.text[tokens[0].start : equation.members[-1][-1].end]
        refused = NotRecognized(_shown(whole), equation.label, place)
        if isinstance(first, Unknown):
            if first.family:
                self._put_off(first, values, read, refused, equation, display)
            elif first.simple and values:
                self.define(first.key, values[-1])
            elif first.simple:
                faults = [found for _, found in read if isinstance(found, ReadError)]
                if faults:
                    self.vocabulary.broken[first.key] = faults[-1].message
            elif not display.plain:
                self.not_recognized.append(refused)
            return
        model = next((self._model_parts(v.value) for v in values if self._model_parts(v.value)), {})
        if model:
            index = next(i for i, found in read if isinstance(found, Read) and self._model_parts(found.value))
            found = next(f for i, f in read if i == index and isinstance(f, Read))
            self._value(
                [("tau",)], found, equation.members[index], equation.label, display, (self.chains, index)
            )
            return
        leading = read[0][1] if read and read[0][0] == 0 else None
        if isinstance(leading, Read) and leading.is_definition:
            return
        if not display.plain:
            self.not_recognized.append(refused)

    def _put_off(
        self,
        unknown: Unknown,
        values: list[Read],
        read: list[tuple[int, Read | ReadError]],
        refused: NotRecognized,
        equation: Equation,
        display: Display,
    ) -> None:
        """Keep an equation until it is known which answers are absent."""
        before = len(self.answers)
        if values:
            index = next(i for i, found in read if found is values[-1])
            self._add(
                unknown.family[:1],
                values[-1],
                equation.members[index],
                equation.label,
                display,
                (self.chains, index),
            )
        made = tuple(self.answers[before:])
        del self.answers[before:]
        note = unknown.message.replace("unknown symbol ", "")
        made = tuple(replace(a, notes=(*a.notes, note)) for a in made)
        self.pending.append(_Pending(unknown.family, made, refused, before))

    def define(self, name: str, found: Read) -> None:
        """Keep a name for what follows."""
        if len(self.vocabulary.defined) >= MAX_DEFINITIONS or name in self.vocabulary.symbols:
            return
        self.vocabulary.defined[name] = Meaning(found.value)
        self.vocabulary.broken.pop(name, None)

    # The end

    def finish(self) -> None:
        """Settle what needs the whole file: indices that are none, and a model without torques."""
        given = {answer.name for answer in self.answers}
        shift = 0
        for pending in self.pending:
            absent = [name for name in pending.family if name not in given]
            if len(absent) == 1 and pending.answers:
                name = absent[0]
                note = f"taken for {name}, the only one of its kind that is absent"
                taken = [replace(a, name=name, notes=(*a.notes, note)) for a in pending.answers]
                self.answers[pending.at + shift : pending.at + shift] = taken
                shift += len(taken)
                given.add(name)
            else:
                self.not_recognized.append(pending.refused)
        forces = {q.force for q in self.vocabulary.coordinates}
        if self._model and "tau" not in given and not forces <= given:
            self.answers += self._model


def with_names(node: Node) -> Node:
    """The tree with the names of answers for their placeholders, to be printed."""
    match node:
        case Symbol(name) if name.startswith("@"):
            return Words(name[1:])
        case Sum(terms):
            return Sum(tuple(map(with_names, terms)))
        case Product(factors):
            return Product(tuple(map(with_names, factors)))
        case Quotient(numerator, denominator):
            return Quotient(with_names(numerator), with_names(denominator))
        case Power(base, exponent):
            return Power(with_names(base), exponent)
        case Negative(argument):
            return Negative(with_names(argument))
        case Function(name, argument):
            return Function(name, with_names(argument))
        case Matrix(rows):
            return Matrix(tuple(tuple(map(with_names, row)) for row in rows))
    return node


def is_names_only(reader: Reader, vocabulary: Vocabulary) -> bool:
    """Whether what was read holds names of the derivation alone, or masses beside its vectors."""
    if not reader.references and not reader.names_used:
        return False
    if not reader.symbols:
        return True
    vectors = any(vocabulary.shapes.get(name) for name in reader.references)
    return vectors and set(reader.symbols) <= vocabulary.masses


def _may_help(options: frozenset[str], tokens: list[Token]) -> bool:
    """Whether another way of reading could make sense of these tokens."""
    if "inertia" in options:
        return any(t.kind == "name" and t.text[0] in "IJ" for t in tokens)
    return any(t.kind == "[" for t in tokens)


def _shown(text: str) -> str:
    """A text as it is kept with what was not recognized."""
    text = printable(" ".join(text.split()))
    return text if len(text) <= _LONGEST_SHOWN else text[: _LONGEST_SHOWN - 3] + "..."


def label_alone(text: str) -> str:
    """The number of an equation, if the text of a display is nothing else."""
    if len(text) > 40:
        return ""
    try:
        return is_label(simplified(scan(text)))
    except ReadError:
        return ""
