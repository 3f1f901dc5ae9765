r"""V_1, V_2, or n_1(q, \dot q): the entries of the vector C q̇, where a report gives it row by row.

V_1 is a potential energy too, and h_1 may be anything: what they are is seen when all rows are
there, hold velocities, and an inertia matrix or gravity terms stand beside them, but no energies.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field, replace

from dynsolve.answers.reading.grammar.formula import FormulaReader
from dynsolve.answers.reading.grammar.references import skip_arguments
from dynsolve.answers.reading.tokens.lexer import Token
from dynsolve.answers.reading.vocabulary import Vocabulary
from dynsolve.answers.submission import Answer, NotRecognized
from dynsolve.errors import ReadError
from dynsolve.notation.tree import Matrix, Node, Symbol
from dynsolve.notation.unicode import UnicodePrinter
from dynsolve.notation.walk import walk

_ENTRY = re.compile(r"([VNnhcC])([1-9])")
_LETTERS = frozenset("VNnhcC")
_ONLY_WITH_ARGUMENTS = frozenset({"c", "C"})
_ENERGIES = re.compile(r"K.*|L|dL.*")


@dataclass(frozen=True, slots=True)
class Entry:
    """Which row of which vector a left side names; `is_sure` where its arguments say so."""

    letter: str
    row: int
    is_sure: bool


def entry_of(vocabulary: Vocabulary, member: list[Token]) -> Entry | None:
    """The entry of C q̇ that a left side may name, None for every other side."""
    if len(member) > 40 or member[0].text[:1] not in _LETTERS:
        return None
    reader = FormulaReader(member, vocabulary, naming=True)
    if not reader.begins_with_name():
        return None
    try:
        form = reader.form()
        bare = reader.token.kind == "end"
        skip_arguments(reader)
    except ReadError:
        return None
    found = _ENTRY.fullmatch(form.key)
    if found is None or form.scripts.any or form.dots or reader.token.kind != "end":
        return None
    row = int(found[2])
    if row > len(vocabulary.coordinates) or (bare and found[1] in _ONLY_WITH_ARGUMENTS):
        return None
    return Entry(found[1], row, not bare)


@dataclass(slots=True)
class VectorEntries:
    """The entries of C q̇ in one hand-in, by letter and row."""

    vocabulary: Vocabulary
    rows: dict[str, dict[int, Answer]] = field(default_factory=dict)
    refused: dict[str, list[NotRecognized]] = field(default_factory=dict)

    def keep(self, entry: Entry, answer: Answer, refused: NotRecognized) -> None:
        """Keep one entry until the whole file is known."""
        self.rows.setdefault(entry.letter, {})[entry.row] = answer
        if entry.is_sure:
            self.refused.setdefault(entry.letter, []).append(refused)

    def settled(
        self, answers: list[Answer], printer: UnicodePrinter
    ) -> tuple[list[Answer], list[NotRecognized]]:
        """The answers with the vector in the place of its entries, and what no vector was made of."""
        lost: list[NotRecognized] = []
        for letter, rows in self.rows.items():
            if self._is_vector(letter, rows, {answer.name for answer in answers}):
                own = {answer.occurrence for answer in rows.values()}
                kept = [answer for answer in answers if answer.occurrence not in own]
                answers = [*kept, column("Cqd", rows, printer)]
            else:
                lost += self.refused.get(letter, [])
        return answers, lost

    def _is_vector(self, letter: str, rows: dict[int, Answer], given: set[str]) -> bool:
        if len(rows) < len(self.vocabulary.coordinates) or "Cqd" in given:
            return False
        nodes = [answer.node for answer in rows.values()]
        if not all(node is not None for node in nodes):
            return False
        if letter in self.refused:
            return True
        beside = {"D", "g", "d11", "g1"} & given and not any(_ENERGIES.fullmatch(name) for name in given)
        return bool(beside) and any(_has_rate(node) for node in nodes if node is not None)


def _has_rate(node: Node) -> bool:
    return any(isinstance(part, Symbol) and part.dots == 1 for part in walk(node))


def column(name: str, rows: dict[int, Answer], printer: UnicodePrinter) -> Answer:
    """The column of the entries, as one answer of that name."""
    ordered = [rows[row] for row in sorted(rows)]
    node = Matrix(tuple((answer.node,) for answer in ordered if answer.node is not None))
    return replace(
        ordered[0],
        name=name,
        node=node,
        text="; ".join(answer.text for answer in ordered),
        read_as=printer.text(node),
        notes=tuple(dict.fromkeys(note for answer in ordered for note in answer.notes)),
        alternatives=(),
        references=tuple(dict.fromkeys(name for answer in ordered for name in answer.references)),
        free=tuple(dict.fromkeys(name for answer in ordered for name in answer.free)),
    )
