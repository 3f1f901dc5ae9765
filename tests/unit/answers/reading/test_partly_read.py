"""Matrices whose entries have no names, and C, with an entry that cannot be read: the others are judged."""

from __future__ import annotations

import pytest

from dynsolve.answers.feedback import FeedbackView, slips
from dynsolve.answers.reading.files import read_submission
from dynsolve.answers.verdict import JudgedAnswer
from tests.unit.answers.hands import checker, problem

h = "m2*l1*lc2*sin(q2)"
MATRICES = {
    "C": [[f"-{h}*qd2", f"-{h}*(qd1 + qd2)"], [f"{h}*qd1", "0"]],
    "Cqd": [[f"-{h}*(2*qd1*qd2 + qd2^2)"], [f"{h}*qd1^2"]],
    "H1": [["cos(q1)", "-sin(q1)", "0", "l1*cos(q1)"], ["sin(q1)", "cos(q1)", "0", "l1*sin(q1)"],
           ["0", "0", "1", "0"], ["0", "0", "0", "1"]],
    "rc2": [["l1*cos(q1) + lc2*cos(q1 + q2)"], ["l1*sin(q1) + lc2*sin(q1 + q2)"], ["0"]],
    "Jv1": [["-lc1*sin(q1)", "0"], ["lc1*cos(q1)", "0"], ["0", "0"]],
}  # fmt: skip
SHAPES = {
    "r.txt": ("{} = [{}]", "; ", ", "),
    "r.md": (r"$${} = \begin{{bmatrix}} {} \end{{bmatrix}}$$", r" \\ ", " & "),
    "a.yaml": ("answers:\n  {}: [[{}]]", "], [", ", "),
}


def judged(name: str, rows: list[list[str]], file: str) -> JudgedAnswer:
    form, between, beside = SHAPES[file]
    check = checker("planar-2r")
    text = form.format(name, between.join(beside.join(row) for row in rows))
    report = check(read_submission(problem("planar-2r"), text, file))
    return next(a for a in report.answers if a.name == name)


def changed(rows: list[list[str]], **at: str) -> list[list[str]]:
    """The rows with other entries at places such as `_11`."""
    places = {(int(place[1]) - 1, int(place[2]) - 1): entry for place, entry in at.items()}
    return [[places.get((i, j), entry) for j, entry in enumerate(row)] for i, row in enumerate(rows)]


@pytest.mark.parametrize("file", SHAPES)
@pytest.mark.parametrize("name", MATRICES)
def test_what_is_read_is_judged_and_the_rest_waits(name: str, file: str) -> None:
    right, wrong = (
        judged(name, changed(MATRICES[name], _11="kappa", _21=second), file)
        for second in (MATRICES[name][1][0], f"2*q1 + {MATRICES[name][1][0]}")
    )
    for answer, second in ((right, "correct"), (wrong, "wrong")):
        assert str(answer.verdict) == "unreadable" and "entry" in answer.fault and answer.place
        first, *others = answer.entries
        assert str(first.verdict) == "unreadable"
        is_second = [entry.index in ((2,), (2, 1)) for entry in others]
        assert [str(e.verdict) for e in others] == [second if it else "correct" for it in is_second]


def test_the_student_is_told_what_was_read() -> None:
    rows = changed(MATRICES["rc2"], _11="kappa", _21="l1*sin(q1) - lc2*sin(q1 + q2)")
    check = checker("planar-2r")
    text = f"rc2 = [{'; '.join(row[0] for row in rows)}]"
    report = check(read_submission(problem("planar-2r"), text, "r.txt"))
    folds = str(list(slips(report, FeedbackView())))
    assert "Of what could be read, entry 2 is wrong." in folds


def test_where_no_entry_can_be_read() -> None:
    answer = judged("rc2", [["kappa"]] * 3, "r.txt")
    assert str(answer.verdict) == "unreadable" and not answer.entries


def test_a_part_of_a_matrix_is_no_value_of_the_students_own() -> None:
    check = checker("planar-2r")
    rows = changed(MATRICES["C"], _11="kappa")
    text = f"C = [{'; '.join(', '.join(row) for row in rows)}]\nCqd = [0; {h}*qd1^2]\n"
    report = check(read_submission(problem("planar-2r"), text, "r.txt"))
    assert {a.name: str(a.verdict) for a in report.answers}["Cqd"] == "wrong"
