"""Denavit-Hartenberg tables judged by the mechanism: other frames are right, a slip is told by its cell."""

from __future__ import annotations

from itertools import permutations

import pytest

from dynsolve.answers.judging.mechanism.tables import TableComparer
from dynsolve.answers.table_verdict import HELD
from dynsolve.problem import read_problem
from tests.unit.answers.hands import codes, judged
from tests.unit.problem.test_drawing import FOUR_JOINTS, OFFSET_ARM, PAINTING_ARM, RPR, RRRP

Rows = list[list[str]]

# The tables of the sheets and solutions named in tests/unit/problem/test_drawing.py
OFFICIAL: dict[str, tuple[str, Rows]] = {
    "INF3480 2009": (FOUR_JOINTS, [["q1", "l1", "0", "0"], ["pi/2", "q2 + l2", "0", "pi/2"],
                                   ["q3 + pi/2", "loff", "0", "pi/2"], ["q4", "l3 + l4", "0", "0"]]),
    "INF3480 2013": (PAINTING_ARM, [["theta1", "L1 + L2/sqrt(2)", "L2/sqrt(2)", "pi/2"],
                                    ["theta2 - pi/4", "0", "0", "-pi/2"], ["0", "L3", "0", "0"]]),
    "INF3480 2018": (OFFSET_ARM, [["theta1", "L1", "0", "-pi/2"], ["theta2 - pi/2", "Loff", "L2", "-pi/2"],
                                  ["pi/2", "L3", "0", "0"]]),
    "Sapienza 2021": (RRRP, [["q1", "A", "B", "pi/2"], ["q2", "0", "C", "0"], ["q3", "0", "D", "pi/2"],
                             ["0", "q4", "0", "0"]]),
    "Sapienza 2022": (RPR, [["q1", "d1", "0", "pi/2"], ["pi/2", "q2", "0", "pi/2"], ["q3", "0", "a3", "0"]]),
}  # fmt: skip
DRAWN = "zero: drawn\n"
TWO_LINKS = "dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]\n"


@pytest.mark.parametrize(("text", "rows"), OFFICIAL.values(), ids=OFFICIAL)
def test_the_table_of_the_sheet_is_right(text: str, rows: Rows) -> None:
    answer = judged(text + DRAWN, "DH", rows)
    assert answer.verdict == "correct"
    assert set(answer.notes) <= {HELD}


def _changed(rows: Rows, row: int, column: int, cell: str) -> Rows:
    return [
        [cell if (i, j) == (row, column) else c for j, c in enumerate(r, 1)] for i, r in enumerate(rows, 1)
    ]


SLIPS = [
    # sheet, row, column, what is written, what is needed
    ("INF3480 2018", 1, 4, "0", "-90°"),
    ("INF3480 2018", 2, 2, "0", "Loff"),
    ("INF3480 2018", 2, 3, "0", "L₂"),
    ("INF3480 2018", 3, 3, "L2", "0"),
    ("INF3480 2013", 1, 3, "L2", "√2 L₂/2"),
    ("INF3480 2013", 1, 4, "0", "90°"),
    ("INF3480 2009", 3, 2, "0", "loff"),
    ("INF3480 2009", 4, 2, "l3", "l₃ + l₄"),
    ("Sapienza 2021", 2, 3, "0", "C"),
    ("Sapienza 2021", 2, 4, "90deg", "0"),
    ("Sapienza 2022", 2, 1, "0", "90°"),
    ("Sapienza 2022", 3, 3, "0", "a₃"),
]


@pytest.mark.parametrize(("sheet", "row", "column", "cell", "needed"), SLIPS)
def test_a_slip_is_told_by_its_row_and_column(
    sheet: str, row: int, column: int, cell: str, needed: str
) -> None:
    text, rows = OFFICIAL[sheet]
    answer = judged(text + DRAWN, "DH", _changed(rows, row, column, cell))
    assert answer.verdict == "wrong"
    (told,) = answer.diagnosis
    assert told.code == "dh_cell"
    assert told.message.startswith(f"Row {row}, {'θdaα'[column - 1]}: ")
    assert f"where {needed} is needed" in told.message
    assert [entry.index for entry in answer.entries if entry.verdict == "wrong"] == [(row, column)]


def test_two_slips_are_told_both() -> None:
    text, rows = OFFICIAL["INF3480 2018"]
    answer = judged(text + DRAWN, "DH", _changed(_changed(rows, 1, 4, "0"), 2, 2, "0"))
    assert [told.message.partition(":")[0] for told in answer.diagnosis] == ["Row 1, α", "Row 2, d"]
    assert [entry.index for entry in answer.entries if entry.verdict == "wrong"] == [(1, 4), (2, 2)]


def test_a_table_of_another_robot_says_where_it_parts() -> None:
    text, _ = OFFICIAL["INF3480 2018"]
    rows = [["theta1", "0", "L2", "45deg"], ["theta2", "L1", "L1", "45deg"], ["45deg", "L3", "L1", "0"]]
    answer = judged(text + DRAWN, "DH", rows)
    assert codes(answer) == ["dh_mechanism"]
    assert "the axis of joint 2 has another direction" in answer.diagnosis[0].message


OTHER_FRAMES = {
    # of the arm of INF3480 2018: z_1 the other way, so θ_2 is counted the other way
    "z_1 turned round": ([["theta1", "L1", "0", "pi/2"], ["-theta2 + pi/2", "-Loff", "L2", "pi/2"],
                          ["0", "L3", "0", "0"]], ()),
    "z_1 turned round, θ_2 by its own sense": (
        [["theta1", "L1", "0", "pi/2"], ["theta2 + pi/2", "-Loff", "L2", "pi/2"], ["0", "L3", "0", "0"]],
        ("θ₂ is counted the other way",)),
    "frame 0 in the shoulder": ([["theta1", "0", "0", "-pi/2"], ["theta2 - pi/2", "Loff", "L2", "-pi/2"],
                                 ["0", "L3", "0", "0"]], ()),
    "x_0 to the side": ([["theta1 + 90deg", "L1", "0", "-pi/2"], ["theta2 - 90deg", "Loff", "L2", "-pi/2"],
                         ["0", "L3", "0", "0"]], ()),
    "θ_2 without its offset": (
        [["theta1", "L1", "0", "-pi/2"], ["theta2", "Loff", "L2", "-pi/2"], ["0", "L3", "0", "0"]],
        ("θ₂ is counted otherwise: yours is θ₂ - 90° in the robot's",)),
    "the slide the other way": (
        [["theta1", "L1", "0", "-90"], ["theta2 - 90", "Loff", "L2", "90"], ["0", "L3", "0", "0"]],
        ("L₃ is counted the other way",)),
    "the slide from elsewhere": (
        [["theta1", "L1", "0", "-90"], ["theta2 - 90", "Loff", "L2", "-90"], ["0", "L3 + L1", "0", "0"]],
        ("L₃ is counted from elsewhere",)),
    "a fixed row for the hand": ([["theta1", "L1", "0", "-90"], ["theta2 - 90", "Loff", "L2", "-90"],
                                  ["0", "L3", "0", "0"], ["90", "0", "0", "0"]], ()),
}  # fmt: skip


@pytest.mark.parametrize(("rows", "notes"), OTHER_FRAMES.values(), ids=OTHER_FRAMES)
def test_other_frames_are_right_and_what_is_counted_otherwise_is_a_note(
    rows: Rows, notes: tuple[str, ...]
) -> None:
    answer = judged(OFFSET_ARM + DRAWN, "DH", rows)
    assert answer.verdict == "correct"
    assert answer.notes == (*notes, HELD)
    strict = judged(f"{OFFSET_ARM}{DRAWN}strict: true\n", "DH", rows)
    assert strict.verdict == ("wrong" if notes else "correct")
    assert codes(strict) == ["dh_sense"] * bool(notes)


def test_the_keys_own_table_needs_no_comparison() -> None:
    assert not judged("planar-2r", "DH", [["q1", "0", "l1", "0"], ["q2", "0", "l2", "0"]]).notes


def test_a_table_that_is_accepted_as_it_stands() -> None:
    rows = [["q1", "l1", "0", "0"], ["q2", "0", "l2", "0"]]
    assert judged(TWO_LINKS, "DH", rows).verdict == "wrong"
    also = TWO_LINKS + "also: [[[q1*, l1, 0, 0], [q2*, 0, l2, 0]]]\n"
    assert judged(also, "DH", rows).verdict == "correct"
    assert judged(also, "DH", [["q1", "l2", "0", "0"], ["q2", "0", "l2", "0"]]).verdict == "wrong"


JOINTS = {
    "a joint too few": ([["q1", "0", "l1", "0"], ["0", "0", "l2", "0"]], "1 joint variables"),
    "joints exchanged": ([["q2", "0", "l1", "0"], ["q1", "0", "l2", "0"]], "row 1 moves with q2"),
    "an angle in d": ([["0", "q1", "l1", "0"], ["q2", "0", "l2", "0"]], "q1 turns, and belongs to θ"),
    "three columns": ([["q1", "0", "l1"], ["q2", "0", "l2"]], "row 1 has 3 columns"),
    "not linear": ([["q1^2", "0", "l1", "0"], ["q2", "0", "l2", "0"]], "not linear"),
}


@pytest.mark.parametrize(("rows", "message"), JOINTS.values(), ids=JOINTS)
def test_joint_variables_that_are_not_the_robots(rows: Rows, message: str) -> None:
    answer = judged(TWO_LINKS, "DH", rows)
    assert codes(answer) == ["dh_joints"]
    assert message in answer.diagnosis[0].message


NO_VALUES = [
    [["q1", "0", "l1", "zeta"], ["q2", "0", "l2", "0"]],
    [["q1", "sqrt(-1)", "l1", "0"], ["q2", "0", "l2", "0"]],
    [["q1", "1/0", "l1", "0"], ["q2", "0", "l2", "0"]],
]


@pytest.mark.parametrize("rows", NO_VALUES)
def test_a_cell_without_a_value_is_wrong_and_stops_nothing(rows: Rows) -> None:
    answer = judged(TWO_LINKS + "also: [[[q1*, l1, 0, 0], [q2*, 0, l2, 0]]]\n", "DH", rows)
    assert answer.verdict == "wrong"
    assert len(answer.diagnosis) == 1


def test_the_table_of_a_file_with_a_table_is_judged_too() -> None:
    assert (
        judged("planar-2r", "DH", [["q1", "0", "l1", "180deg"], ["-q2", "0", "l2", "0"]]).verdict == "correct"
    )


def test_decimals_are_rounded() -> None:
    rows = [["theta1", "L1 + 0.707*L2", "0.707*L2", "1.571"], ["theta2 - 0.785", "0", "0", "-1.571"],
            ["0", "L3", "0", "0"]]  # fmt: skip
    answer = judged(PAINTING_ARM + DRAWN, "DH", rows)
    assert answer.verdict == "correct"
    assert answer.notes == ("rounded", HELD)


def test_tables_are_compared_with_any_two_letters_in_either_order() -> None:
    rows = ", ".join(f"{{theta: q{k}*, d: d{k}, a: a{k}, alpha: 90deg}}" for k in range(1, 7))
    drawn = TableComparer(read_problem(f"dh: [{rows}]\n", "own.yaml")).letters
    names = [name for name in drawn[0] if name != "pi"]
    assert len(names) == 13  # with g
    assert all(any(at[a] < at[b] for at in drawn) for a, b in permutations(names, 2))
