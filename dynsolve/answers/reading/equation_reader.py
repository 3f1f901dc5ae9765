r"""The equations of one file, read in order: what each is an answer to, and what it defines.

Of a chain a = b = c the names are found first (`left_side`); then every other member is
read as a value (`left_side`) and is one answer to each of the names (`answer_list`).  A
member of names alone, like K = K_1 + K_2, is a definition and no answer.  A chain whose left
side is a name of the student's own defines that name for what follows.

What the state is called does not matter: the matrix that begins each term is taken.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from msgspec.structs import replace

from dynsolve.answers.reading.answer_list import AnswerList, Member, Origin
from dynsolve.answers.reading.by_content import (
    acceleration_of,
    block,
    called_force,
    called_friction,
    calls_forces,
    force_meant,
    is_condition,
    is_inertia_force,
    meant,
    motion_equation,
    signed_terms,
    states_constant,
)
from dynsolve.answers.reading.displays import Display, Equation, equations, is_label
from dynsolve.answers.reading.grammar.names import SEVERAL
from dynsolve.answers.reading.grammar.references import OWN_LETTERS
from dynsolve.answers.reading.grids import MAX_ANSWERS, MAX_DEFINITIONS, MAX_MEMBERS, Abstract, Grid
from dynsolve.answers.reading.left_side import (
    LeftSide,
    NamedAnswers,
    RightSide,
    UnknownSide,
    called_name,
    is_abstract,
    is_read,
    is_value,
    name_alone,
    read_left_side,
    read_left_sides,
    read_right_side,
    side_of,
    spoken_of,
    why_no_value,
    without_factor,
)
from dynsolve.answers.reading.lexer import Macro, Token
from dynsolve.answers.reading.matrix_parts import (
    entry_of,
    fitted,
    is_gravity_vector,
    model_parts,
    part_of,
    shown,
)
from dynsolve.answers.reading.name_splitting import gives_new_meaning, gives_own_angle, keep_symbol
from dynsolve.answers.reading.plain import plain_member
from dynsolve.answers.reading.prepare import prepared
from dynsolve.answers.reading.report_text import CONDITION, CONSTANT
from dynsolve.answers.reading.vocabulary import Meaning, Vocabulary, defined_order, order_of_pair
from dynsolve.answers.verdict import Answer, NotRecognized
from dynsolve.errors import ReadError
from dynsolve.notation.tree import Function, Node, Reference, names_in
from dynsolve.notation.unicode import UnicodePrinter
from dynsolve.quantities.letters import key
from dynsolve.questions.forward_dynamics import QDD_FORWARD

# Linear models as they are written out: `\dot x = [...] x + [...] u` gives A and B

_NAMES = ("linear_A", "linear_B")


def linear_parts(vocabulary: Vocabulary, members: Sequence[list[Token]]) -> Iterator[tuple[str, Member]]:
    """A and B with their names, of the chain ẋ = A x + B u; nothing of every other chain."""
    if len(members) != 2 or _NAMES[0] not in vocabulary.quantities or block(members[0]) == members[0]:
        return
    terms = signed_terms(members[1])
    blocks = [block(tokens) for tokens, _ in terms]
    if len(terms) > 2 or any(negative for _, negative in terms):
        return
    if any(not block or len(block) == len(tokens) for block, (tokens, _) in zip(blocks, terms, strict=True)):
        return
    made = [Member(1, block, read_right_side(vocabulary, block)) for block in blocks]
    n = 2 * len(vocabulary.coordinates)
    values = [member.found.value for member in made if isinstance(member.found, RightSide)]
    shapes = [value.shape for value in values if isinstance(value, Grid)]
    if shapes[:1] == [(n, n)] and len(shapes) == len(made) and all(rows == n for rows, _ in shapes):
        yield from zip(_NAMES, made, strict=False)


_CONTROL = re.compile(
    r"unknown symbol `(?:[Kk]_?\{?[pPdDiI]\}?|[^`]*tilde\}?"
    r"|(?:q|theta|phi|x)_?\{?[0-9,]*(?:d|des|desired|ref|soll)[0-9,]*\}?)`"
)
"""What a controller's gains, errors and desired motion are told as: what holds them is no answer."""

_OF_SEVERAL_KINDS = frozenset({"det", "friction"})
"""Answers whose equations may say something else."""

_DEFINITION = "it defines an abbreviation"
_MORE_THAN_NAME = "its left side is more than a name"
_TOO_MANY_ANSWERS = f"more than {MAX_ANSWERS} values stand before it"


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
        self._orders = dict(vocabulary.orders)

    def define(self, name: str, value: RightSide, has_arguments: bool = False) -> None:
        """Keep a name for what follows; `has_arguments` says that it is written `a(q)`."""
        if len(self.vocabulary.defined) >= MAX_DEFINITIONS or name in self.vocabulary.symbols:
            return
        is_number = isinstance(value.value, Node) and not names_in(value.value)
        if is_number and self.vocabulary.similar(name):  # L_1 = 0.5 gives l_1 a value
            return
        meaning = Meaning(value.value, has_arguments=has_arguments)
        self.vocabulary.broken.pop(name, None)
        self.vocabulary.define(name, meaning)
        self._first.setdefault(name, meaning)

    def begins_anew(self) -> bool:
        """Forget all but what was used before it was defined (`C = h ..., where h = ...`).

        False where there is nothing of that kind that was not known already.  The report is
        then to be read once more; a definition holds for what stands before the first one too.
        """
        entries = self.vocabulary.own_entries
        late = {name: self._first[name] for name in self._first if name in self.vocabulary.missed}
        is_known = late.keys() <= self._ahead.keys() and entries.isdisjoint(self.vocabulary.missed_entries)
        orders = self.vocabulary.orders
        if is_known and orders == self._orders:
            return False
        self._ahead |= late
        self._orders = orders
        self.vocabulary = self.vocabulary.fresh()
        self.vocabulary.orders |= orders
        self.vocabulary.own_entries = entries
        self.vocabulary.defined |= self._ahead
        self.found = AnswerList(self.vocabulary, self.found.printer)
        self.macros, self._first, self.equations = {}, {}, 0
        return True

    # Equations of a report

    def read_display(self, display: Display) -> None:
        """Read the equations of one display; each becomes an answer, a definition, or is listed."""
        if not display.text.strip() or self._reads_plain(display):
            return
        try:
            tokens = prepared(display.text, self.macros)
            found = equations(tokens)
        except ReadError as error:
            self._display_without_tokens(display, error)
            return
        origin = Origin(display, display.label, self.equations)
        if not found and not is_label(tokens):
            why = "no name stands here for what this is" if "=" not in display.text else "no equation"
            origin = replace(origin, names=spoken_of(self.vocabulary, tokens, None))
            self.found.not_recognized.append(origin.not_recognized(0, len(display.text), why))
        for equation in found:
            if len(self.found.answers) < MAX_ANSWERS:
                self._read_equation(equation, self.origin(display, equation.label or display.label))
            else:
                self.found.not_recognized.append(origin.of(equation.members, _TOO_MANY_ANSWERS))

    def _reads_plain(self, display: Display) -> bool:
        """Read `D = ...`, a name and a formula that can be nothing else; whether it is one."""
        head, sign, _ = display.text.partition("=")
        if not sign or self.macros or len(self.found.answers) >= MAX_ANSWERS:
            return False
        candidates = self._plainly_named(head)
        member = candidates and plain_member(self.vocabulary, display.text, len(head) + 1, 1, candidates)
        if not member or not isinstance(member.found, RightSide) or isinstance(member.found.value, Function):
            return False
        value, forces = member.found.value, [q.force for q in self.vocabulary.coordinates]
        is_gravity = candidates == ("g",) and is_gravity_vector(value, len(forces))
        if is_gravity or (isinstance(value, Node) and candidates[0] in forces):
            return False
        self.found.answers += self.found.value([candidates], member, self.origin(display, display.label))
        self.vocabulary.calls(key(head.partition("(")[0].strip()))
        return True

    def _plainly_named(self, head: str) -> tuple[str, ...]:
        """The answers that a left side names by the very name of one, which is nothing else as well."""
        vocabulary = self.vocabulary

        def read() -> tuple[str, ...]:
            side = side_of(vocabulary, head)
            if not isinstance(side, NamedAnswers):
                return ()
            tokens, first = prepared(head)[:-1], side.candidates[0]
            is_named = name_alone(vocabulary, tokens) in side.candidates and not part_of(vocabulary, tokens)
            is_other = first in _OF_SEVERAL_KINDS or entry_of(vocabulary, tokens) is not None
            may_move = first == "tau" and (vocabulary.passive or _NAMES[0] in vocabulary.quantities)
            is_missed = vocabulary.missed or vocabulary.missed_entries
            return side.candidates if is_named and not (is_other or may_move or is_missed) else ()

        return vocabulary.once(("plain", head), read) if vocabulary.is_untouched else ()

    def origin(self, display: Display, label: str) -> Origin:
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
            origin = self.origin(display, display.label)
            self.found.answers.append(self.found.unreadable(name.candidates, error, origin, 1))
        else:
            place = display.locate(error.offset, error.length)
            names = name.candidates if isinstance(name, NamedAnswers) else ()
            refused = NotRecognized(shown(display.text), display.label, place, error.message, names)
            self.found.not_recognized.append(refused)

    def _read_equation(self, equation: Equation, origin: Origin) -> None:
        """Read one chain a = b = c."""
        members = without_factor(self.vocabulary, equation.members)
        if len(members) > MAX_MEMBERS:
            self.found.not_recognized.append(origin.of(members, f"more than {MAX_MEMBERS} members"))
            return
        if (order := defined_order(members)) is not None:
            self.vocabulary.count(dict([order]))
            self.found.left_alone.append(origin.of(members, "it says what the indices mean"))
            return
        self.vocabulary.count(order_of_pair(members))
        if part := part_of(self.vocabulary, members[0]):
            self.read_part(members, replace(origin, names=part))
            return
        sides = read_left_sides(self.vocabulary, members)
        called = {
            side.candidates: member
            for side, member in zip(sides, members, strict=True)
            if isinstance(side, NamedAnswers)
        }
        names = list(called)
        owners = tuple(name for candidates in names for name in candidates)
        origin = replace(origin, names=owners or spoken_of(self.vocabulary, members[0], sides[0]))
        if self._of_motion(members, names, origin):
            return
        if calls_forces(self.vocabulary, members, sides[0]):
            self.found.left_alone.append(origin.of(members, "it says what drives the joints"))
            return
        read = [
            Member(index, tokens, self._read(tokens, owners, sides[0]))
            for index, tokens in enumerate(members)
            if is_read(sides[index], bool(names))
        ]
        read = self._defined_by_the_end(read)
        if self.defines_shorthand(members[0], _values(read)):
            self.found.left_alone.append(origin.of(members, _DEFINITION))
            return
        names = self._by_value(called, _values(read))
        if names:
            origin = replace(origin, names=tuple(name for candidates in names for name in candidates))
        if self._entry_of_vector(members[0], read, origin):
            return
        if not names:
            self._without_name(sides[0], members, read, origin)
        elif own := self._own_letter(members, sides, names, read):
            self.define(own, _values(read)[0])
            self.found.own_scalars.append((own, [], origin.of(members, _DEFINITION)))
        elif self._defines_scalar(members, sides[0], read, origin):
            return
        elif read and states_constant(self.vocabulary, members, names, _values(read)):
            self.found.not_recognized.append(origin.of(members, CONSTANT))
        else:
            self._with_names(names, members, read, origin)

    def _by_value(
        self, called: dict[tuple[str, ...], list[Token]], found: list[RightSide]
    ) -> list[tuple[str, ...]]:
        """What the sides of a chain name, by its value; of the friction and an entry of it, the entry."""
        values = [one.value for one in found]
        names = list[tuple[str, ...]]()
        entries = list[tuple[str, ...]]()
        for candidates, member in called.items():
            name = name_alone(self.vocabulary, member)
            if entry := called_friction(self.vocabulary, name, candidates, values):
                self.define(name, replace(found[-1], value=Reference(entry[0])))
                entries.append(entry)
            names.append(entry or called_force(self.vocabulary, name, candidates, values) or candidates)
        return [one for one in names if one != ("friction",)] if entries else names

    def _read(self, tokens: list[Token], owners: tuple[str, ...], first: LeftSide) -> RightSide | ReadError:
        """The value of a member; what u is may be a potential energy, which knows the zero of its height."""
        found = read_right_side(self.vocabulary, tokens, owners)
        if isinstance(found, ReadError) and isinstance(first, UnknownSide) and first.key == "u":
            potential = read_right_side(self.vocabulary, tokens, ("P",))
            return potential if is_value(potential) else found
        return found

    def _of_motion(self, members: list[list[Token]], names: list[tuple[str, ...]], origin: Origin) -> bool:
        """Keep an equation of motion, an acceleration, or a linear model; whether the chain is one."""
        if any(candidates[0] not in ("tau", "friction") for candidates in names):
            return False
        solved = acceleration_of(self.vocabulary, members)
        if solved is not None and QDD_FORWARD.name in self.vocabulary.quantities:
            value = read_right_side(self.vocabulary, members[-1], (QDD_FORWARD.name,))
            self.found.acceleration(solved.index, Member(len(members) - 1, members[-1], value), origin)
            return True
        name = "" if names else name_alone(self.vocabulary, members[0])
        if name and len(members) == 3 and [token.text for token in members[-1]] == ["0"]:  # eq1 = ... = 0
            members = members[1:]
        found = motion_equation(self.vocabulary, members)
        if found is not None and solved is not None and self.found.gives_all(found.forces):
            self.found.left_alone.append(origin.of(members, "it is solved for an acceleration"))
        elif found is not None:
            self.found.motion(found, [token for member in members for token in member], origin)
        linear = [] if found else list(linear_parts(self.vocabulary, members))
        self.found.answers += [self.found.answer((name,), member, origin) for name, member in linear]
        return found is not None or bool(linear)

    def read_part(self, members: list[list[Token]], origin: Origin) -> None:
        """The entries of a row, a column or a vector of derivatives, each as an answer of its own."""
        found = read_right_side(self.vocabulary, members[-1])
        if isinstance(found, ReadError):
            self.found.not_recognized.append(origin.of(members, found.message))
            return
        if found.is_definition:
            self.found.left_alone.append(origin.of(members, why_no_value(found)))
            return
        value = found.value
        if not isinstance(value, Grid) or sorted(value.shape) != [1, len(origin.names)]:
            self.found.not_recognized.append(origin.of(members, f"{len(origin.names)} entries are expected"))
            return
        for name, node in zip(origin.names, value.entries, strict=True):
            entry = Member(len(members) - 1, members[-1], replace(found, value=node))
            self.found.answers.append(self.found.answer((name,), entry, origin))

    def _entry_of_vector(self, first: list[Token], read: list[Member], origin: Origin) -> bool:
        """Keep what may be one row of C q̇; whether its arguments say that it is nothing else."""
        values = [member for member in read if is_value(member.found)]
        entry = entry_of(self.vocabulary, first) if values else None
        if entry is None:
            return False
        end = max(token.end for token in values[-1].tokens)
        refused = origin.not_recognized(first[0].start, end, "not all rows of this vector are given")
        self.found.entry(entry, values[-1], origin, refused)
        return entry.is_sure and entry.letter != "V"

    def define_scalar(self, first: list[Token], side: NamedAnswers, value: RightSide) -> str:
        """Keep a letter that names a matrix or a vector in books and stands for a scalar here: v_2, J(d_3).

        Gives what it is kept under; nothing where the value may be that of the answer.
        """
        own = called_name(self.vocabulary, first)
        is_scalar = isinstance(value.value, Node) and not self.any_fits(side.candidates, [value])
        if not own or not is_scalar or own in self.vocabulary.symbols:
            return ""
        self.define(own, value, has_arguments=True)
        return own

    def _defines_scalar(
        self, members: list[list[Token]], side: LeftSide, read: list[Member], origin: Origin
    ) -> bool:
        """Keep a scalar under a letter that names a matrix: a definition, where something else uses it."""
        values = _values(read)
        if not isinstance(side, NamedAnswers) or len(members) != 2 or not values:
            return False
        own = self.define_scalar(members[0], side, values[-1])
        if own:
            answers = [self.found.answer(side.candidates, member, origin) for member in read]
            self.found.own_scalars.append((own, answers, origin.of(members, _DEFINITION)))
        return bool(own)

    def defines_in_passing(self, first: list[Token], found: RightSide) -> bool:
        """Keep another meaning of what would be read as a coordinate; whether there was one."""
        name = name_alone(self.vocabulary, first)
        if gives_new_meaning(self.vocabulary, name, found.value):
            keep_symbol(self.vocabulary, name, 0, found.value, in_passing=True)
        elif gives_own_angle(self.vocabulary, name, found.value):
            self.define(name, found)
        else:
            return False
        return True

    def defines_shorthand(self, first: list[Token], values: list[RightSide]) -> bool:
        r"""Keep `c_{21} = \cos(\theta_2 - \theta_1)` or `\theta_{12} = \theta_1 - \theta_2`, if so."""
        name = name_alone(self.vocabulary, first)
        node = values[-1].value if values and name not in self.vocabulary.symbols else None
        function = {"s": "sin", "c": "cos"}.get(name[:1].lower())
        is_function = isinstance(node, Function) and node.name == function
        is_angle = isinstance(node, Node) and SEVERAL.fullmatch(name) is not None
        if is_function or is_angle:
            self.define(name, values[-1])
        return is_function or is_angle

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

    def _own_letter(
        self,
        members: list[list[Token]],
        sides: list[LeftSide],
        names: list[tuple[str, ...]],
        read: list[Member],
    ) -> str:
        """The letter that `h = ...` or `... =: h` defines, its value having no shape of what books call h."""
        named = [m for m, side in zip(members, sides, strict=True) if isinstance(side, NamedAnswers)]
        if len(names) > 1 or len(named) > 1 or len(named[0]) > 1:
            return ""
        own = key(named[0][0].text)
        values = _values(read)
        if not values or self.any_fits(names[0], values):
            return ""
        nodes = [found.value for found in values if isinstance(found.value, Node)]
        is_of_target = not names_in(*nodes).isdisjoint(
            self.vocabulary.reached
        )  # D = (x² + y² - l₁² - l₂²)/(2 l₁ l₂)
        return own if is_of_target or not self.vocabulary.is_answer(own) else ""

    def any_fits(self, candidates: tuple[str, ...], values: list[RightSide]) -> bool:
        """Whether one of the values has the shape of one of the answers."""
        return any(fitted(self.vocabulary, candidates, found.value) for found in values)

    def _with_names(
        self, names: list[tuple[str, ...]], members: list[list[Token]], read: list[Member], origin: Origin
    ) -> None:
        """Every value is an answer to each name; what cannot be read is one where no value follows it."""
        values = [member.index for member in read if is_value(member.found)]
        said = refused = condition = ""
        given = list[Answer]()
        for number, member in enumerate(read):
            found, before = member.found, read[:number]
            if is_inertia_force(self.vocabulary, names, member.tokens):
                self.found.left_alone.append(origin.of(members, "it is a vector of the recursions"))
                return
            if is_condition(self.vocabulary, names, found, _values(before)):
                condition = CONDITION
            elif is_value(found):
                given += self.found.value(names, member, origin)
            elif not isinstance(found, ReadError):
                said = said or why_no_value(found)
                for candidates in names if is_abstract(found) else ():
                    given += self.found.by_entries(candidates, member, origin)
            elif _CONTROL.match(found.message) or origin.display.among_prose:
                refused = refused or found.message
            elif not values or member.index > values[-1]:
                given += [a for candidates in names for a in self.found.unread(candidates, member, origin)]
        self.found.answers += given
        if any(answer.node is not None for answer in given):
            first, *behind = members[0]
            self.vocabulary.calls("" if behind and behind[0].kind != "(" else first.text)
        if refused and not given:
            self.found.not_recognized.append(origin.of(members, refused))
        elif condition and not given:
            self.found.said_aside(origin.of(members, condition))
        elif not given and not values:
            self._left_alone(names, members, read, origin, said)

    def _left_alone(
        self,
        names: list[tuple[str, ...]],
        members: list[list[Token]],
        read: list[Member],
        origin: Origin,
        said: str,
    ) -> None:
        """Keep a formula that gives its names no value; it is listed where the reason is a letter."""
        refused = origin.of(members, said or "it says that two names are the same")
        letters = any(isinstance(m.found, RightSide) and m.found.has_letters for m in read)
        if letters:
            self.found.said_aside(refused)
        elif all(isinstance(member.found, RightSide) for member in read):
            needs = (n for m in read if isinstance(m.found, RightSide) for n in m.found.references)
            self.found.left_alone.append(replace(refused, needs=tuple(dict.fromkeys(needs))))
            self.found.general += [
                self.found.answer(candidates, member, origin)
                for candidates in names
                for member in read
                if isinstance(member.found, RightSide) and not isinstance(member.found.value, Abstract)
            ]

    def _without_name(
        self, first: LeftSide, members: list[list[Token]], read: list[Member], origin: Origin
    ) -> None:
        """A chain that names no answer: a definition, a model, or what is not recognized."""
        if isinstance(first, UnknownSide):
            self._unknown_side(first, members, read, origin)
            return
        for member in read:
            found = member.found
            if isinstance(found, RightSide) and is_value(found) and model_parts(self.vocabulary, found.value):
                self.found.answers += self.found.value([("tau",)], member, origin)
                return
        for member in read[1:]:
            if isinstance(member.found, RightSide) and self.defines_in_passing(members[0], member.found):
                self.found.left_alone.append(origin.of(members, _DEFINITION))
                return
        leading = read[0].found if read and read[0].index == 0 else None
        if isinstance(leading, RightSide) and leading.is_definition:
            if len(leading.references) == 1 and not origin.names:
                origin = replace(origin, names=tuple(leading.references))
            is_multiple = origin.names and _values(read) and not is_abstract(leading)
            why = _MORE_THAN_NAME if is_multiple else why_no_value(leading)
            self.found.left_alone.append(origin.of(members, why))
        else:
            unnamed = "no side of it is the name of an answer"
            why = leading.message if isinstance(leading, ReadError) else unnamed
            self._refused(members, read, origin, why)

    def _unknown_side(
        self, side: UnknownSide, members: list[list[Token]], read: list[Member], origin: Origin
    ) -> None:
        """A left side that means nothing: an index that does not exist, or a name of the student's own."""
        values = [
            member
            for member in read
            if isinstance(member.found, RightSide) and not isinstance(member.found.value, Abstract)
        ]
        faults = [member.found for member in read if isinstance(member.found, ReadError)]
        last = values[-1].found if values else None
        names = meant(self.vocabulary, side.key, last.value) if isinstance(last, RightSide) else ()
        if isinstance(last, RightSide) and names:
            self.define(side.key, last, side.has_arguments)
            self.found.answers += self.found.value([names], values[-1], origin)
        elif isinstance(last, RightSide) and (forces := force_meant(self.vocabulary, side.key, last.value)):
            self.define(side.key, last, side.has_arguments)
            made = [self.found.answer(forces, values[-1], origin)]
            why = _DEFINITION if len(forces) == 1 else f"it may be any of {', '.join(forces)}"
            refused = replace(origin, names=forces).of(members, why)
            self.found.put_off(forces, made, refused)
        elif side.family:
            note = side.message.replace("unknown symbol ", "")
            made = [self.found.answer(side.family[:1], member, origin) for member in values[-1:]]
            made = [replace(answer, notes=(*answer.notes, note)) for answer in made]
            self.found.put_off(side.family, made, origin.of(members, side.message))
        elif side.is_name_alone and isinstance(last, RightSide):
            self.define(side.key, last, side.has_arguments)
            self.found.left_alone.append(origin.of(members, _DEFINITION))
        elif side.is_name_alone and read and all(is_abstract(member.found) for member in read):
            self.found.left_alone.append(origin.of(members, "it holds names of the derivation alone"))
        else:
            if side.is_name_alone and faults:
                self.vocabulary.cannot_be_read(side.key, faults[-1].message)
            why = faults[-1].message if faults else side.message or "it names nothing known"
            self._refused(members, read, origin, why)

    def _refused(self, members: list[list[Token]], read: list[Member], origin: Origin, why: str) -> None:
        """List what names nothing known; a sentence of a report without formulas is left alone."""
        head = origin.display.text.partition("=")[0].strip()
        is_sentence = origin.display.plain and not _values(read) and " " in head
        if is_sentence:
            self.found.left_alone.append(origin.of(members, "it is a sentence"))
        else:
            self.found.not_recognized.append(origin.of(members, why))


def _values(read: list[Member]) -> list[RightSide]:
    found = [member.found for member in read]
    return [value for value in found if isinstance(value, RightSide) and not value.is_definition]
