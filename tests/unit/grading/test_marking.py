"""Every mark is what its verdict, the policy and one line say."""

from __future__ import annotations

from fractions import Fraction

from dynsolve.answers.verdict import EntryVerdict, Judged, Verdict
from dynsolve.grading.marking import mark
from dynsolve.grading.policy import Policy

F = Fraction


def _answer(name: str, verdict: Verdict, of: int = 4, entries: str = "", **rest: object) -> Judged:
    said = {"c": Verdict.CORRECT, "f": Verdict.FOLLOWS, "w": Verdict.WRONG}
    pieces = tuple(EntryVerdict((i, 1), said[letter]) for i, letter in enumerate(entries, 1))
    return Judged(name, verdict, of=F(of), entries=pieces, **rest)  # type: ignore[arg-type]


def test_shares() -> None:
    answers = [
        _answer("P", Verdict.CORRECT),
        _answer("K", Verdict.FOLLOWS, follows_from=("K1",)),
        _answer("D", Verdict.WRONG, entries="ccfw"),
        _answer("C", Verdict.UNREADABLE),
        _answer("g", Verdict.MISSING),
        _answer("L", Verdict.WRONG, of=0),
    ]
    found = mark(answers, Policy(follow=F(1, 2)))
    assert [m.marks for m in found] == [4, 2, F(5, 2), 0, 0, 0]
    assert [m.why for m in found] == [
        "correct: 4 of 4",
        "follows from K1, which earns 50 %: 2 of 4",
        "2 of 4 entries correct, 1 following: 2.5 of 4",
        "unreadable: 0 of 4",
        "missing: 0 of 4",
        "wrong; it carries no marks",
    ]


def test_what_follows_and_has_lost_something_earns_half() -> None:
    (found,) = mark([_answer("tau", Verdict.FOLLOWS)], Policy(), losses={"tau": "body 2 is lost on the way"})
    assert (found.marks, found.why) == (2, "follows, but body 2 is lost on the way; which earns 50 %: 2 of 4")


def test_late_and_rounding() -> None:
    policy = Policy(late=F(4, 5), rounding=F(1, 2))
    (found,) = mark([_answer("K", Verdict.CORRECT, 3)], policy, late=True)
    assert (found.marks, found.why) == (F(5, 2), "correct: 3 of 3; late, 80 % of it: 2.5")


def test_a_cap_limits_what_a_stage_earns_and_what_it_is_out_of() -> None:
    answers = [_answer("P", Verdict.CORRECT), _answer("K", Verdict.CORRECT), _answer("D", Verdict.CORRECT)]
    found = mark(answers, Policy(caps={"energy": F(5)}))
    assert [(m.marks, m.of) for m in found] == [(4, 4), (1, 1), (4, 4)]
    assert found[1].why == "correct: 4 of 4; energy is capped at 5: 1"


def test_a_whole_by_its_parts() -> None:
    parts = {"K": (_answer("K1", Verdict.CORRECT), _answer("K2", Verdict.WRONG))}
    (found,) = mark([_answer("K", Verdict.WRONG)], Policy(), parts=parts)
    assert (found.marks, found.why) == (2, "1 of 2 parts correct: 2 of 4")
