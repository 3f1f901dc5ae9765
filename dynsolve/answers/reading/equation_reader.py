"""The equations of one file, read in order: what each is an answer to, and what it defines.

A session keeps what the student defined so far and gathers the answers.  Of a chain
a = b = c the names are found first; then every member that is a value is one answer
to each of them, and what consists of names alone is left alone as a definition.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from dynsolve.answers.reading.displays import Display, Equation, chain, equations
from dynsolve.answers.reading.grids import Abstract
from dynsolve.answers.reading.left_side import NamedAnswers, Side, Unknown, side_of, sides
from dynsolve.answers.reading.lexer import Token, scan
from dynsolve.answers.reading.limits import MAX_ANSWERS, MAX_DEFINITIONS, MAX_MEMBERS
from dynsolve.answers.reading.prepare import Macro, expand, simplified
from dynsolve.answers.reading.right_side import EXPECTED, Read, read_member
from dynsolve.answers.reading.shapes import fitted, misfit, model_parts, shown
from dynsolve.answers.reading.vocabulary import Meaning, Vocabulary, key
from dynsolve.answers.submission import Answer, NotRecognized, Place
from dynsolve.errors import ReadError
from dynsolve.notation.unicode import UnicodePrinter


@dataclass(frozen=True, slots=True)
class _Pending:
    """An equation whose left side has an index that is none: taken for the one answer that is absent."""

    family: tuple[str, ...]
    answers: tuple[Answer, ...]
    refused: NotRecognized
    at: int


class Session:
    """Reads equation after equation of one hand-in; `printer` writes how each was read."""

    def __init__(self, vocabulary: Vocabulary, printer: UnicodePrinter) -> None:
        self.vocabulary, self.printer = vocabulary, printer
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
            found = equations(self._tokens(display))
        except ReadError as error:
            self._unscanned(display, error)
            return
        for equation in found:
            if len(self.answers) < MAX_ANSWERS:
                self._equation(Equation(equation.members, equation.label or display.label), display)

    def _tokens(self, display: Display) -> list[Token]:
        """The tokens of a display, ready to be read; raises ReadError where it has none."""
        return simplified(expand(scan(display.text), self.macros))

    def _unscanned(self, display: Display, error: ReadError) -> None:
        """A display that has no tokens: its left side alone may still say what it answers."""
        head, _, _ = display.text.partition("=")
        try:
            tokens = simplified(expand(scan(head), self.macros))
            name = side_of(self.vocabulary, tokens[:-1])
        except ReadError:
            name = None
        place = display.locate(error.offset, error.length)
        if isinstance(name, NamedAnswers):
            self.chains += 1
            self._unreadable(name.candidates, display, error, display.label, (self.chains, 1))
        else:
            self.not_recognized.append(NotRecognized(shown(display.text), display.label, place))

    def _equation(self, equation: Equation, display: Display) -> None:
        self.chains += 1
        members = equation.members
        if len(members) > MAX_MEMBERS:
            start = members[0][0].start
            place = display.locate(start, 1)
            self.not_recognized.append(NotRecognized(shown(display.text[start:]), equation.label, place))
            return
        found_sides = sides(self.vocabulary, members)
        names = list(dict.fromkeys(side.candidates for side in found_sides if isinstance(side, NamedAnswers)))
        owners = tuple(name for candidates in names for name in candidates)
        read: list[tuple[int, Read | ReadError]] = []
        for index, member in enumerate(members):
            if not isinstance(found_sides[index], (NamedAnswers, Unknown)):
                read.append((index, read_member(self.vocabulary, member, owners)))
        if names and self._is_own_letter(members, names, read):
            self.define(key(members[0][0].text), next(f for _, f in read if isinstance(f, Read)))
        elif names and self._is_constant(members, names, read):
            place = display.locate(members[0][0].start, 1)
            whole = display.text[members[0][0].start : members[-1][-1].end]
            self.not_recognized.append(NotRecognized(shown(whole), equation.label, place))
        elif names:
            self._judged(names, read, equation, display)
        else:
            self._without_name(found_sides, read, equation, display)

    def answer(self, name: str, place: Place, display: Display) -> None:
        """Read the value that an answer file gives under a name."""
        self.chains += 1
        side = self._key(name)
        if not isinstance(side, NamedAnswers):
            family = side.family if isinstance(side, Unknown) else ()
            refused = NotRecognized(shown(f"{name}: {display.text}"), "", place)
            if not family:
                self.not_recognized.append(refused)
                return
            side = NamedAnswers(family[:1])
        before = len(self.answers)
        self._given(side.candidates, display)
        if isinstance(self._key(name), Unknown):
            made = tuple(self.answers[before:])
            del self.answers[before:]
            self.pending.append(_Pending(family, made, refused, before))

    def _key(self, name: str) -> Side:
        """What a key of an answer file names."""
        if name.startswith("I") and name in self.vocabulary.shapes:
            return NamedAnswers((name,))
        try:
            return side_of(self.vocabulary, simplified(scan(name))[:-1])
        except ReadError:
            return None

    def _given(self, candidates: tuple[str, ...], display: Display) -> None:
        """The members of a value, each of them an answer."""
        label = display.label
        try:
            members = chain(self._tokens(display))
        except ReadError as error:
            self._unreadable(candidates, display, error, label, (self.chains, 0))
            return
        if len(members) > MAX_MEMBERS:
            fault = ReadError(f"more than {MAX_MEMBERS} members of one chain", 0, 1, "write the value alone")
            self._unreadable(candidates, display, fault, label, (self.chains, 0))
            return
        side = side_of(self.vocabulary, members[0]) if len(members) > 1 else None
        if isinstance(side, NamedAnswers) and set(side.candidates) & set(candidates):
            members = members[1:]
        for index, member in enumerate(members):
            where = (self.chains, index)
            if not member:
                fault = ReadError("nothing stands on one side of this `=`", 0, 1, "write the value alone")
                self._unreadable(candidates, display, fault, label, where)
                continue
            found = read_member(self.vocabulary, member, candidates)
            if isinstance(found, Read) and isinstance(found.value, Abstract):
                found = ReadError(
                    found.value.why, member[0].start, 1, "write it in the symbols of the problem"
                )
            if isinstance(found, ReadError):
                self._unreadable(candidates, display, found, label, where)
            else:
                self._value([candidates], found, member, label, display, where)

    def _is_constant(
        self,
        members: list[list[Token]],
        names: list[tuple[str, ...]],
        read: list[tuple[int, Read | ReadError]],
    ) -> bool:
        """Whether `g = 9.81 m/s^2` says what a symbol of the problem is, no value fitting the answer."""
        if len(names) > 1 or len(members[0]) > 1 or key(members[0][0].text) not in self.vocabulary.symbols:
            return False
        if any(token.kind in ("begin", "[") for member in members for token in member):
            return False
        values = [found.value for _, found in read if isinstance(found, Read) and not found.is_definition]
        return bool(read) and not any(fitted(self.vocabulary, names[0], value) for value in values)

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
        return bool(values) and not any(fitted(self.vocabulary, names[0], value) for value in values)

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
        parts = model_parts(self.vocabulary, found.value) if any(c[0] == "tau" for c in names) else {}
        for name, part in parts.items():
            piece = replace(found, value=part)
            self._add((name,), piece, tokens, label, display, chain)
        for candidates in names:
            before = len(self.answers)
            self._add(candidates, found, tokens, label, display, chain)
            if parts and candidates[0] == "tau":
                self._model += self.answers[before:]
                del self.answers[before:]

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
        fits = fitted(self.vocabulary, candidates, found.value)
        if not fits:
            error = misfit(self.vocabulary, candidates, found.value, start, end)
            self._unreadable(candidates, display, error, label, chain)
            return
        name, node, note = fits[0]
        note = "" if display.plain and "row" in note else note
        notes = (*found.notes, note) if note else found.notes
        self.answers.append(
            Answer(
                name=name,
                label=label,
                node=node,
                place=place,
                text=shown(text),
                read_as=self.printer.text(node),
                notes=notes,
                alternatives=tuple(other for other, _, _ in fits[1:]),
                references=found.references,
                free=found.free,
                occurrence=chain,
            )
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
                text=shown(display.text),
                fault=error.message,
                expected=error.help or EXPECTED,
                alternatives=candidates[1:],
                occurrence=chain,
            )
        )

    # Chains without a name

    def _without_name(
        self,
        named: list[Side],
        read: list[tuple[int, Read | ReadError]],
        equation: Equation,
        display: Display,
    ) -> None:
        values = [
            found for _, found in read if isinstance(found, Read) and not isinstance(found.value, Abstract)
        ]
        first = named[0]
        tokens = equation.members[0]
        place = display.locate(tokens[0].start, max(tokens[-1].end - tokens[0].start, 1))
        whole = display.text[tokens[0].start : equation.members[-1][-1].end]
        refused = NotRecognized(shown(whole), equation.label, place)
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
        model = next(
            (model_parts(self.vocabulary, v.value) for v in values if model_parts(self.vocabulary, v.value)),
            {},
        )
        if model:
            index = next(
                i
                for i, found in read
                if isinstance(found, Read) and model_parts(self.vocabulary, found.value)
            )
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
        self.vocabulary.define(name, Meaning(found.value))
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
