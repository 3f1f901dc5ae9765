"""The work on one hand-in: marks, losses, several files; and the bounds it stands under."""

from __future__ import annotations

import base64
from typing import Any

from dynsolve.grading.policy import Policy, to_data
from dynsolve.grading.pool import Bounds, LocalPool, Worker
from dynsolve.grading.work import grade_one
from dynsolve.library import find

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


def test_following_from_nothing_earns_half_and_waits_for_a_human() -> None:
    found = _answers(grade_one(payload("answers:\n  K: 0\n  P: 0\n  L: 0\n  tau: [0, 0]\n")))
    tau = found["tau"]
    assert tau["loss"] == "body 2 is lost on the way"
    assert (tau["verdict"], tau["marks"]) == ("follows", "3")


def test_the_same_wrong_value_has_one_form_however_it_is_written() -> None:
    one = _answers(grade_one(payload("answers:\n  K: m2*L2*theta1'^2 + m2*L2'^2\n")))
    two = _answers(grade_one(payload("answers:\n  K: m2*(L2_dot^2 + theta1_dot^2*L2)\n  P: x*m1\n")))
    other = _answers(grade_one(payload("answers:\n  K: 3*m2*L2_dot^2\n")))
    assert one["K"]["form"] == two["K"]["form"] != ""
    assert other["K"]["form"] not in ("", one["K"]["form"])


def test_the_page_says_nothing_of_marks_until_it_is_written() -> None:
    from dynsolve.grading.pages import MARKS_HERE, unpack

    page = unpack(base64.b64decode(grade_one(payload(RIGHT_K))["html"]))
    assert page.count(MARKS_HERE) == 1 and "Marks:" not in page


def test_a_worker_is_replaced_when_it_goes_over_its_memory() -> None:
    worker = Worker(Bounds(20, 16 << 20))
    try:
        assert worker(payload(RIGHT_K))["reason"].startswith("reading it took more than 16 MiB of memory")
    finally:
        worker.end()


def test_a_worker_that_takes_too_long_is_ended_and_the_next_hand_in_has_another() -> None:
    worker = Worker(Bounds(0.05, 1 << 30))
    try:
        assert worker(payload(RIGHT_K)) == {"reason": "reading it took more than 0.05 s"}
        worker.bounds = Bounds(20, 1 << 30)
        assert "result" in worker(payload(RIGHT_K))
    finally:
        worker.end()


def test_a_pool_gives_what_this_process_gives() -> None:
    pool = LocalPool(2, Bounds())
    try:
        futures = [pool.submit(payload(text)) for text in (RIGHT_K, RIGHT_TAU, "", "\0")]
        found = [future.result() for future in futures]
    finally:
        pool.close()
    assert found == [{"result": grade_one(payload(text))} for text in (RIGHT_K, RIGHT_TAU, "", "\0")]
