"""Text of Python programs in a hand-in: its formulas are read where nothing else answers, and none is run."""

from __future__ import annotations

import json

import pytest

from dynsolve.answers.reading.files import read_submission
from dynsolve.answers.verdict import Report
from tests.unit.answers.hands import checker, problem, verdicts

g = ["(m1*lc1 + m2*l1)*g*cos(q1) + m2*lc2*g*cos(q1 + q2)", "m2*lc2*g*cos(q1 + q2)"]
d11 = "m1*lc1**2 + m2*(l1**2 + lc2**2 + 2*l1*lc2*cos(q2)) + I1 + I2"
d12, d22 = "m2*(lc2**2 + l1*lc2*cos(q2)) + I2", "m2*lc2**2 + I2"
PROGRAMS = {
    "g": [
        f"Eq(g1, {g[0]})\nEq(g2, {g[1]})",
        f"display(sp.Eq(g1, {g[0]}))\ndisplay(sp.Eq(g2, {g[1]}))",
        f">>> g1 = {g[0]}\n>>> g2 = {g[1]}",
        f">>> g1\n{g[0]}\n>>> g2\n{g[1]}",
        f"In [3]: g1\nOut[3]: {g[0]}\n\nIn [4]: g2\nOut[4]: {g[1]}",
        f"In [3]: g1 = {g[0]}\nIn [4]: g2 = {g[1]}",
        f"g[0] = {g[0]}  # = dP/dq1\ng[1] = {g[1]}",
        f"g = Matrix([[{g[0]}], [{g[1]}]])",
        f"g = sp.Matrix([{g[0]},\n               {g[1]}])",
        f"g1 = sp.simplify({g[0]})\ng2 = expand({g[1]})",
    ],
    "D": [
        f"D = Matrix([[{d11}, {d12}], [{d12}, {d22}]])",
        f"D = zeros(2, 2)\nD[0,0] = {d11}\nD[0,1] = {d12}\nD[1,0] = {d12}\nD[1,1] = {d22}",
    ],
}  # fmt: skip
ROWS = [(name, program) for name, programs in PROGRAMS.items() for program in programs]


def notebook(*cells: tuple[str, str]) -> str:
    return json.dumps({"cells": [{"cell_type": kind, "source": text} for kind, text in cells]})


def judged(text: str, file: str) -> Report:
    return checker("planar-2r")(read_submission(problem("planar-2r"), text, file))


@pytest.mark.parametrize(("name", "program"), ROWS)
@pytest.mark.parametrize("file", ["r.txt", "r.md", "r.ipynb"])
def test_a_value_in_a_program(name: str, program: str, file: str) -> None:
    for text, verdict in ((program, "correct"), (program.replace("lc2", "l2"), "wrong")):
        text = {
            "r.txt": f"{text}\n",
            "r.md": f"# Result\n\n```python\n{text}\n```\n",
            "r.ipynb": notebook(("code", text)),
        }[file]
        if "zeros" not in program or file == "r.ipynb":
            assert verdicts(judged(text, file))[name] == verdict


@pytest.mark.parametrize("program", [
    f"g1 = 0\nfor i in range(2):\n    g1 += {g[0]}",
    f"g1 = m1*g*lc1*cos(q1)\ng1 = g1 + {g[1]}",
    f"g1 = m1*g*lc1*cos(q1)\ng1 += {g[1]}",
    f"def gravity():\n    g1 = {g[1]}",
    "g = 9.81",
    "g1 = kappa*sin(q1)",
    "g1 = __import__('os').getcwd()",
])  # fmt: skip
def test_what_may_be_no_result_waits(program: str) -> None:
    report = judged(notebook(("code", program)), "r.ipynb")
    assert set(verdicts(report).values()) == {"missing"}
    assert any(one.waits == ("g",) for one in report.not_recognized)


def test_what_the_text_gives_is_not_read_from_a_program_too() -> None:
    text = notebook(("code", f"g1 = {g[1]}"), ("markdown", f"$$g_1 = {g[0]}$$\n$$g_2 = {g[1]}$$"))
    report = judged(text, "r.ipynb")
    assert verdicts(report)["g"] == "correct" and not report.not_recognized
    assert [one.answers for one in report.set_aside] == [("g1",)]
