"""Formulas in two dimensions, as SymPy 1.14 prints them, and matrices as they are drawn by hand."""

from __future__ import annotations

import time

import pytest

from dynsolve.answers.reading.plain_text import one_line
from tests.unit.answers.hands import checker, verdicts
from tests.unit.answers.reading.submissions import report

UNICODE = """
K =
     2   ⎛            2⎞   2
m₂⋅L₂̇    ⎝I1zz + m₂⋅L₂ ⎠⋅θ₁̇
────── + ───────────────────
  2               2

f2 =
               2
- L₂⋅m₂⋅θ_1_dot  + L_2_ḋ⋅m₂

D =
⎡         2       ⎤
⎢I1zz + L₂ ⋅m₂  0 ⎥
⎢                 ⎥
⎣      0        m₂⎦
C =
⎡L₂⋅L_2_dot⋅m₂   L₂⋅m₂⋅θ_1_dot⎤
⎢                             ⎥
⎣-L₂⋅m₂⋅θ_1_dot        0      ⎦
"""
ASCII = r"""
K =

      2                2 /         2   \
L2_dot *m2   theta1_dot *\I1zz + L2 *m2/
---------- + ---------------------------
    2                     2

                       2
f2 = - L2*m2*theta1_dot  + L2_ddot*m2

        | I1zz + m2*L2^2   0  |
D(q) =  |                     |
        |       0          m2 |

        | m2*L2*L2_dot      m2*L2*theta1_dot |
C(q,qd)=|                                    |
        | -m2*L2*theta1_dot        0         |
"""
OF_TIME = """
f2 =
                      2       2
           ⎛d        ⎞       d
- m₂⋅L₂(t)⋅⎜──(θ₁(t))⎟  + m₂⋅───(L₂(t))
           ⎝dt       ⎠         2
                             dt
"""


def judged(text: str, file: str = "report.txt") -> dict[str, str]:
    return verdicts(checker("in3140-rp")(report(text, file, "in3140-rp")))


@pytest.mark.parametrize("drawn", [UNICODE, ASCII])
@pytest.mark.parametrize(("file", "fence"), [("report.txt", "{}"), ("report.md", "```\n{}\n```")])
def test_what_is_drawn_is_read(drawn: str, file: str, fence: str) -> None:
    found = judged(fence.format(drawn), file)
    assert {name: found[name] for name in ("K", "f2", "D", "C")} == dict.fromkeys(
        ("K", "f2", "D", "C"), "correct"
    )


@pytest.mark.parametrize(
    "drawn",
    [
        "D = [ I1zz + m2*L2^2   0  ]\n    [       0          m2 ]",
        "D =\n( I1zz + m2*L2^2   0  )\n(       0          m2 )",
        "                [      2            ]\n                [ m2 L2  + I1zz  0  ]\n"
        "(%o3)       D = [                   ]\n                [       0        m2 ]",
        "           2\nd11 = m2*L2  + I1zz\nd12 = 0\nd21 = 0\nd22 = m2",
        "            2\nd11 = m2*L2  + I1zz\nd12 = 0\nd21 = 0\nd22 = m2",
    ],
)
def test_a_matrix_in_brackets_over_its_lines(drawn: str) -> None:
    right, wrong = judged(f"{drawn}\n"), judged(f"{drawn}\n".replace("I1zz", "2*m2"))
    assert (right["D"], wrong["D"]) == ("correct", "wrong")


@pytest.mark.parametrize("drawn", [UNICODE, ASCII])
def test_a_slip_in_it_is_seen(drawn: str) -> None:
    found = judged(drawn.replace("I1zz +", "I1zz -"))
    assert {name: found[name] for name in ("K", "f2", "D", "C")} == {
        "K": "wrong", "f2": "correct", "D": "follows", "C": "correct"
    }  # fmt: skip


def test_derivatives_are_fractions() -> None:
    assert judged(OF_TIME)["f2"] == "correct"
    assert judged(OF_TIME.replace("⎟  +", "⎟  -"))["f2"] == "wrong"


@pytest.mark.parametrize(
    "prose",
    [
        "Results\n-------\nK = m*q",
        "| a | b |\n|---|---|\n| c = 1 | d |",
        "a = b\n 2",
        "x = /\\\n\\/\n",
        "1\n2\n3 = 4",
    ],
)
def test_what_is_no_drawing_is_left_alone(prose: str) -> None:
    assert one_line(prose, lambda name: len(name) < 3) in ("", "3 = 4")


@pytest.mark.parametrize(
    "hostile",
    [
        "⎛" * 9_000 + "\n" + "⎝" * 9_000,
        "-" * 9_000 + "\na\n" + "-" * 9_000,
        "/\\" * 4_000 + "\n 2 \n=",
        "─\n" * 9_000,
    ],
)
def test_a_drawing_without_end_costs_little(hostile: str) -> None:
    started = time.process_time()
    one_line("K =\n" + hostile, bool)
    assert time.process_time() - started < 2
