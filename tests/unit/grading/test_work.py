"""The work on one hand-in: marks, losses, several files; and the bounds it stands under."""

from __future__ import annotations

import base64
import os
import signal
import sys
import threading
import time
from fractions import Fraction
from typing import Any

import pytest

from dynsolve.answers.marks import Policy, to_data
from dynsolve.errors import UsageError
from dynsolve.grading import pool as pool_module
from dynsolve.grading.pool import Bounds, LocalPool, Worker
from dynsolve.grading.work import grade_one
from dynsolve.problem.reader import find
from tests.support import ROOT

MARKS = {"K": "4", "tau": "6"}


def payload(*texts: str, problem: str = "in3140-rp", **more: Any) -> dict[str, Any]:
    files = [
        {"name": f"part{i}.yaml", "content": base64.b64encode(text.encode()).decode()}
        for i, text in enumerate(texts)
    ]
    return {
        "problem": {"file": f"{problem}.yaml", "text": find(problem).read_text()},
        "marks": MARKS,
        "policy": to_data(Policy()),
        "student": "s1",
        "late": False,
        "files": files,
        **more,
    }


@pytest.fixture
def heavy(monkeypatch: pytest.MonkeyPatch) -> None:
    """Workers on which some answers are too much."""
    monkeypatch.setattr(pool_module, "MODULE", "tests.grading.heavy_worker")
    monkeypatch.setenv("PYTHONPATH", str(ROOT), prepend=os.pathsep)


def _answers(result: dict[str, Any]) -> dict[str, dict[str, Any]]:
    return {answer["name"]: answer for answer in result["answers"]}


RIGHT_K = "answers:\n  K: (I1zz*theta1'^2)/2 + m2*(L2'^2 + L2^2*theta1'^2)/2\n"
RIGHT_TAU = (
    "answers:\n  tau: [(m2*L2^2 + I1zz)*theta1_ddot + 2*m2*L2*theta1_dot*L2_dot,"
    " m2*L2_ddot - m2*L2*theta1_dot^2]\n"
)


def test_several_files_are_one_hand_in() -> None:
    found = _answers(grade_one(payload(RIGHT_K, "answers:\n  P: 0\n")))
    assert set(found) == {"K", "P", "tau"}
    assert (found["K"]["marks"], found["tau"]["verdict"]) == ("4", "missing")


ARM = """title: Arm
dh: [{theta: q1*, d: h, alpha: 90deg}, {theta: q2*, a: l2}]
masses: [{mass: m, link: 2}]
find: [DH, g, D, C, tau, singular]
"""


def test_the_files_after_the_first_may_hold_sets_and_general_formulas() -> None:
    more = {"problem": {"file": "arm.yaml", "text": ARM}, "marks": {"singular": "2", "tau": "1"}}
    inertia = "D: [[m*l2^2*cos(q2)^2, 0], [0, m*l2^2]]"
    rates = "C: [[-m*l2^2*sin(q2)*cos(q2)*q2', -m*l2^2*sin(q2)*cos(q2)*q1'], [m*l2^2*sin(q2)*cos(q2)*q1', 0]]"
    parts = f"answers:\n  {inertia}\n  {rates}\n  g: [0, m*g*l2*cos(q2)]\n"
    sets = "answers:\n  singular: cos(q2) = 0\n"
    torques = "$$\\tau = D\\ddot q + C\\dot q + g$$"
    first = {**payload(parts, sets), **more}
    formula = {"name": "part2.md", "content": base64.b64encode(torques.encode()).decode()}
    found = _answers(grade_one({**first, "files": [*first["files"], formula]}))
    assert {name: found[name]["marks"] for name in ("singular", "tau")} == {"singular": "2", "tau": "1"}


def test_what_follows_a_table_in_other_frames_earns_its_marks() -> None:
    more = {"problem": {"file": "arm.yaml", "text": ARM}, "marks": {"DH": "1", "g": "2"}}
    table = "DH: [[q1, h, 0, 90deg], [q2 + 90deg, 0, l2, 0]]"  # q2 from the vertical
    text = f"answers:\n  {table}\n  g: [0, -m*g*l2*sin(q2)]\n"
    found = _answers(grade_one({**payload(text), **more}))
    assert {name: answer["marks"] for name, answer in found.items()} == {"DH": "1", "g": "2"}


def test_a_later_file_that_cannot_be_read_takes_no_answer_away() -> None:
    result = grade_one(payload(RIGHT_K, "answers:\n  K: F_v q1_dot\n"))
    assert _answers(result)["K"]["marks"] == "4"
    assert [line for line in result["set_aside"] if line.startswith("line 2 of part1.yaml")]


def test_of_several_files_a_line_says_which() -> None:
    from dynsolve.grading.teacher import unpack

    texts = ("answers:\n  K2: m1\n  Kenetic: 0\n", "symbols: {z: z}\nanswers:\n  K: 0\n  K2: m2\n  D: (\n")
    result = grade_one(payload(*texts))
    page = unpack(base64.b64decode(result["markdown"]))
    assert "It first went wrong at K2 (line 4 of part1.yaml)." in page
    assert "given 2 times, the last counts: line 2 of part0.yaml" in page
    assert "line 3 of part0.yaml: `Kenetic: 0`" in page
    assert "Line 5 of part1.yaml: " in page
    assert [(a["name"], a["line"], a["note"]) for a in result["answers"] if a["line"]] == [
        ("K2", 4, "line 4 of part1.yaml"),
        ("K", 3, "line 3 of part1.yaml"),
        ("D", 5, "line 5 of part1.yaml"),
    ]
    assert result["not_recognized"][0].startswith("line 3 of part0.yaml: ")
    assert result["faults"] and result["faults"][0].startswith("part1.yaml: z: ")
    assert result["faults"][0] in page


def test_of_one_file_a_line_is_enough() -> None:
    result = grade_one(payload("answers:\n  K2: m1\n"))
    assert next(a["note"] for a in result["answers"] if a["name"] == "K2") == ""


def test_following_from_nothing_earns_nothing_and_waits_for_a_human() -> None:
    found = _answers(grade_one(payload("answers:\n  K: 0\n  P: 0\n  L: 0\n  tau: [0, 0]\n")))
    tau = found["tau"]
    assert tau["loss"] == "it is what follows from L, where next to nothing is right"
    assert (tau["verdict"], tau["marks"]) == ("wrong", "0")


D = [["m1*lc1^2 + m2*(l1^2 + lc2^2 + 2*l1*lc2*cos(q2)) + I1 + I2", "m2*(lc2^2 + l1*lc2*cos(q2)) + I2"]]
D += [[D[0][1], "m2*lc2^2 + I2"]]
WHOLE = f"  D: [[{D[0][0]}, m1], [{D[1][0]}, {D[1][1]}]]\n"
UPPER = f"  d11: {D[0][0]}\n  d12: {D[0][1]}\n  d22: {D[1][1]}\n"
G2 = "m2*g*lc2*cos(q1 + q2)"


@pytest.mark.parametrize(
    ("marks", "text", "earned"),
    [
        ({"D": "4"}, WHOLE, {"D": "3"}),
        ({"D": "4"}, UPPER, {"D": "4"}),
        ({"D": "4"}, UPPER.replace(D[0][1], "m1"), {"D": "2"}),
        ({"D": "4"}, f"{UPPER}  d21: m1\n", {"D": "3"}),
        ({"D": "4"}, f"  d11: {D[0][0]}\n  d22: {D[1][1]}\n", {"D": "2"}),
        ({"D": "4"}, f"  d12: {D[0][1]}\n", {"D": "2"}),
        ({"D": "4"}, UPPER.replace(D[1][1], "x("), {"D": "3"}),
        ({"d11": "2", "d12": "1", "d21": "1"}, WHOLE, {"d11": "2", "d12": "0", "d21": "1"}),
        ({"d21": "2", "d22": "1"}, UPPER, {"d21": "2", "d22": "1"}),
        ({"g1": "2", "g2": "2"}, f"  g: [0, {G2}]\n", {"g1": "0", "g2": "2"}),
        ({"g": "2"}, f"  g2: {G2}\n", {"g": "1"}),
        ({"tau1": "2", "tau2": "2"}, "  tau: [x(, 0]\n", {"tau1": "0", "tau2": "0"}),
        ({"C11": "1", "C22": "1"}, "  C: [[m1*q1_dot, 0], [m2*l1*lc2*sin(q2)*q1_dot, 0]]\n",
         {"C11": "0", "C22": "1"}),
        ({"C": "4"}, "  C: [[m1*q1_dot, 0], [m2*l1*lc2*sin(q2)*q1_dot, 0]]\n", {"C": "2"}),
        ({"C": "4"}, "  C21: m2*l1*lc2*sin(q2)*q1_dot\n  C22: 0\n", {"C": "2"}),
        ({"H1": "16"}, "  H1: [[cos(q1), -sin(q1), 0, 0], [sin(q1), cos(q1), 0, l1*sin(q1)],"
         " [0, 0, 1, 0], [0, 0, 0, 1]]\n", {"H1": "14"}),
        ({"Jv1": "6"}, "  Jv1: [[-lc1*sin(q1), 1], [lc1*cos(q1), 0], [0, 0]]\n", {"Jv1": "5"}),
    ],
)  # fmt: skip
def test_marks_of_a_matrix_go_entry_by_entry_however_it_is_given(
    marks: dict[str, str], text: str, earned: dict[str, str]
) -> None:
    found = _answers(grade_one(payload(f"answers:\n{text}", problem="planar-2r", marks=marks)))
    assert {name: found[name]["marks"] for name in marks} == earned
    assert all(found[name]["of"] == of for name, of in marks.items())


def test_an_entry_of_a_matrix_that_follows_has_lost_what_the_matrix_has() -> None:
    text = "answers:\n  K: 0\n  P: 0\n  L: 0\n  tau: [0, 0]\n"
    found = _answers(grade_one(payload(text, marks={"tau1": "4", "f2": "2"})))
    assert (found["f2"]["verdict"], found["f2"]["marks"], found["f2"]["note"]) == (
        "wrong", "0", "an entry of tau",
    )  # fmt: skip
    assert found["f2"]["loss"] == found["tau"]["loss"]
    assert found["tau"]["loss"].startswith("it is what follows from L")


def test_the_same_wrong_value_has_one_form_however_it_is_written() -> None:
    one = _answers(grade_one(payload("answers:\n  K: m2*L2*theta1'^2 + m2*L2'^2\n")))
    two = _answers(grade_one(payload("answers:\n  K: m2*(L2_dot^2 + theta1_dot^2*L2)\n  P: x*m1\n")))
    other = _answers(grade_one(payload("answers:\n  K: 3*m2*L2_dot^2\n")))
    assert one["K"]["form"] == two["K"]["form"] != ""
    assert other["K"]["form"] not in ("", one["K"]["form"])


def test_the_page_says_nothing_of_marks_until_it_is_written() -> None:
    from dynsolve.grading.teacher import HEAD_HERE, unpack

    page = unpack(base64.b64decode(grade_one(payload(RIGHT_K))["html"]))
    assert page.count(HEAD_HERE) == 1 and "Marks:" not in page


def test_a_worker_is_replaced_when_it_goes_over_its_memory() -> None:
    worker = Worker(Bounds(20, 16 << 20))
    try:
        assert worker(payload(RIGHT_K))["reason"].startswith("reading it took more than 16 MiB of memory")
    finally:
        worker.end()


@pytest.mark.slow
def test_a_worker_that_takes_too_long_is_ended_and_the_next_hand_in_has_another() -> None:
    sums = [f"  K: (m1*L1 + m2*L2 + I1zz + g + theta1')^8 + {i}\n" for i in range(30)]
    worker = Worker(Bounds(0.01, 1 << 30))
    try:
        assert worker(payload(f"answers:\n{''.join(sums)}")) == {"reason": "reading it took more than 0.01 s"}
        worker.bounds = Bounds(20, 1 << 30)
        assert "result" in worker(payload(RIGHT_K))
    finally:
        worker.end()


def test_time_is_the_processors_so_that_no_verdict_depends_on_how_busy_the_machine_is() -> None:
    worker = Worker(Bounds(1, 1 << 30))
    try:
        assert "result" in worker(payload(RIGHT_K))
        process = worker.process
        assert process is not None
        os.kill(process.pid, signal.SIGSTOP)
        threading.Timer(2, os.kill, (process.pid, signal.SIGCONT)).start()
        assert "result" in worker(payload(RIGHT_K))
        assert worker.process is process
    finally:
        worker.end()


@pytest.mark.slow
def test_what_hangs_without_working_is_ended_by_the_clock(monkeypatch: pytest.MonkeyPatch) -> None:
    worker = Worker(Bounds())
    try:
        assert "result" in worker(payload(RIGHT_K))
        assert worker.process is not None
        os.kill(worker.process.pid, signal.SIGSTOP)
        waits = iter((1.0, 60.0))
        monkeypatch.setattr(pool_module, "patience", lambda seconds: next(waits))
        assert "result" in worker(payload(RIGHT_K))
    finally:
        worker.end()


@pytest.mark.slow
@pytest.mark.parametrize("names", [("P1", "P2", "K1"), ("K1", "K2")])
def test_answers_that_are_too_much_spoil_no_other(heavy: None, names: tuple[str, ...]) -> None:
    """Time without end stops the worker, and a failure; then each answer is tried by itself."""
    faults = dict.fromkeys(names, "this takes more than 0.25 s, or more memory than there is, to work out")
    faults["K1"] = "the program failed on it (ZeroDivisionError: no such thing)"
    worker = Worker(Bounds(2, 1 << 30))
    try:
        heavy_ones = "".join(f"  {name}: 0\n" for name in names)
        found = _answers(worker(payload(f"answers:\n{heavy_ones}{RIGHT_K[9:]}  g: [1, 0]\n"))["result"])
    finally:
        worker.end()
    assert {name: found[name]["fault"] for name in names} == faults
    assert {found[name]["verdict"] for name in names} == {"unreadable"}
    assert (found["K"]["verdict"], found["K"]["marks"]) == ("correct", "4")
    assert found["g"]["verdict"] == "wrong"


@pytest.mark.slow
def test_where_too_many_answers_are_too_much_all_of_the_hand_in_is(heavy: None) -> None:
    worker = Worker(Bounds(0.5, 1 << 30))
    text = "answers:\n" + "".join(f"  P1: {i}*m1\n" for i in range(20)) + RIGHT_K[9:]
    try:
        assert worker(payload(text)) == {"reason": "reading it took more than 0.5 s"}
    finally:
        worker.end()


def test_a_worker_that_is_killed_takes_no_verdict_with_it() -> None:
    worker = Worker(Bounds())
    try:
        first = worker(payload(RIGHT_TAU))
        assert worker.process is not None
        worker.process.kill()
        worker.process.wait()
        assert worker(payload(RIGHT_TAU)) == first
    finally:
        worker.end()


def test_a_worker_that_is_killed_again_and_again_is_not_the_hand_ins_fault(heavy: None) -> None:
    worker = Worker(Bounds())
    kills = 0

    def kill() -> None:
        nonlocal kills
        deadline = time.monotonic() + 20
        while kills < 3 and time.monotonic() < deadline:
            process = worker.process
            if process is not None:
                kills += 1
                process.kill()
                while worker.process is process:
                    time.sleep(0.01)

    thread = threading.Thread(target=kill)
    thread.start()
    try:
        found = worker(payload(f"{RIGHT_K}  P: 0\n"))
        thread.join()
        assert (kills, "result" in found, "over" in found["result"]) == (3, True, False)
    finally:
        worker.end()


def test_what_goes_over_its_memory_is_tried_twice_and_no_more(
    heavy: None, monkeypatch: pytest.MonkeyPatch
) -> None:
    worker, starts, start = Worker(Bounds()), [], Worker.start
    monkeypatch.setattr(Worker, "start", lambda self: (starts.append(1), start(self))[1])
    try:
        found = _answers(worker(payload("answers:\n  P2: 0\n"))["result"])
    finally:
        worker.end()
    assert (found["P2"]["verdict"], len(starts)) == ("unreadable", 2)


def test_a_worker_that_cannot_be_started_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "executable", "/nowhere/python")
    with pytest.raises(UsageError, match="a worker cannot be started: no such file"):
        Worker(Bounds())(payload(RIGHT_K))


def test_trying_answers_one_by_one_changes_nothing_where_none_is_too_much() -> None:
    text = "answers:\n  K: m2*L2*theta1'^2 + m2*L2'^2\n  P: 0\n  L: 0\n  tau: [0, 0]\n  D: [[1, x(], [0]]\n"
    assert grade_one(payload(text), answer_by_answer=20) == grade_one(payload(text))


def test_a_pool_gives_what_this_process_gives() -> None:
    pool = LocalPool(2, Bounds())
    try:
        futures = [pool.submit(payload(text)) for text in (RIGHT_K, RIGHT_TAU, "", "\0")]
        found = [future.result() for future in futures]
    finally:
        pool.close()
    assert found == [{"result": grade_one(payload(text))} for text in (RIGHT_K, RIGHT_TAU, "", "\0")]


PENDULUM = """title: Pendulum
gravity: [0, -g, 0]
dh: [{theta: theta1*, a: l}]
masses: [{mass: m, link: 1, name: NAME}]
"""


@pytest.mark.parametrize("name", ["1", "p", "p2"])
def test_a_cap_holds_for_a_body_by_any_name(name: str) -> None:
    """The energy of one body is the whole of it: a stage that is capped at 3 earns 3 for both, with D 4."""
    text = f"answers:\n  K{name}: m*l^2*theta1'^2/2\n  K: m*l^2*theta1'^2/2\n  D: [[m*l^2]]\n"
    more = {
        "problem": {"file": "pendulum.yaml", "text": PENDULUM.replace("NAME", f'"{name}"')},
        "marks": {f"K{name}": "3", "K": "3", "D": "1"},
        "policy": to_data(Policy(caps={"energy": Fraction(3)})),
    }
    answers = _answers(grade_one({**payload(text), **more}))
    assert {answer["verdict"] for answer in answers.values()} == {"correct"}
    for column in ("marks", "of"):
        assert sum(Fraction(answer[column]) for answer in answers.values()) == 4
