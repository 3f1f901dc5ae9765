r"""Denavit-Hartenberg tables as students draw them, in Markdown, LaTeX and YAML: all are one table."""

from __future__ import annotations

import pytest

from dynsolve.answers.reading.files import read_submission
from tests.unit.answers.hands import problem
from tests.unit.problem.test_drawing import OFFSET_ARM

READ_AS = "[[θ₁, L₁, 0, -90°], [θ₂ - 90°, Loff, L₂, -90°], [0, L₃, 0, 0]]"

WRITTEN = {
    "a table of Markdown, with another order": ("a.md", """
The table is

| Link | $a_i$ | $\\alpha_i$ | $d_i$ | $\\theta_i$ |
|------|-------|-----------|-------|-------------|
| 1 | 0 | $-90^\\circ$ | $L_1$ | $\\theta_1^*$ |
| 2 | $L_2$ | -90° | $L_{off}$ | $\\theta_2^* - 90^\\circ$ |
| 3 | 0 | 0 | $L_3^*$ | - |

and so on: $$r = L_3$$
"""),
    "a table of LaTeX": ("a.tex", r"""
\begin{table}\begin{tabular}{|c|c|c|c|c|}
\hline
Link & $\theta_i$ & $d_i$ & $a_i$ & $\alpha_i$ \\ \hline
1 & $\theta_1^\star$ & $L_1$ & 0 & $-90^\circ$ \\
2 & $\theta_2^\star - 90^\circ$ & $L_{off}$ & $L_2$ & $-90^\circ$ \\ \hline
3 & $0$ & $L_3^\star$ & -- & 0 \\ \hline
\end{tabular}\end{table}
"""),
    "an array": ("a.md", r"""
$$\begin{array}{c|cccc} i & \theta_i & d_i & a_i & \alpha_i \\ \hline 1 & \theta_1 & L_1 & 0 & -90^\circ \\
2 & \theta_2 - 90^\circ & L_{off} & L_2 & -90^\circ \\ 3 & 0 & L_3 & 0 & 0 \end{array}$$
"""),
    "rows as in a problem file": ("a.yaml", """
answers:
  DH:
    - {theta: theta1*, d: L1, alpha: -90deg}
    - {theta: theta2* - 90deg, d: Loff, a: L2, alpha: -90deg}
    - {d: L3*}
"""),
    "a head and numbers in YAML": ("a.yaml", """
answers:
  DH:
    - [i, a, alpha, d, theta]
    - [1, 0, -90deg, L1, theta1*]
    - [2, L2, -90deg, Loff, theta2* - 90deg]
    - [3, 0, 0, 'L3*', 0]
"""),
    "rows": ("a.yaml", """
answers:
  DH: [[theta1*, L1, 0, -90°], [theta2 - 90°, Loff, L2, -90°], [0, 'L3*', 0, 0]]
"""),
}  # fmt: skip


@pytest.mark.parametrize(("file", "text"), WRITTEN.values(), ids=WRITTEN)
def test_a_table_is_read_as_it_is_drawn(file: str, text: str) -> None:
    found = read_submission(problem(OFFSET_ARM + "zero: drawn\n"), text, file)
    (answer,) = [answer for answer in found.answers if answer.name == "DH"]
    assert answer.read_as == READ_AS
    assert not [one for one in found.not_recognized if "θ" in one.text or "theta" in one.text]


def test_the_place_of_a_cell_is_kept() -> None:
    text = WRITTEN["a table of LaTeX"][1].replace("$L_{off}$", "$L_{fof}$")
    found = read_submission(problem(OFFSET_ARM + "zero: drawn\n"), text, "a.tex")
    (answer,) = found.answers
    assert answer.node is None and answer.place.line == 6


def test_a_table_of_other_things_is_no_table_of_these() -> None:
    text = "| mass | d |\n|---|---|\n| 1 | 2 |\n| 2 | 3 |\n"
    assert not read_submission(problem("planar-2r"), text, "a.md").answers
