"""Verdicts -> marks, each with the one line that explains it.

A matrix earns by its entries that carry something in the key; the others are zeros that anybody
can write, and count with the rest.  With r of N entries right, and z of the Z zeros, the share is
r/N · (N + z)/(N + Z): one slip takes its part, wherever it is made, and zeros alone earn nothing.

What an answer is worth beside its verdict: zeros are easy to write, and following is easy from nothing.

An answer, or an entry of it, is `zero` where the key is 0 for every q: such an entry earns with the
rest of its matrix, such an answer where more than zeros was written, or nothing else.  It is `empty`
where it follows and is 0, or has lost most of its terms, or follows from what has: it earns nothing
by itself.  Its `loss` says what is lost, and lets it wait for a human; its `parts` are the answers
that a whole which is not written is judged by.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from fractions import Fraction
from functools import lru_cache
from typing import Any, Protocol

from msgspec import Struct, field
from msgspec.structs import replace

from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr
from dynsolve.answers.judging.entry_comparison import placed, substituted
from dynsolve.answers.judging.hand_in import ComparedHandIn
from dynsolve.answers.judging.key_comparison import KeyComparison
from dynsolve.answers.verdict import EntryVerdict, JudgedAnswer, Verdict
from dynsolve.problem.model import Problem
from dynsolve.quantities.family import FORMED
from dynsolve.quantities.index import Quantities

# How verdicts become marks: the shares, the caps and the rounding that a course decides on


class Policy(Struct, frozen=True):
    """`follow` is the share that what follows earns, `late` the share that a late hand-in keeps.

    `later` are the shares of the second day and those after it, where a course takes off by the
    day; the last holds for ever.
    `caps` are the most marks that the answers of a stage earn together, `rounding` is the
    step that the marks of an answer are rounded to (halves up), `hints` how much a student
    is told: 1 where, 2 what kind of slip, 3 how.
    """

    follow: Fraction = Fraction(1)
    caps: Mapping[str, Fraction] = field(default_factory=dict)
    rounding: Fraction = Fraction(1, 100)
    late: Fraction = Fraction(1)
    hints: int = 3
    later: tuple[Fraction, ...] = ()

    def kept(self, days: int) -> Fraction:
        """The share that a hand-in keeps which is so many days late, begun ones counted.

        >>> policy = Policy(late=Fraction(9, 10), later=(Fraction(4, 5),))
        >>> [str(policy.kept(days)) for days in (0, 1, 2, 7)]
        ['1', '9/10', '4/5', '4/5']
        """
        shares = (Fraction(1), self.late, *self.later)
        return shares[min(days, len(shares) - 1)]

    @property
    def penalizes_lateness(self) -> bool:
        """Whether a late hand-in loses marks."""
        return any(share != 1 for share in (self.late, *self.later))


def rounded(marks: Fraction, step: Fraction) -> Fraction:
    """The nearest multiple of `step`, halves up.

    >>> rounded(Fraction(5, 4), Fraction(1, 2)), rounded(Fraction(1, 3), Fraction(1, 100))
    (Fraction(3, 2), Fraction(33, 100))
    """
    return (marks / step + Fraction(1, 2)).__floor__() * step if step else marks


@lru_cache(maxsize=4096)
def points(*texts: str) -> Fraction:
    """Marks as the record keeps them, added up; a cohort has few different ones.

    >>> points("5/2", "1")
    Fraction(7, 2)
    """
    return sum(map(Fraction, texts), Fraction(0))


@lru_cache(maxsize=4096)
def shown(marks: Fraction) -> str:
    """Marks as people write them: exact, as a decimal where there is a short one.

    >>> shown(Fraction(5, 2)), shown(Fraction(4)), shown(Fraction(1, 3)), shown(Fraction(-1, 20))
    ('2.5', '4', '1/3', '-0.05')
    """
    places = next((n for n in range(7) if (marks * 10**n).denominator == 1), None)
    if places is None:
        return str(marks)
    digits = str(abs(int(marks * 10**places))).rjust(places + 1, "0")
    sign = "-" if marks < 0 else ""
    return sign + (f"{digits[:-places]}.{digits[-places:]}" if places else digits)


def to_data(policy: Policy) -> dict[str, Any]:
    """The policy as JSON carries it to a worker."""
    return {
        "follow": str(policy.follow),
        "caps": {stage: str(cap) for stage, cap in sorted(policy.caps.items())},
        "rounding": str(policy.rounding),
        "late": [str(share) for share in (policy.late, *policy.later)],
        "hints": policy.hints,
    }


def from_data(data: Mapping[str, Any]) -> Policy:
    """The policy that `to_data` wrote.

    >>> from_data(to_data(Policy(late=Fraction(4, 5)))).late
    Fraction(4, 5)
    """
    caps = {stage: Fraction(cap) for stage, cap in data["caps"].items()}
    late, *later = map(Fraction, data["late"])
    return Policy(
        Fraction(data["follow"]), caps, Fraction(data["rounding"]), late, data["hints"], tuple(later)
    )


HALF = Fraction(1, 2)

BY_ITSELF = "earns nothing by itself"


class Marked(Struct, frozen=True):
    """The marks of one answer, and why they are what they are."""

    name: str
    marks: Fraction
    of: Fraction
    why: str


class Piece(Protocol):
    """An entry of a matrix, or a part of a whole."""

    @property
    def verdict(self) -> Verdict:
        """What was found of it."""

    @property
    def zero(self) -> bool:
        """Whether the key is 0 there."""

    @property
    def empty(self) -> bool:
        """Whether it earns nothing by itself."""


def mark(answers: Iterable[JudgedAnswer], quantities: Quantities, policy: Policy) -> tuple[Marked, ...]:
    """The marks of a hand-in's answers, in their order, before what being `late` takes off.

    `quantities` are the robot's, which know the stage of each answer.
    """
    return tuple(_capped((_one(answer, policy) for answer in answers), quantities, policy))


def _one(answer: JudgedAnswer, policy: Policy) -> Marked:
    if not answer.of:
        return Marked(answer.name, Fraction(0), Fraction(0), f"{answer.verdict}; it carries no marks")
    share, why = _share(answer, policy)
    exact = share * answer.of
    marks = exact if exact == answer.of else min(rounded(exact, policy.rounding), answer.of)
    line = f"{why}: {shown(marks)} of {shown(answer.of)}"
    if exact != marks:
        line += f" ({shown(exact)}, rounded to steps of {shown(policy.rounding)})"
    return Marked(answer.name, marks, answer.of, line)


def _share(answer: JudgedAnswer, policy: Policy) -> tuple[Fraction, str]:
    if answer.empty and answer.zero:
        return Fraction(0), f"{answer.verdict}, but {answer.loss}"
    if answer.verdict is Verdict.CORRECT:
        return Fraction(1), "correct"
    pieces: tuple[Piece, ...] = answer.entries or answer.parts
    right = _count(pieces, Verdict.CORRECT)
    follow = policy.follow * (0 if answer.empty else HALF if answer.loss else 1)
    earns = "" if follow == 1 else f"which {_earns(answer, follow)}"
    lost = f"but {answer.loss}" if answer.loss else ""
    if answer.verdict is Verdict.FOLLOWS and not right:
        source = f"follows from {', '.join(answer.follows_from)}" if answer.follows_from else "follows"
        if not pieces or answer.empty or not any(piece.empty for piece in pieces):
            return follow, ", ".join(filter(None, (source, lost, earns)))
    following = _count(pieces, Verdict.FOLLOWS)
    if len(pieces) < 2 or not right + following:
        return Fraction(0), str(answer.verdict)
    said = [f"{right} of {len(pieces)} {_word(answer)} correct"]
    said += filter(None, (f"{following} following", lost, earns)) if following else ()
    missing = _count(pieces, Verdict.MISSING)
    said += [f"{missing} missing"] if missing else []
    return _of_pieces(pieces, follow), ", ".join([*said, *_zeros(pieces)])


def _count(pieces: Iterable[Piece], verdict: Verdict) -> int:
    return sum(piece.verdict is verdict for piece in pieces)


def _earns(answer: JudgedAnswer, follow: Fraction) -> str:
    return BY_ITSELF if answer.empty else f"earns {_percent(follow)}"


def _of_pieces(pieces: tuple[Piece, ...], follow: Fraction) -> Fraction:
    """The share that a matrix or a whole earns by its pieces."""
    carrying = [piece for piece in pieces if not piece.zero]
    zeros = [piece for piece in pieces if piece.zero]
    right = sum((_worth(piece, follow) for piece in carrying), Fraction(0))
    beside = sum((_worth(piece, follow) for piece in zeros), Fraction(0))
    if not carrying:
        return beside / len(pieces)
    return right / len(carrying) * (len(carrying) + beside) / len(pieces)


def _worth(piece: Piece, follow: Fraction) -> Fraction:
    if piece.verdict is Verdict.CORRECT:
        return Fraction(1)
    return follow if piece.verdict is Verdict.FOLLOWS and not piece.empty else Fraction(0)


def _zeros(pieces: tuple[Piece, ...]) -> Iterator[str]:
    """What is said of entries that earn nothing by themselves."""
    zeros = sum(piece.zero for piece in pieces)
    if 0 < zeros < len(pieces):
        yield f"{zeros} of them 0 in the key, which count with the rest"
    empty = sum(piece.empty and piece.verdict is Verdict.FOLLOWS for piece in pieces)
    if empty:
        yield f"{empty} empty, which {BY_ITSELF}"


def _word(answer: JudgedAnswer) -> str:
    if not answer.entries:
        return "parts"
    return "rows" if len(answer.entries[0].index) == 1 else "entries"


def _percent(share: Fraction) -> str:
    return f"{shown(share * 100)} %"


def deduction(total: Fraction, days: int, policy: Policy) -> Marked | None:
    """The line that deducts from what all answers earn, so many days late, begun ones counted; or none.

    What is kept is rounded once, and the rounding never gives back what being late has taken.

    >>> deduction(Fraction(3), 1, Policy(late=Fraction(4, 5), rounding=Fraction(1, 2)))
    Marked(name='late', marks=Fraction(-1, 2), of=Fraction(0, 1), why='80 % of 3 is 2.5')
    """
    share, step = policy.kept(days), policy.rounding
    if share == 1 or not total:
        return None
    kept = rounded(total * share, step)
    if kept >= total:
        kept = (total * share / step).__floor__() * step
    return Marked("late", kept - total, Fraction(0), f"{_percent(share)} of {shown(total)} is {shown(kept)}")


def _capped(found: Iterable[Marked], quantities: Quantities, policy: Policy) -> Iterator[Marked]:
    """Cap the marks of each stage, in the order of the answers; what they are out of is capped too.

    What is left of the cap beside the marks that are earned goes to what could be earned,
    in order, so that no answer has more marks than it is out of.
    """
    found, left = list(found), dict(policy.caps)
    if not left:
        yield from found
        return
    earned = []
    for marked in found:
        stage = quantities.stage(marked.name)
        earned.append(min(marked.marks, left.get(stage, marked.marks)))
        if stage in left:
            left[stage] -= earned[-1]
    for marked, marks in zip(found, earned, strict=True):
        stage = quantities.stage(marked.name)
        if stage not in left:
            yield marked
            continue
        of = marks + min(marked.of - marks, left[stage])
        left[stage] -= of - marks
        why = marked.why
        if (marks, of) != (marked.marks, marked.of):
            why += f"; {stage} is capped at {shown(policy.caps[stage])}: {shown(marks)} of {shown(of)}"
        yield Marked(marked.name, marks, of, why)


def maximum(marks: Iterable[tuple[str, Fraction]], quantities: Quantities, policy: Policy) -> Fraction:
    """The most that a problem can earn.

    >>> from dynsolve.quantities.owners import Owners
    >>> marks = [("K", Fraction(4)), ("P", Fraction(2)), ("D", Fraction(1))]
    >>> maximum(marks, Quantities(Owners(1, (), ("1",))), Policy(caps={"energy": Fraction(5)}))
    Fraction(6, 1)
    """
    all_of = (Marked(name, of, of, "") for name, of in marks)
    return sum((marked.of for marked in _capped(all_of, quantities, policy)), Fraction(0))


# What an answer is worth beside its verdict

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
        if whole == "C" and entry and "Cqd" in self.hand_in.answer_ring.rules:
            return self.hand_in.graph.key("Cqd")[entry[0], 0]
        target = self.hand_in.compare.target(name)
        quantity = self.hand_in.graph.quantities.get(name)
        is_formed = quantity is not None and quantity.family.kind in FORMED
        if not is_formed or target.node not in self.hand_in.answer_ring.rules:
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
        put = placed(numbers, ring)
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
    ring = value.ring
    degrees = value.poly.degrees() if value.poly else ()
    for generator, degree in zip(ring.generators, degrees, strict=False):
        if degree and generator.kind == "symbol":
            yield generator.name
        elif degree and generator.kind in ("sin", "cos"):
            for atom, _ in generator.angle.terms:
                yield from (name for name, _ in atom)
