"""Entries that a sentence says are zero, beside those that are written."""

from __future__ import annotations

import time

import pytest

from dynsolve.answers.reading.files import read_submission
from dynsolve.answers.reading.matrix_parts import said_zero
from dynsolve.answers.reading.sources import Source
from tests.unit.answers.hands import checker, problem, verdicts

h = "m2*l1*lc2*sin(q2)"
C = [f"C11 = -{h}*qd2", f"C12 = -{h}*(qd1 + qd2)", f"C21 = {h}*qd1"]
c = [f"c121 = -{h}", f"c211 = -{h}", f"c221 = -{h}", f"c112 = {h}"]
SAYING = [
    "all other entries are zero", "All others are 0.", "the remaining entries vanish", "The rest are zero.",
    "alle übrigen sind 0", "alle anderen Einträge sind null", "die übrigen verschwinden", "sonst 0",
    "de andre er null", "resten er null", "alle andre er 0", "otherwise zero", "and zero otherwise",
    "all other $c_{ijk} = 0$",
]  # fmt: skip
SILENT = [
    "The other entries are not zero.", "all other entries are given above", "the others: see page 0.5",
    "alle andre er ikke null", "the gravity is zero here",
]  # fmt: skip


def judged(text: str) -> dict[str, str]:
    return verdicts(checker("planar-2r")(read_submission(problem("planar-2r"), text, "r.txt")))


@pytest.mark.parametrize("said", SAYING)
def test_the_others_are_zero(said: str) -> None:
    found = judged("\n".join([*C, said, ""]))
    assert found["C"] == found["C22"] == "correct"
    found = judged("\n".join([*c, said, ""]))
    assert {name: v for name, v in found.items() if name[0] == "c"} == dict.fromkeys(
        ("c111", "c112", "c121", "c122", "c211", "c221", "c222"), "correct"
    )


@pytest.mark.parametrize("between", [", ", "; "])
def test_said_behind_the_last_on_its_line(between: str) -> None:
    found = judged(between.join([*C, "all others are zero"]) + "\n")
    assert found["C"] == "correct" and found["C21"] == "correct"


def test_what_is_not_zero_is_wrong_and_what_is_mirrored_is_given() -> None:
    entries = "d11 = m1*lc1^2 + m2*(l1^2 + lc2^2 + 2*l1*lc2*cos(q2)) + I1 + I2\nd12 = m2*lc2^2 + I2\n"
    found = judged(f"{entries}all others are zero\n")
    assert found["d22"] == "wrong" and "d21" not in found


@pytest.mark.parametrize("said", SILENT)
def test_what_says_nothing_of_the_others(said: str) -> None:
    assert judged("\n".join([*C, said, ""]))["C"] == "missing"


def test_what_is_said_before_or_of_a_whole_matrix_is_not_counted() -> None:
    assert judged("\n".join(["all others are zero", *C, ""]))["C"] == "missing"
    assert "C22" not in judged("\n".join([*C, "g = [0; m2*g]", "all others are zero", ""]))


@pytest.mark.parametrize(
    "text", ["all other " * 20_000, "the " * 50_000, "zero " * 40_000, "other" + " " * 200_000]
)
def test_a_long_text_costs_no_more_than_its_length(text: str) -> None:
    def cost(part: str) -> float:
        spent = []
        for _ in range(3):  # beside other programs a processor is slow for a moment
            begin = time.process_time()
            list(said_zero(Source(part), part))
            spent.append(time.process_time() - begin)
        return min(spent)

    assert cost(text) < 3 * cost(text[: len(text) // 2]) + 0.05, "twice the text takes twice the time"
