"""The equations of one file, read in order: what each is an answer to, and what it defines.

Of a chain a = b = c the names are found first (`left_side`); then every other member is
read as a value (`right_side`) and is one answer to each of the names (`answer_list`).  A
member of names alone, like K = K_1 + K_2, is a definition and no answer.  A chain whose left
side is a name of the student's own defines that name for what follows.
"""

from __future__ import annotations

import re
from dataclasses import replace

from dynsolve.answers.reading.answer_list import AnswerList, Member, Origin
from dynsolve.answers.reading.displays import Display, Equation, chain, equations
from dynsolve.answers.reading.grammar.references import OWN_LETTERS
from dynsolve.answers.reading.grids import Abstract, Grid
from dynsolve.answers.reading.left_side import (
    LeftSide,
    NamedAnswers,
    UnknownSide,
    name_alone,
    read_left_side,
    read_left_sides,
)
from dynsolve.answers.reading.lexer import Token
from dynsolve.answers.reading.limits import MAX_ANSWERS, MAX_DEFINITIONS, MAX_MEMBERS
from dynsolve.answers.reading.own_names import gives_new_meaning, keep_symbol
from dynsolve.answers.reading.prepare import Macro, prepared
from dynsolve.answers.reading.right_side import RightSide, read_right_side
from dynsolve.answers.reading.shapes import fitted, is_gravity_vector, model_parts, shown
from dynsolve.answers.reading.vector_entries import entry_of
from dynsolve.answers.reading.vocabulary import Meaning, Vocabulary
from dynsolve.answers.submission import Answer, NotRecognized, Place
from dynsolve.errors import ReadError
from dynsolve.notation.tree import Node, Symbol
from dynsolve.notation.unicode import UnicodePrinter
from dynsolve.notation.walk import walk
from dynsolve.quantities.spelling import key

_CONTROL = re.compile(r"unknown (?:symbol `[Kk]_?\{?[pPdDiI]\}?`|command `\\tilde`)")
"""What a controller's gains and errors are told as: an equation that holds them is none of the answers."""

_NEVER_DEFINED = frozenset({"t", "i", "j", "k", "n"})
"""Letters of sentences that are no abbreviation: the time, running indices, the number of joints."""


class EquationReader:
    """Reads equation after equation of one hand-in.

    `vocabulary` grows by what the student defines, `macros` are the student's own LaTeX
    commands, `found` gathers the answers, `equations` counts the chains that were read,
    `coordinates` are what the student's own names for symbols stand for.
    """

    def __init__(self, vocabulary: Vocabulary, printer: UnicodePrinter) -> None:
        self.vocabulary = vocabulary
        self.macros: dict[str, Macro] = {}
        self.found = AnswerList(vocabulary, printer)
        self.equations = 0
        self.coordinates: list[Node] = []
        self._first: dict[str, Meaning] = {}
        self._ahead: dict[str, Meaning] = {}

    def define(self, name: str, value: RightSide) -> None:
        """Keep a name for what follows."""
        if len(self.vocabulary.defined) >= MAX_DEFINITIONS or name in self.vocabulary.symbols:
            return
        self.vocabulary.define(name, Meaning(value.value))
        self._first.setdefault(name, Meaning(value.value))
        self.vocabulary.broken.pop(name, None)

    def begins_anew(self) -> bool:
        """Forget all but what was used before it was defined (`C = h ..., where h = ...`).

        False where there is nothing of that kind that was not known already.  The report is
        then to be read once more; a definition holds for what stands before the first one too.
        """
        late = {name: self._first[name] for name in self._first if name in self.vocabulary.missed}
        if late.keys() <= self._ahead.keys():
            return False
        self._ahead |= late
        self.vocabulary = self.vocabulary.fresh()
        self.vocabulary.defined |= self._ahead
        self.found = AnswerList(self.vocabulary, self.found.printer)
        self.macros, self._first, self.equations = {}, {}, 0
        return True

    # Equations of a report

    def read_display(self, display: Display) -> None:
        """Read the equations of one display."""
        try:
            found = equations(prepared(display.text, self.macros))
        except ReadError as error:
            self._display_without_tokens(display, error)
            return
        if not found and "=" in display.text and not display.plain and not display.aside:
            place = display.locate(0, len(display.text))
            self.found.not_recognized.append(NotRecognized(shown(display.text), display.label, place))
        for equation in found:
            if display.aside:
                self._aside(equation, Origin(display, "", self.equations))
                continue
            if len(self.found.answers) < MAX_ANSWERS:
                self._read_equation(equation, self._origin(display, equation.label or display.label))

    def _origin(self, display: Display, label: str) -> Origin:
        """Where the next equation stands."""
        self.equations += 1
        return Origin(display, label, self.equations)

    def _display_without_tokens(self, display: Display, error: ReadError) -> None:
        """A display that cannot be cut into tokens: its left side alone may still say what it answers."""
        head, _, _ = display.text.partition("=")
        try:
            name = read_left_side(self.vocabulary, prepared(head, self.macros)[:-1])
        except ReadError:
            name = None
        if isinstance(name, NamedAnswers) and not display.among_prose:
            origin = self._origin(display, display.label)
            self.found.answers.append(self.found.unreadable(name.candidates, error, origin, 1))
        else:
            place = display.locate(error.offset, error.length)
            self.found.not_recognized.append(NotRecognized(shown(display.text), display.label, place))

    def _read_equation(self, equation: Equation, origin: Origin) -> None:
        """Read one chain a = b = c."""
        members = equation.members
        start, end = members[0][0].start, members[-1][-1].end
        if len(members) > MAX_MEMBERS:
            whole = origin.not_recognized(start, len(origin.display.text))
            self.found.not_recognized.append(whole)
            return
        sides = read_left_sides(self.vocabulary, members)
        names = list(dict.fromkeys(side.candidates for side in sides if isinstance(side, NamedAnswers)))
        owners = tuple(name for candidates in names for name in candidates)
        read = [
            Member(index, tokens, read_right_side(self.vocabulary, tokens, owners))
            for index, tokens in enumerate(members)
            if not isinstance(sides[index], (NamedAnswers, UnknownSide))
        ]
        read = self._defined_by_the_end(read)
        if self._entry_of_vector(members[0], read, origin):
            return
        if not names:
            self._without_name(sides[0], members, read, origin)
        elif self._defines_own_letter(members[0], names, read):
            first = next(member.found for member in read if isinstance(member.found, RightSide))
            self.define(key(members[0][0].text), first)
        elif self._states_constant(members, names, read):
            self.found.not_recognized.append(origin.not_recognized(start, end))
        else:
            self._with_names(names, read, origin, origin.not_recognized(start, end))

    def _entry_of_vector(self, first: list[Token], read: list[Member], origin: Origin) -> bool:
        """Keep what may be one row of C q̇; whether its arguments say that it is nothing else."""
        values = [member for member in read if _is_value(member.found)]
        entry = entry_of(self.vocabulary, first) if values else None
        if entry is None:
            return False
        end = max(token.end for token in values[-1].tokens)
        self.found.entry(entry, values[-1], origin, origin.not_recognized(first[0].start, end))
        return entry.is_sure and entry.letter != "V"

    def _aside(self, equation: Equation, origin: Origin) -> None:
        """Keep what a formula in a sentence says of a letter; it is no answer."""
        members = equation.members
        if len(members) > MAX_MEMBERS:
            return
        side = read_left_side(self.vocabulary, members[0])
        own = members[0][0].text if len(members[0]) == 1 else ""
        is_new = isinstance(side, UnknownSide) and side.is_name_alone and not side.family
        value = read_right_side(self.vocabulary, members[-1])
        if isinstance(value, ReadError):
            if isinstance(side, UnknownSide):
                self.vocabulary.broken[side.key] = value.message
        elif isinstance(value.value, Abstract):
            return
        elif is_new and isinstance(side, UnknownSide) and side.key not in _NEVER_DEFINED:
            self.define(side.key, value)
        elif isinstance(side, NamedAnswers) and self._any_fits(side.candidates, [value]):
            start, end = members[0][0].start, members[-1][-1].end
            self.found.said_aside(side.candidates, origin.not_recognized(start, end))
        elif isinstance(side, NamedAnswers):
            if own in OWN_LETTERS:
                self.define(own, value)
        elif side is None:
            self._in_passing(members[0], value)

    def _in_passing(self, first: list[Token], found: RightSide) -> bool:
        """Keep another meaning of what would be read as a coordinate; whether there was one."""
        name = name_alone(self.vocabulary, first)
        if not gives_new_meaning(self.vocabulary, name, found.value):
            return False
        keep_symbol(self.vocabulary, name, 0, found.value, in_passing=True)
        return True

    def _defined_by_the_end(self, read: list[Member]) -> list[Member]:
        """The members but for an unknown name at the end, `... = c_1 = h`, which stands for the value."""
        values = _values(read)
        if len(read) < 2 or not values or not isinstance(read[-1].found, ReadError):
            return read
        last = read[-1].tokens
        side = read_left_side(self.vocabulary, last)
        if isinstance(side, NamedAnswers) and len(last) == 1 and last[0].text in OWN_LETTERS:
            self.define(last[0].text, values[-1])
        elif isinstance(side, UnknownSide) and side.is_name_alone and not side.family:
            self.define(side.key, values[-1])
        else:
            return read
        return read[:-1]

    def _defines_own_letter(
        self, first: list[Token], names: list[tuple[str, ...]], read: list[Member]
    ) -> bool:
        """Whether `h = ...` defines an abbreviation, its value having no shape of what books call h."""
        if len(names) > 1 or len(first) > 1 or self.vocabulary.is_answer(key(first[0].text)):
            return False
        values = _values(read)
        return bool(values) and not self._any_fits(names[0], values)

    def _states_constant(
        self, members: list[list[Token]], names: list[tuple[str, ...]], read: list[Member]
    ) -> bool:
        """Whether `g = 9.81 m/s^2` says what a symbol of the problem is, no value fitting the answer."""
        first = members[0]
        if names == [("g",)] and self._is_gravity(_values(read)):
            return True
        if names == [("D",)] and [token.text for token in first] == ["B"] and self._is_input(_values(read)):
            return True
        if len(names) > 1 or len(first) > 1 or key(first[0].text) not in self.vocabulary.symbols:
            return False
        if any(token.kind in ("begin", "[") for member in members for token in member):
            return False
        return bool(read) and not self._any_fits(names[0], _values(read))

    def _is_input(self, values: list[RightSide]) -> bool:
        """Whether B is the matrix of the inputs, B u: one of constants, or of another shape than D."""
        shape = self.vocabulary.shape("D")
        return any(
            isinstance(found.value, Grid)
            and (found.value.shape != shape or not any(isinstance(p, Symbol) for p in walk(found.value.node)))
            for found in values
        )

    def _is_gravity(self, values: list[RightSide]) -> bool:
        """Whether a value is the vector of the acceleration of gravity, [0, 0, -g], and not its torques."""
        return any(is_gravity_vector(found.value, len(self.vocabulary.coordinates)) for found in values)

    def _any_fits(self, candidates: tuple[str, ...], values: list[RightSide]) -> bool:
        return any(fitted(self.vocabulary, candidates, found.value) for found in values)

    def _with_names(
        self, names: list[tuple[str, ...]], read: list[Member], origin: Origin, refused: NotRecognized
    ) -> None:
        """Every value is an answer to each name; what cannot be read is one where no value follows it."""
        values = [member.index for member in read if _is_value(member.found)]
        for member in read:
            if _is_value(member.found):
                self.found.answers += self.found.value(names, member, origin)
            elif isinstance(member.found, ReadError) and _CONTROL.match(member.found.message):
                self.found.not_recognized.append(refused)
            elif origin.display.among_prose:
                if isinstance(member.found, ReadError):
                    whole = origin.not_recognized(0, len(origin.display.text))
                    self.found.not_recognized.append(whole)
            elif isinstance(member.found, ReadError) and (not values or member.index > values[-1]):
                self.found.answers += [self.found.answer(candidates, member, origin) for candidates in names]

    def _without_name(
        self, first: LeftSide, members: list[list[Token]], read: list[Member], origin: Origin
    ) -> None:
        """A chain that names no answer: a definition, a model, or what is not recognized."""
        start, end = members[0][0].start, members[0][-1].end
        place = origin.display.locate(start, max(end - start, 1))
        whole = origin.display.text[start : members[-1][-1].end]
        refused = NotRecognized(shown(whole), origin.label, place)
        if isinstance(first, UnknownSide):
            self._unknown_side(first, read, refused, origin)
            return
        for member in read:
            if isinstance(member.found, RightSide) and model_parts(self.vocabulary, member.found.value):
                self.found.answers += self.found.value([("tau",)], member, origin)
                return
        for member in read[1:]:
            if isinstance(member.found, RightSide) and self._in_passing(members[0], member.found):
                return
        leading = read[0].found if read and read[0].index == 0 else None
        is_definition = isinstance(leading, RightSide) and leading.is_definition
        if not is_definition and (not origin.display.plain or _values(read)):
            self.found.not_recognized.append(refused)

    def _unknown_side(
        self, side: UnknownSide, read: list[Member], refused: NotRecognized, origin: Origin
    ) -> None:
        """A left side that means nothing: an index that does not exist, or a name of the student's own."""
        values = [
            member
            for member in read
            if isinstance(member.found, RightSide) and not isinstance(member.found.value, Abstract)
        ]
        faults = [member.found for member in read if isinstance(member.found, ReadError)]
        if side.family:
            note = side.message.replace("unknown symbol ", "")
            made = [self.found.answer(side.family[:1], member, origin) for member in values[-1:]]
            made = [replace(answer, notes=(*answer.notes, note)) for answer in made]
            self.found.put_off(side.family, made, refused)
        elif side.is_name_alone and values:
            found = values[-1].found
            assert isinstance(found, RightSide)
            self.define(side.key, found)
        elif side.is_name_alone:
            if faults:
                self.vocabulary.broken[side.key] = faults[-1].message
            if not origin.display.plain:
                self.found.not_recognized.append(refused)
        elif values or not origin.display.plain:
            self.found.not_recognized.append(refused)

    # Values of an answer file

    def read_answer(self, name: str, place: Place, display: Display) -> None:
        """Read the value that an answer file gives under a name."""
        origin = self._origin(display, display.label)
        side = self._key(name)
        refused = NotRecognized(shown(f"{name}: {display.text}"), "", place)
        if isinstance(side, NamedAnswers):
            self.found.answers += self._given(side.candidates, origin)
        elif isinstance(side, UnknownSide) and side.family:
            made = self._given(side.family[:1], origin)
            self.found.put_off(side.family, made, refused)
        else:
            self.found.not_recognized.append(refused)

    def _key(self, name: str) -> LeftSide:
        """What a key of an answer file names."""
        if name.startswith("I") and self.vocabulary.is_answer(name):
            return NamedAnswers((name,))
        try:
            return read_left_side(self.vocabulary, prepared(name)[:-1])
        except ReadError:
            return None

    def _given(self, candidates: tuple[str, ...], origin: Origin) -> list[Answer]:
        """The answers that the members of a value are."""
        try:
            members = chain(prepared(origin.display.text, self.macros))
            if len(members) > MAX_MEMBERS:
                message = f"more than {MAX_MEMBERS} members of one chain"
                raise ReadError(message, 0, 1, "write the value alone")
        except ReadError as error:
            return [self.found.unreadable(candidates, error, origin, 0)]
        side = read_left_side(self.vocabulary, members[0]) if len(members) > 1 else None
        if isinstance(side, NamedAnswers) and set(side.candidates) & set(candidates):
            members = members[1:]
        made: list[Answer] = []
        for index, tokens in enumerate(members):
            member = Member(index, tokens, self._given_value(candidates, tokens))
            if isinstance(member.found, ReadError):
                made.append(self.found.answer(candidates, member, origin))
            else:
                made += self.found.value([candidates], member, origin)
        return made

    def _given_value(self, candidates: tuple[str, ...], tokens: list[Token]) -> RightSide | ReadError:
        """The value of a member, which is no value where it consists of letters of the derivation."""
        if not tokens:
            return ReadError("nothing stands on one side of this `=`", 0, 1, "write the value alone")
        found = read_right_side(self.vocabulary, tokens, candidates)
        if isinstance(found, RightSide) and isinstance(found.value, Abstract):
            help = "write it in the symbols of the problem"
            return ReadError(found.value.why, tokens[0].start, 1, help)
        return found


def _is_value(found: RightSide | ReadError) -> bool:
    return isinstance(found, RightSide) and not found.is_definition


def _values(read: list[Member]) -> list[RightSide]:
    found = [member.found for member in read]
    return [value for value in found if isinstance(value, RightSide) and not value.is_definition]
