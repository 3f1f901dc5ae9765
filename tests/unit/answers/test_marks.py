"""Every mark is what its verdict, the policy and one line say."""

from __future__ import annotations

import re
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from msgspec.structs import replace

from dynsolve.answers.marks import Policy, deduction, mark, maximum, rounded, shown
from dynsolve.answers.verdict import EntryVerdict, JudgedAnswer, Verdict
from dynsolve.quantities.index import Quantities
from dynsolve.quantities.owners import Owners
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Coordinate, JointType
from tests.unit.answers.hands import checker, submission

F = Fraction
COORDINATES = (Coordinate("theta1", JointType.REVOLUTE, 1), Coordinate("d2", JointType.PRISMATIC, 2))
QUANTITIES = Quantities(Owners(2, COORDINATES, ("1", "2")))


def _answer(name: str, verdict: Verdict, of: int = 4, entries: str = "", **rest: object) -> JudgedAnswer:
    said = {"c": Verdict.CORRECT, "f": Verdict.FOLLOWS, "w": Verdict.WRONG}
    pieces = tuple(EntryVerdict((i, 1), said[letter]) for i, letter in enumerate(entries, 1))
    return JudgedAnswer(name, verdict, of=F(of), entries=pieces, **rest)  # type: ignore[arg-type]


def test_shares() -> None:
    answers = [
        _answer("P", Verdict.CORRECT),
        _answer("K", Verdict.FOLLOWS, follows_from=("K1",)),
        _answer("D", Verdict.WRONG, entries="ccfw"),
        _answer("C", Verdict.UNREADABLE),
        _answer("g", Verdict.MISSING),
        _answer("L", Verdict.WRONG, of=0),
    ]
    found = mark(answers, QUANTITIES, Policy(follow=F(1, 2)))
    assert [m.marks for m in found] == [4, 2, F(5, 2), 0, 0, 0]
    assert [m.why for m in found] == [
        "correct: 4 of 4",
        "follows from K1, which earns 50 %: 2 of 4",
        "2 of 4 entries correct, 1 following, which earns 50 %: 2.5 of 4",
        "unreadable: 0 of 4",
        "missing: 0 of 4",
        "wrong; it carries no marks",
    ]


def test_what_follows_and_has_lost_something_earns_half() -> None:
    (found,) = mark([_answer("tau", Verdict.FOLLOWS, loss="body 2 is lost on the way")], QUANTITIES, Policy())
    assert (found.marks, found.why) == (2, "follows, but body 2 is lost on the way, which earns 50 %: 2 of 4")


def test_a_cap_limits_what_a_stage_earns_and_what_it_is_out_of() -> None:
    answers = [_answer("P", Verdict.CORRECT), _answer("K", Verdict.CORRECT), _answer("D", Verdict.CORRECT)]
    found = mark(answers, QUANTITIES, Policy(caps={"energy": F(5)}))
    assert [(m.marks, m.of) for m in found] == [(4, 4), (1, 1), (4, 4)]
    assert found[1].why == "correct: 4 of 4; energy is capped at 5: 1 of 1"


def test_a_whole_by_its_parts() -> None:
    parts = (_answer("K1", Verdict.CORRECT), _answer("K2", Verdict.WRONG))
    (found,) = mark([_answer("K", Verdict.WRONG, parts=parts)], QUANTITIES, Policy())
    assert (found.marks, found.why) == (2, "1 of 2 parts correct: 2 of 4")


def test_an_answer_that_follows_in_part_earns_what_is_right_in_full() -> None:
    answers = [_answer("D", Verdict.FOLLOWS, entries="cfff", follows_from=("K",))]
    (found,) = mark(answers, QUANTITIES, Policy(follow=F(1, 2)))
    assert (found.marks, found.why) == (
        F(5, 2), "1 of 4 entries correct, 3 following, which earns 50 %: 2.5 of 4",
    )  # fmt: skip
    lost = [replace(answer, loss="body 2 is lost on the way") for answer in answers]
    (found,) = mark(lost, QUANTITIES, Policy())
    assert found.marks == F(5, 2)
    assert "3 following, but body 2 is lost on the way, which earns 50 %: 2.5 of 4" in found.why


def test_a_matrix_that_is_written_in_part_earns_what_is_there() -> None:
    parts = (_answer("g1", Verdict.CORRECT), _answer("g2", Verdict.MISSING))
    (found,) = mark([_answer("g", Verdict.MISSING, parts=parts)], QUANTITIES, Policy())
    assert (found.marks, found.why) == (2, "1 of 2 parts correct, 1 missing: 2 of 4")


def test_rounding_takes_nothing_from_all_and_gives_no_more_than_all() -> None:
    policy = Policy(rounding=F(1, 2))
    answers = [JudgedAnswer("K", Verdict.CORRECT, of=F(1, 3)), _answer("D", Verdict.WRONG, 0, "cccw")]
    answers[1] = replace(answers[1], of=F(1, 3))
    assert [m.marks for m in mark(answers, QUANTITIES, policy)] == [F(1, 3), F(1, 3)]


def test_a_cap_leaves_no_answer_more_than_it_is_out_of() -> None:
    answers = [_answer("P", Verdict.WRONG), _answer("K", Verdict.CORRECT)]
    found = mark(answers, QUANTITIES, Policy(caps={"energy": F(5)}))
    assert [(m.marks, m.of) for m in found] == [(0, 1), (4, 4)]
    assert found[0].why == "wrong: 0 of 4; energy is capped at 5: 0 of 1"


def test_the_cap_of_a_stage_is_that_of_bodies_by_any_name() -> None:
    named = Quantities(Owners(2, COORDINATES, ("p", "m2")))
    answers = [_answer(name, Verdict.CORRECT, 3) for name in ("Kp", "Kvm2", "D")]
    found = mark(answers, named, Policy(caps={"energy": F(3)}))
    assert [(m.marks, m.of) for m in found] == [(3, 3), (0, 0), (3, 3)]


def _matrix(zeros: str, entries: str, verdict: Verdict = Verdict.WRONG) -> JudgedAnswer:
    answer = _answer("D", verdict, 12, entries)
    weighed = (replace(e, zero=zero == "0") for e, zero in zip(answer.entries, zeros, strict=True))
    return replace(answer, entries=tuple(weighed))


@pytest.mark.parametrize(
    ("zeros", "entries", "marks"),
    [
        ("x00x", "cccc", 12),  # all of it
        ("x00x", "wccw", 0),  # zeros earn nothing
        ("x00x", "cccw", 6),  # the mark is over the entries that carry something
        ("x00x", "cwcc", 9),  # a wrong zero costs its part
        ("x00x", "wwcc", F(9, 2)),
        ("x00x", "fccc", 9),
        ("xxxx", "cccw", 9),
    ],
)
def test_zeros_of_a_matrix_earn_with_the_rest(zeros: str, entries: str, marks: Fraction) -> None:
    verdict = Verdict.WRONG if "w" in entries else Verdict.CORRECT if "f" not in entries else Verdict.FOLLOWS
    (found,) = mark([_matrix(zeros, entries, verdict)], QUANTITIES, Policy(follow=F(1, 2)))
    assert found.marks == marks


def test_what_follows_from_nothing_earns_nothing() -> None:
    empty = _answer("tau", Verdict.FOLLOWS, loss="body 2 is lost on the way", empty=True)
    (found,) = mark([empty], QUANTITIES, Policy())
    assert (found.marks, found.why) == (
        0, "follows, but body 2 is lost on the way, which earns nothing by itself: 0 of 4",
    )  # fmt: skip


@pytest.mark.parametrize(
    ("late", "days", "rounding", "marks"),
    [
        ("0.9", 1, "1", 3),  # 3.6 is not rounded to what it was
        ("0.8", 1, "1", 3),
        ("0.9", 1, "0.01", F(18, 5)),
        ("0.9 0.8 0.5", 0, "1/2", 4),
        ("0.9 0.8 0.5", 1, "1/2", F(7, 2)),
        ("0.9 0.8 0.5", 2, "1/2", 3),
        ("0.9 0.8 0.5", 9, "1/2", 2),
    ],
)
def test_late_is_taken_once_from_the_total(late: str, days: int, rounding: str, marks: Fraction) -> None:
    first, *later = map(F, late.split())
    policy = Policy(late=first, later=tuple(later), rounding=F(rounding))
    line = deduction(F(4), days, policy)
    assert (line.marks if line else 0) == marks - 4
    assert line is None or line.why.endswith(f" of 4 is {shown(F(marks))}")


_POINTS = st.fractions(0, 10, max_denominator=6)
_SHARES = st.fractions(0, 1, max_denominator=10)
_NAMES = ("A1", "Jv", "I1", "P", "K", "K1", "L", "tau", "f2", "D", "C", "g", "d12")


@st.composite
def _answers(draw: st.DrawFn) -> list[JudgedAnswer]:
    found = []
    for name in draw(st.lists(st.sampled_from(_NAMES), unique=True)):
        verdict = draw(st.sampled_from(Verdict))
        size = draw(st.integers(0, 6)) if verdict in (Verdict.WRONG, Verdict.FOLLOWS) else 0
        kinds = [Verdict.CORRECT, Verdict.FOLLOWS] + [Verdict.WRONG] * (verdict is Verdict.WRONG)
        pieces = draw(st.lists(st.sampled_from(kinds), min_size=size, max_size=size))
        entries = tuple(EntryVerdict((i, 1), piece) for i, piece in enumerate([*pieces, verdict], 1))
        found.append(JudgedAnswer(name, verdict, of=draw(_POINTS), entries=entries if size else ()))
    return found


_POLICIES = st.builds(
    Policy,
    follow=_SHARES,
    late=_SHARES,
    caps=st.dictionaries(st.sampled_from(Stage), _POINTS),
    rounding=st.sampled_from([F(1, 100), F(1, 4), F(1, 2), F(1), F(1, 3)]),
)


@pytest.mark.slow
@given(_answers(), _POLICIES, st.booleans())
@settings(max_examples=120, deadline=None)
def test_marks_hold_together_whatever_the_policy(
    answers: list[JudgedAnswer], policy: Policy, lost: bool
) -> None:
    if lost:
        answers = [replace(answer, loss="body 2 is lost on the way") for answer in answers]
    found = mark(answers, QUANTITIES, policy)
    assert [m.name for m in found] == [a.name for a in answers]
    for marked, answer in zip(found, answers, strict=True):
        assert 0 <= marked.marks <= marked.of <= answer.of
        of_it = f": {shown(marked.marks)}"
        said = re.sub(r" \([^()]*\)$", "", marked.why)  # how it was rounded
        assert not answer.of or said.endswith((of_it, f"{of_it} of {shown(marked.of)}"))
        if answer.verdict is Verdict.CORRECT and QUANTITIES.stage(answer.name) not in policy.caps:
            assert marked.marks == answer.of
        if marked.marks not in (answer.of, rounded(marked.marks, policy.rounding)):
            assert policy.caps
    uncapped = mark(answers, QUANTITIES, replace(policy, caps={}))
    for stage, cap in policy.caps.items():
        here = [m for m in found if QUANTITIES.stage(m.name) == stage]
        earned = sum((m.marks for m in uncapped if QUANTITIES.stage(m.name) == stage), F(0))
        assert sum((m.marks for m in here), F(0)) == min(cap, earned)
    total = sum((m.marks for m in found), F(0))
    line = deduction(total, 1, policy)
    assert (line is not None) is (policy.late < 1 and total > 0)
    if line is not None:
        kept = total + line.marks
        assert 0 <= kept < total and rounded(kept, policy.rounding) == kept
        assert abs(kept - policy.late * total) <= policy.rounding
    of = sum((m.of for m in found), F(0))
    assert of == maximum(((a.name, a.of) for a in answers), QUANTITIES, policy)


@pytest.mark.slow
@given(_answers(), _POLICIES)
@settings(max_examples=100, deadline=None)
def test_what_is_right_earns_no_less_than_what_is_not(answers: list[JudgedAnswer], policy: Policy) -> None:
    before = sum((m.marks for m in mark(answers, QUANTITIES, policy)), F(0))
    better = [replace(a, verdict=Verdict.CORRECT, entries=()) for a in answers]
    assert sum((m.marks for m in mark(better, QUANTITIES, policy)), F(0)) >= before


def test_the_parts_of_a_jacobian_are_its_rows_where_it_stands_whole() -> None:
    arm = "dh: [{theta: q1*, a: l1}, {d: d2*, alpha: 0}]\nfind: [Jv, Jw]\nmarks: {Jv: 6, Jw: 6}\n"
    rows = [["-l1*sin(q1)", "0"], ["l1*cos(q1)", "0"], ["0", "1"], ["0", "0"], ["0", "1"], ["1", "0"]]
    found = {one.name: one for one in checker(arm)(submission({"J": rows})).answers}
    assert (found["Jv"].verdict, found["Jw"].verdict) == ("correct", "wrong")
    assert [(e.index, e.verdict) for e in found["Jw"].entries if e.verdict == "wrong"] == [((2, 2), "wrong")]
    assert (found["Jv"].marks, found["Jw"].marks) == (6, 5)
