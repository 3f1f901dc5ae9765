"""The answers of one hand-in as they are found: a value becomes a record under a name of its shape.

A quantity that is given several times: what cannot be read never takes the place of what can.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

from msgspec import Struct, field
from msgspec.structs import replace

from dynsolve.answers.reading.by_content import MotionEquation
from dynsolve.answers.reading.displays import Display
from dynsolve.answers.reading.grammar.brackets import SYMMETRIC_NOTE
from dynsolve.answers.reading.left_side import EXPECTED, RightSide, is_abstract, is_name, read_right_side
from dynsolve.answers.reading.lexer import Token
from dynsolve.answers.reading.matrix_parts import (
    Entry,
    VectorEntries,
    column,
    fitted,
    misfit,
    model_parts,
    others,
    shown,
    with_own_entries,
    written_entries,
)
from dynsolve.answers.reading.report_text import FREE, is_of_case
from dynsolve.answers.reading.vocabulary import Vocabulary
from dynsolve.answers.verdict import Answer, ConfigurationAnswer, NotRecognized, Place, VerdictAnswer
from dynsolve.errors import ReadError
from dynsolve.notation.tree import ZERO, Matrix, Node, Reference, Symbol, mapped, names_in, walk
from dynsolve.notation.unicode import UnicodePrinter
from dynsolve.quantities.index import Quantities
from dynsolve.quantities.stages import Stage
from dynsolve.questions.forward_dynamics import QDD_FORWARD
from dynsolve.questions.parameters import REFERENCE

# A quantity that is given several times


def readable(answers: Sequence[Answer], quantities: Quantities) -> tuple[list[Answer], list[NotRecognized]]:
    r"""The answers that count, and those that could not be read although their quantity is given elsewhere.

    A report that gives τ row by row and then says `\tau = D \ddot q + F_v \dot q` has given τ.  A
    vector or a matrix is given elsewhere where all its entries are.
    """
    given = {answer.name for answer in answers if answer.node is not None}
    kept: list[Answer] = []
    lost: list[NotRecognized] = []
    for answer in answers:
        quantity = quantities.get(answer.name)
        parts = quantities.parts(answer.name) if quantity is not None and quantity.shape else ()
        is_given = answer.name in given or (bool(parts) and given.issuperset(parts))
        if answer.node is None and is_given:
            lost.append(_refused(answer, answer.fault, answer.name))
        else:
            kept.append(answer)
    return kept, lost


def _refused(answer: Answer, why: str, name: str) -> NotRecognized:
    """The record of an answer that does not count."""
    return NotRecognized(answer.text, answer.label, answer.place, why, (name,))


class Origin(Struct, frozen=True):
    """Where values come from: a display, the label of the equation in it, and its number in the file.

    `names` are the answers that the sides of the equation name.
    """

    display: Display
    label: str
    equation: int
    names: tuple[str, ...] = ()

    def not_recognized(self, start: int, end: int, why: str = "") -> NotRecognized:
        """The record of a stretch of the display that is no answer."""
        text = self.display.text[start:end]
        return NotRecognized(shown(text), self.label, self.display.locate(start, 1), why, self.names)

    def of(self, members: list[list[Token]], why: str) -> NotRecognized:
        """The record of an equation that is no answer."""
        return self.not_recognized(members[0][0].start, members[-1][-1].end, why)


class Member(Struct, frozen=True):
    """One member of a chain a = b = c that is no name: its value, or why it has none."""

    index: int
    tokens: list[Token]
    found: RightSide | ReadError


UNDRIVEN = "it is written as = 0, without the force that drives it"


class AnswerList(Struct, dict=True):
    """The answers of one hand-in, in the order of the file; `printer` writes how each was read.

    `not_recognized`, `left_alone` and `general` are what is no answer, as in a `Submission`; `own_scalars`
    are definitions where what they are kept under is used, else answers of another shape; `in_case` has the
    numbers of the equations that count where no other answers the same, with the reason, `others_zero` where
    it is said that the entries which are not written are zero; `_undecided` are equations whose left side has
    an index that does not exist: (its family, the answers that it gives if it counts, their place).
    """

    vocabulary: Vocabulary
    printer: UnicodePrinter
    answers: list[Answer] = field(default_factory=list)
    not_recognized: list[NotRecognized] = field(default_factory=list)
    left_alone: list[NotRecognized] = field(default_factory=list)
    general: list[Answer] = field(default_factory=list)
    configurations: list[ConfigurationAnswer] = field(default_factory=list)
    verdicts: list[VerdictAnswer] = field(default_factory=list)
    own_scalars: list[tuple[str, list[Answer], NotRecognized]] = field(default_factory=list)
    in_case: dict[int, str] = field(default_factory=dict)
    others_zero: list[tuple[Place, str]] = field(default_factory=list)
    _undecided: list[tuple[tuple[str, ...], list[Answer], NotRecognized, int]] = field(default_factory=list)
    _models: list[Answer] = field(default_factory=list)
    _asides: list[tuple[NotRecognized, Sequence[Answer]]] = field(default_factory=list)
    _motions: list[tuple[MotionEquation, list[Token], Origin, NotRecognized]] = field(default_factory=list)
    _accelerations: dict[int, Answer] = field(default_factory=dict)

    @cached_property
    def _entries(self) -> VectorEntries:
        return VectorEntries(self.vocabulary)

    def entry(self, entry: Entry, member: Member, origin: Origin, refused: NotRecognized) -> None:
        """Keep what may be one row of C q̇ until it is known what stands beside it."""
        answer = self.answer(("P",), member, origin)  # a scalar of any name
        self._entries.keep(entry, answer, refused)

    def value(self, names: list[tuple[str, ...]], member: Member, origin: Origin) -> list[Answer]:
        """The answers that one value gives, one for each tuple of candidate names.

        A model D(q) q̈ + C(q, q̇) q̇ + g(q) gives its D, C and g; what it says of the
        torques is kept until it is known whether they are given on their own.
        """
        assert isinstance(member.found, RightSide)
        is_torque = any(candidates[0] == "tau" for candidates in names)
        parts = model_parts(self.vocabulary, member.found.value) if is_torque else {}
        made = [
            self.answer((name,), replace(member, found=replace(member.found, value=part)), origin)
            for name, part in parts.items()
        ]
        for candidates in names:
            if REFERENCE in parts:  # D q̈_r + C q̇_r + g is none of the forces
                continue
            answer = self.answer(candidates, member, origin)
            (self._models if parts and candidates[0] == "tau" else made).append(answer)
        return made

    def answer(self, candidates: tuple[str, ...], member: Member, origin: Origin) -> Answer:
        """The record of one value, under the first of its names that has the shape of the value."""
        found, tokens, display = member.found, member.tokens, origin.display
        self.vocabulary.gives(candidates[0])
        if isinstance(found, ReadError):
            return self.unreadable(candidates, found, origin, member.index)
        start, end = tokens[0].start, _end(display.text, tokens)
        fits = fitted(self.vocabulary, candidates, found.value)
        if not fits:
            error = misfit(self.vocabulary, candidates, found.value, start, end)
            return self.unreadable(candidates, error, origin, member.index)
        name, node, note = fits[0]
        node = self._of_task(with_own_entries(self.vocabulary, name, node))
        may_refer = self.vocabulary.reached or self.vocabulary.defined
        of_task = (part.quantity for part in walk(node) if isinstance(part, Reference)) if may_refer else ()
        note = "" if display.plain and "row" in note else note
        notes = [one for one in found.notes if one != SYMMETRIC_NOTE or _is_symmetric(node)]
        return Answer(
            name=name,
            label=origin.label,
            node=node,
            place=display.locate(start, end - start),
            text=shown(display.text[start:end]),
            read_as=self.printer.text(node),
            notes=(*notes, note) if note else tuple(notes),
            alternatives=tuple(other for other, _, _ in fits[1:]),
            references=tuple(dict.fromkeys((*found.references, *of_task))),
            free=found.free,
            occurrence=(origin.equation, member.index),
        )

    def _of_task(self, node: Node) -> Node:
        """A value in which what is to be reached is the component of r that it stands for: x in J_r."""
        known, reached = self.vocabulary.quantities, self.vocabulary.reached

        def put(part: Node) -> Node:
            entry = reached.get(part.name, "") if isinstance(part, Symbol) and not part.dots else ""
            return Reference(entry) if entry in known else part

        return mapped(node, put) if reached else node

    def unread(self, candidates: tuple[str, ...], member: Member, origin: Origin) -> list[Answer]:
        """The records of a value that cannot be read: of a matrix those of its entries, where some can."""
        return self.by_entries(candidates, member, origin) or [self.answer(candidates, member, origin)]

    def by_entries(self, candidates: tuple[str, ...], member: Member, origin: Origin) -> list[Answer]:
        """The entries of a matrix that is written out, each as an answer; none where no entry can be read.

        The matrix is judged by them; one whose entries have no names, and C, of which only the rows of
        C q̇ are determined, is one answer of which a part is read.
        """
        whole, quantities = candidates[0], self.vocabulary.quantities
        rows = written_entries(member.tokens)
        named = {quantities.entry_of(part)[1]: part for part in quantities.parts(whole)}
        is_row = len(rows) == 1 and (0, 1) not in named
        written = {
            (j, i) if is_row else (i, j): tokens for i, row in enumerate(rows) for j, tokens in enumerate(row)
        }
        if whole == "C" or written.keys() != named.keys():
            return self._partly(candidates, rows, member, origin)
        read = [
            Member(member.index, tokens, read_right_side(self.vocabulary, tokens, (named[at],)))
            for at, tokens in written.items()
        ]
        if any(is_abstract(one.found) for one in read):
            return []
        answers, by_name = list[Answer](), list[str]()
        for part, one in zip((named[at] for at in written), read, strict=True):
            own = [name for name in (part, quantities.mirrored(part)) if is_name(one.found, name)]
            by_name += own
            answers += [] if own else [self.answer((part,), one, origin)]
        if not by_name and all(answer.node is None for answer in answers):
            return []
        return [
            replace(answer, whole=whole, references=answer.references or tuple(by_name)) for answer in answers
        ]

    def _partly(
        self, candidates: tuple[str, ...], rows: list[list[list[Token]]], member: Member, origin: Origin
    ) -> list[Answer]:
        """The one record of a matrix of which some entries can be read."""
        read = [[read_right_side(self.vocabulary, tokens) for tokens in row] for row in rows]
        found = [one for row in read for one in row]
        values = [one for one in found if isinstance(one, RightSide)]
        faults = {
            (i, j): one
            for i, row in enumerate(read)
            for j, one in enumerate(row)
            if isinstance(one, ReadError)
        }
        is_matrix = len({len(row) for row in rows}) == 1 and all(isinstance(v.value, Node) for v in values)
        if not values or not faults or not is_matrix:
            return []
        nodes = [[one.value if isinstance(one, RightSide) else ZERO for one in row] for row in read]
        size = len(rows), len(rows[0])
        candidates = tuple(sorted(candidates, key=lambda one: self.vocabulary.shape(one) != size))
        (i, j), fault = next(iter(faults.items()))
        where = f"entry {max(i, j) + 1}" if 1 in size else f"entry ({i + 1}, {j + 1})"
        return [
            replace(
                self.unreadable(candidates, fault, origin, member.index),
                fault=f"{where}: {fault.message}",
                partial=Matrix(tuple(tuple(n for n in row if isinstance(n, Node)) for row in nodes)),
                unread=tuple(faults),
                references=tuple(dict.fromkeys(name for value in values for name in value.references)),
                free=tuple(dict.fromkeys(name for value in values for name in value.free)),
            )
        ]

    def gives_all(self, names: Sequence[str]) -> bool:
        """Whether there is an answer to each of these."""
        return {answer.name for answer in self.answers}.issuperset(names)

    def motion(self, equation: MotionEquation, tokens: list[Token], origin: Origin) -> None:
        """Keep an equation of motion: of several that it may be, the first that is absent, in their order."""
        forces = equation.forces
        absent = [force for force in forces if force not in {answer.name for answer in self.answers}]
        name = (absent or forces)[0]
        answer = self.answer((name,), Member(0, tokens, equation.found), origin)
        others = tuple(force for force in forces if force != name)
        answer = replace(answer, alternatives=others, is_equation=equation.is_zero)
        if equation.is_zero and not self.vocabulary.passive:
            answer = replace(answer, notes=(*answer.notes, UNDRIVEN))
            self.in_case.setdefault(origin.equation, FREE)
        self.answers.append(answer)

    def motion_aside(
        self, equation: MotionEquation, tokens: list[Token], origin: Origin, refused: NotRecognized
    ) -> None:
        """Keep an equation of motion of a sentence: it counts where nothing else gives its force."""
        self._motions.append((equation, tokens, origin, refused))

    def acceleration(self, row: int, member: Member, origin: Origin) -> None:
        """Keep the acceleration of one coordinate until those of all are there; it has to be one formula."""
        answer = self.answer(("P",), member, origin)  # a scalar of any name
        if answer.node is None:
            self.answers.append(replace(answer, name=QDD_FORWARD.name))
        else:
            self._accelerations[row] = answer

    def unreadable(self, candidates: tuple[str, ...], error: ReadError, origin: Origin, index: int) -> Answer:
        """The record of a value that could not be read."""
        display = origin.display
        return Answer(
            name=candidates[0],
            label=origin.label,
            node=None,
            place=display.locate(error.offset, error.length),
            text=shown(display.text),
            fault=error.message,
            expected=error.help or EXPECTED,
            alternatives=candidates[1:],
            occurrence=(origin.equation, index),
        )

    def said_aside(self, refused: NotRecognized, answers: Sequence[Answer] = ()) -> None:
        """Keep what is said of an answer in passing: its `answers` count where nothing else gives that.

        They have to be asked for, or named by another: C = [[c_11, c_12], [c_21, 0]] with c_11 = ...
        """
        self._asides.append((refused, answers))

    def put_off(self, family: tuple[str, ...], answers: list[Answer], refused: NotRecognized) -> None:
        """Keep an equation until it is known which answers of its family are absent."""
        self._undecided.append((family, answers, refused, len(self.answers)))

    def settle(self) -> None:
        """Decide what needs the whole file: indices that do not exist, and a model without torques."""
        for own, answers, refused in self.own_scalars:
            if own in self.vocabulary.used:
                self.left_alone.append(replace(refused, answers=()))
            elif not answers:
                self.left_alone.append(refused)
            else:
                self.answers += answers
        given = {answer.name for answer in self.answers}
        shift = 0
        for family, answers, refused, position in self._undecided:
            absent = [name for name in family if name not in given]
            if len(absent) == 1 and answers:
                name = absent[0]
                note = f"taken for {name}, the only one of its kind that is absent"
                taken = [replace(a, name=name, notes=(*a.notes, note)) for a in answers]
                self.answers[position + shift : position + shift] = taken
                shift += len(taken)
                given.add(name)
            else:
                self.not_recognized.append(refused)
        forces = {q.force for q in self.vocabulary.coordinates}
        if self._models and "tau" not in given and not forces <= given:
            # the torques are put together from D, C and g: these come first, and do not follow from them
            after = 1 + max(answer.occurrence[0] for answer in self._models + self.answers)
            self.answers += [replace(m, occurrence=(after + i, 0)) for i, m in enumerate(self._models)]
        if len(self._accelerations) == len(self.vocabulary.coordinates):
            self.answers.append(column(QDD_FORWARD.name, self._accelerations, self.printer))
        else:
            why = "not the accelerations of all coordinates are given"
            given_ones = self._accelerations.values()
            self.not_recognized += [_refused(one, why, QDD_FORWARD.name) for one in given_ones]
        self.answers, lost = self._entries.settled(self.answers, self.printer)
        self.not_recognized += lost
        self._settle_asides()
        self.answers = [replace(a, doubt=self.in_case.get(a.occurrence[0], "")) for a in self.answers]
        self._settle_first_frame()
        for place, text in self.others_zero:
            self.answers += others(self.answers, self.vocabulary.quantities, place, text)
        self.answers, lost = readable(self.answers, self.vocabulary.quantities)
        self.not_recognized += lost

    def _is_beyond_energy(self, answer: Answer) -> bool:
        """Whether a value is no abbreviation: a step behind the energies that holds a mass, or friction."""
        stage = self.vocabulary.quantities[answer.name].family.stage
        holds_mass = answer.node is not None and not self.vocabulary.masses.isdisjoint(names_in(answer.node))
        is_behind = stage in (Stage.LAGRANGIAN, Stage.TORQUE, Stage.VECTORIZED)
        return is_behind and (holds_mass or answer.name == "friction")

    def _settle_first_frame(self) -> None:
        """A_1 where only H_1 is given, which is that too, or the other way round."""
        given = {answer.name for answer in self.answers}
        for name, other in (("A1", "H1"), ("H1", "A1")):
            if self.vocabulary.base_is_world and name in self.vocabulary.asked and name not in given:
                self.answers += [replace(one, name=name) for one in self.answers if one.name == other]

    def _settle_asides(self) -> None:
        """The asides that answer what is given nowhere so that it can be read, and those that do not."""
        self._settle_motions()
        self._settle_cases()
        if not self._asides:
            return
        named = {name for answer in (*self.answers, *self.general) for name in answer.references}
        said = [answer for _, answers in self._asides for answer in answers]
        within = self.vocabulary.quantities.within
        held = filter(self.holds_generally, (*self.answers, *said))
        general = {part for answer in held for part in within(answer.name)} - named
        for of_case in (False, True):
            given = self._given(with_parts=of_case) - (named if of_case else set())
            for refused, answers in self._asides:
                if is_of_case(refused.why) is not of_case:
                    continue
                is_general = not answers or any(map(self.holds_generally, answers))
                if not is_general and general.issuperset(refused.answers):
                    self.left_alone.append(refused)
                    continue
                can_be_read = all(answer.node is not None for answer in answers)
                wanted = named | self.vocabulary.asked if can_be_read else named
                if can_be_read and all(map(self._is_beyond_energy, answers)):
                    wanted |= {*refused.answers}
                if answers and given.isdisjoint(refused.answers) and not wanted.isdisjoint(refused.answers):
                    self.answers += answers
                    if of_case:
                        self.in_case.update((answer.occurrence[0], refused.why) for answer in answers)
                else:
                    (self.left_alone if given & set(refused.answers) else self.not_recognized).append(refused)

    def holds_generally(self, answer: Answer) -> bool:
        """Whether coordinates stand in a value; one without may be that of a single case."""
        names = names_in(answer.node) if answer.node is not None else frozenset()
        return not names.isdisjoint(q.name for q in self.vocabulary.coordinates)

    def _settle_motions(self) -> None:
        """The equations of motion in sentences, for what nothing else gives."""
        within = self.vocabulary.quantities.within
        given = {part for answer in self.answers for part in within(answer.name)}
        for equation, tokens, origin, refused in self._motions:
            if given.issuperset(equation.forces):
                self.left_alone.append(refused)
            elif equation.is_zero:
                self.not_recognized.append(refused)
            else:
                self.motion(equation, tokens, origin)
                given.add(self.answers[-1].name)

    def _settle_cases(self) -> None:
        """Set aside the displays of one case, where another answers the same, or the whole of an entry."""
        given = self._given(with_parts=True)
        for answer in [a for a in self.answers if a.occurrence[0] in self.in_case]:
            if answer.name in given:
                self.answers.remove(answer)
                self.left_alone.append(_refused(answer, self.in_case[answer.occurrence[0]], answer.name))

    def _given(self, with_parts: bool) -> set[str]:
        """What is answered so that it can be read, and not for one case alone."""
        read = [answer for answer in self.answers if answer.node is not None]
        given = {answer.name for answer in read if answer.occurrence[0] not in self.in_case}
        within = self.vocabulary.quantities.within
        return {part for name in given for part in within(name)} if with_parts else given


def _end(text: str, tokens: list[Token]) -> int:
    """Where a value ends: behind the braces around its last token, which are no tokens."""
    start, end = tokens[0].start, max(token.end for token in tokens)
    while text[end : end + 1] == "}" and text.count("{", start, end) > text.count("}", start, end):
        end += 1
    return end


def _is_symmetric(node: Node) -> bool:
    return isinstance(node, Matrix) and node.rows == tuple(zip(*node.rows, strict=False))
