"""What an answer is worth beside its verdict: zeros are easy to write, and following is easy from nothing.

An answer, or an entry of it, is `zero` where the key is 0 for every q: such an entry earns with the
rest of its matrix, such an answer where more than zeros was written, or nothing else.  It is `empty`
where it follows and is 0, or has lost most of its terms, or follows from what has: it earns nothing
by itself.  Its `loss` says what is lost, and lets it wait for a human; its `parts` are the answers
that a whole which is not written is judged by.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.answers.judging.entry_comparison import substituted
from dynsolve.answers.judging.hand_in import ComparedHandIn
from dynsolve.answers.judging.key_comparison import KeyComparison
from dynsolve.answers.verdict import EntryVerdict, JudgedAnswer, Verdict
from dynsolve.problem.model import Problem
from dynsolve.quantities.index import Quantities

ONLY_ZEROS = "nothing but zeros was written"


def weighed(
    problem: Problem, hand_in: ComparedHandIn, answers: tuple[JudgedAnswer, ...]
) -> tuple[JudgedAnswer, ...]:
    """The answers with what they are worth beside their verdicts."""
    found, quantities = _Substance(problem, hand_in), hand_in.graph.quantities
    own = {answer.name: found(answer) for answer in answers}
    emptied = _emptied(own)
    own = {name: _of_sources(answer, emptied) for name, answer in own.items()}
    own |= {name: _of_whole(quantities, answer, own) for name, answer in own.items() if not answer.given}
    own |= {
        name: replace(answer, parts=parts)
        for name, answer in own.items()
        if not answer.given and (parts := _parts(quantities, name, own))
    }
    if found.has_more_than_zeros or not any(a.given and not a.zero for a in own.values()):
        return tuple(own.values())
    return tuple(
        replace(a, empty=True, loss=a.loss or ONLY_ZEROS)
        if a.zero and a.verdict is not Verdict.MISSING
        else a
        for a in own.values()
    )


class _Substance:
    """What can be told of an answer by itself, compared with the key."""

    def __init__(self, problem: Problem, hand_in: ComparedHandIn) -> None:
        self.problem = problem
        self.hand_in = hand_in
        self.has_more_than_zeros = False

    def __call__(self, answer: JudgedAnswer) -> JudgedAnswer:
        key = self._key(answer.name)
        if key is None:
            return answer
        rows = key.rows if isinstance(key, Matrix) else ((key,),)
        zero = all(entry.is_zero for row in rows for entry in row)
        compared = self.hand_in.comparisons.get(answer.name)
        if compared is None or not compared.rows or not answer.given:
            return replace(answer, zero=zero)
        if not all(entry.value.is_zero for row in compared.rows for entry in row):
            self.has_more_than_zeros = True
        entries = tuple(_weighed_entry(entry, rows, compared) for entry in answer.entries)
        following = answer.verdict is Verdict.FOLLOWS or any(
            entry.verdict is Verdict.FOLLOWS for entry in answer.entries
        )
        loss, empty = (
            self._loss(compared, key) if following or answer.verdict is Verdict.WRONG else ("", False)
        )
        return replace(
            answer, zero=zero, entries=entries, loss=loss if following else answer.loss, empty=empty
        )

    def _key(self, name: str) -> Any:
        """The key's value of an answer, None where there is none; of an entry of C that of its row of C q̇."""
        whole, entry = self.hand_in.graph.quantities.entry_of(name)
        if whole == "C" and entry:
            return self.hand_in.graph.key("Cqd")[entry[0], 0]
        target = self.hand_in.compare.target(name)
        if target.node not in self.hand_in.answer_ring.rules:
            return None
        key = target.of(self.hand_in.graph.key(target.node))
        return key if isinstance(key, Matrix | Expr) else None

    def _loss(self, compared: KeyComparison, key: Any) -> tuple[str, bool]:
        """What an answer has lost, compared with the key, and whether nearly all of it."""
        values = [entry.value for row in compared.rows for entry in row]
        expected = self._with_numbers(list(key.entries) if isinstance(key, Matrix) else [key])
        numerators = self._with_numbers([value.numerator for value in values])
        kept, wanted = sum(map(len, numerators)), sum(map(len, expected))
        empty = 2 * kept < wanted
        written = [*numerators, *(value.denominator for value in values)]
        before, after = _names(expected), _names(written)
        for body in self.problem.robot.bodies:
            mass = _names([body.mass])
            own = mass | (_names(list(body.inertia.entries)) if body.inertia is not None else set())
            if mass & before and not own & after:
                return f"body {body.name} is lost on the way", empty
        for coordinate in self.problem.robot.coordinates:
            if coordinate.name in before and coordinate.name not in after:
                return f"{coordinate.name} is lost on the way", empty
        return (f"it keeps {kept} of {wanted} terms" if empty else ""), empty

    def _with_numbers(self, values: list[Expr]) -> list[Expr]:
        """Values with the problem's numbers for symbols: an answer may have either."""
        numbers = self.problem.values
        if not numbers:
            return values
        ring = self.hand_in.answer_ring.ring
        put = {ring.symbol_indices[n, 0]: v for n, v in numbers.items() if ring.has_symbol(n)}
        return [substituted(value, put) for value in values]


def _weighed_entry(
    entry: EntryVerdict, rows: tuple[tuple[Any, ...], ...], compared: KeyComparison
) -> EntryVerdict:
    """An entry with whether the key is 0 there, and whether it is 0 where the key is not."""
    i, j = entry.index[0] - 1, entry.index[1] - 1 if len(entry.index) > 1 else 0
    zero = rows[i][j].is_zero
    return replace(entry, zero=zero, empty=not zero and compared.rows[i][j].value.is_zero)


def _emptied(answers: Mapping[str, JudgedAnswer]) -> set[str]:
    """The answers that are empty, or follow from such."""
    empty = {name for name, answer in answers.items() if answer.given and answer.empty}
    while True:
        more = {
            name
            for name, answer in answers.items()
            if name not in empty and answer.verdict is Verdict.FOLLOWS and empty & {*answer.follows_from}
        }
        if not more:
            return empty
        empty |= more


def _of_sources(answer: JudgedAnswer, emptied: set[str]) -> JudgedAnswer:
    """An answer with what it loses by what it follows from."""
    entries = tuple(
        replace(entry, empty=entry.empty or bool(emptied & {*entry.follows_from})) for entry in answer.entries
    )
    if answer.verdict is not Verdict.FOLLOWS:
        return replace(answer, entries=entries)
    sources = [name for name in answer.follows_from if name in emptied]
    loss = answer.loss or (
        f"{', '.join(sources)} {'is' if len(sources) == 1 else 'are'} empty" if sources else ""
    )
    return replace(answer, entries=entries, loss=loss, empty=answer.name in emptied)


def _of_whole(
    quantities: Quantities, answer: JudgedAnswer, answers: Mapping[str, JudgedAnswer]
) -> JudgedAnswer:
    """What is not written has lost what the matrix has that it is an entry of, or its parts."""
    for name in (quantities.entry_of(answer.name)[0], *quantities.parts(answer.name)):
        source = answers.get(name)
        if source is not None and source.given and source.loss:
            return replace(answer, loss=source.loss, empty=source.empty)
    return answer


def _parts(
    quantities: Quantities, name: str, answers: Mapping[str, JudgedAnswer]
) -> tuple[JudgedAnswer, ...]:
    """The parts of a whole that is not written; of a matrix also where some of them are missing."""
    given = {n: a for n, a in answers.items() if a.given}
    names = quantities.parts(name)
    pieces = [given.get(name) or given.get(quantities.mirrored(name)) for name in names]
    written = [piece for piece in pieces if piece is not None]
    of_matrix = all(quantities[name].entry for name in names)
    if not written or not (of_matrix or len(written) == len(pieces)):
        return ()
    missing = (JudgedAnswer(name, Verdict.MISSING) for name in names)
    return tuple(piece or absent for piece, absent in zip(pieces, missing, strict=True))


def _names(values: list[Expr]) -> set[str]:
    return {name for value in values for name in _names_of(value)}


def _names_of(value: Any) -> Iterator[str]:
    """The symbols, and the coordinates of the angles, that a value holds."""
    ring = value.ring
    degrees = value.poly.degrees() if value.poly else ()
    for generator, degree in zip(ring.generators, degrees, strict=False):
        if degree and generator.kind == "symbol":
            yield generator.name
        elif degree and generator.kind in ("sin", "cos"):
            for atom, _ in generator.angle.terms:
                yield from (name for name, _ in atom)
