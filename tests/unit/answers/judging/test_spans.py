"""Spaces of vectors: any basis counts, in columns or in rows."""

from __future__ import annotations

import pytest

from tests.unit.answers.hands import checker, codes, judge, judged, verdicts

ARM = """
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}, {theta: q3*, a: l3}]
state: {q2: 0, q3: 0}
values: {l1: 1}
find: [Jr, nullspace, rangespace, lost]
"""
ELBOW = """
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
find: [nullspace, rangespace, lost]
"""
NULL = [["l2 + l3", "-(l1+l2+l3)", "0"], ["l3", "0", "-(l1+l2+l3)"]]


@pytest.mark.parametrize(
    ("problem", "name", "vectors", "verdict"),
    [
        (ARM, "nullspace", NULL, "correct"),
        (ARM, "nullspace", [list(column) for column in zip(*NULL, strict=True)], "correct"),
        (ARM, "nullspace", [NULL[0], ["0", "l3", "-l2-l3"]], "correct"),
        (ARM, "nullspace", [[entry.replace("l1", "1") for entry in row] for row in NULL], "correct"),
        (ARM, "nullspace", [["1", "-(l1+l2+l3)/(l2+l3)", "0"], NULL[1]], "correct"),
        (ARM, "nullspace", [NULL[0]], "wrong"),
        (ARM, "nullspace", [NULL[0], NULL[0]], "wrong"),
        (ARM, "nullspace", [NULL[0], ["1", "0", "0"]], "wrong"),
        (ARM, "rangespace", [["-sin(q1)", "cos(q1)"]], "correct"),
        (ARM, "rangespace", [["sin(q1)"], ["-cos(q1)"]], "correct"),
        (ARM, "rangespace", [["cos(q1)", "sin(q1)"]], "wrong"),
        (ARM, "lost", [["cos(q1)", "sin(q1)"]], "correct"),
        (ARM, "lost", [["1", "sin(q1)/cos(q1)"]], "correct"),
        (ELBOW, "nullspace", [["0"], ["0"]], "correct"),
        (ELBOW, "nullspace", "0", "correct"),
        (ELBOW, "nullspace", [["1", "0"]], "wrong"),
        (ELBOW, "rangespace", [["1", "1"], ["1", "-1"]], "correct"),
        (ELBOW, "rangespace", [["1", "1"], ["2", "2"]], "wrong"),
        (ELBOW, "lost", "0", "correct"),
    ],
)
def test_verdicts(problem: str, name: str, vectors: list[list[str]] | str, verdict: str) -> None:
    found = judged(problem, name, vectors)
    assert found.verdict == verdict
    assert codes(found) == ([] if verdict == "correct" else ["span"])


@pytest.mark.parametrize(
    ("problem", "name", "written"),
    [
        (ARM, "lost", "span{[cos(q1), sin(q1)]}"),
        (ARM, "lost", r"\mathrm{span}\left\{\begin{bmatrix}\cos q_1\\ \sin q_1\end{bmatrix}\right\}"),
        (ARM, "lost", r"\alpha [\cos q_1, \sin q_1]^T"),
        (ARM, "lost", r"k [c_1, s_1]^T, k \in \mathbb{R}"),
        (ARM, "rangespace", "span{[-sin(q1); cos(q1)]}"),
        (ELBOW, "rangespace", r"\mathbb{R}^2"),
        (ELBOW, "rangespace", "ℝ²"),
        (ELBOW, "nullspace", "{0}"),
        (ELBOW, "nullspace", r"\{\mathbf{0}\}"),
        (ELBOW, "nullspace", "[]"),
        (ELBOW, "lost", "none"),
    ],
)
def test_spaces_as_they_are_written(problem: str, name: str, written: str) -> None:
    check = checker(problem)
    report = check(check.reader(f"answers:\n  {name}: {written}\n", "answer.yaml"))
    assert next(found.verdict for found in report.answers if found.name == name) == "correct"


def test_what_is_wrong_with_them_is_told() -> None:
    assert "dimension 1; this one has dimension 2" in judged(ARM, "nullspace", [NULL[0]]).diagnosis[0].message
    assert "vectors of 3 entries" in judged(ARM, "nullspace", [["1", "2"]]).diagnosis[0].message


def test_a_space_follows_from_a_jacobian_that_is_wrong() -> None:
    J = [["-l1*sin(q1)", "-l2*sin(q1)", "-l3*sin(q1)"], ["l1*cos(q1)", "l2*cos(q1)", "l3*cos(q1)"]]
    found = judge(ARM, {"Jr": J, "nullspace": [["l2", "-l1", "0"], ["l3", "0", "-l1"]]})
    assert (verdicts(found)["Jr"], verdicts(found)["nullspace"]) == ("wrong", "follows")
