r"""Tables of Denavit-Hartenberg parameters in every form in which they are handed in.

All are the table of INF3480 (University of Oslo), exam 2018, task 2a; each is read, and right.
"""

from __future__ import annotations

import pytest

from dynsolve.answers.reading.files import FORMATS, read_submission
from dynsolve.answers.verdict import Submission
from tests.unit.answers.hands import checker, problem
from tests.unit.answers.reading.test_documents import document, needs_pandoc
from tests.unit.problem.test_drawing import OFFSET_ARM

ARM = OFFSET_ARM + "zero: drawn\n"

DRAWN = {
"no bars at the ends": ("a.md", """
i | a | alpha | d | theta
--|---|---|---|---
1 | 0 | -90 | L1 | theta1*
2 | L2 | −90 | Loff | theta2* - 90
3 | 0 | 0 | L3* | 0
"""),
"bars at the ends, a minus sign, a column of variables": ("a.md", """
| i | a_i | α_i | d_i | θ_i | variable |
|---|---|---|---|---|---|
| 1 | 0 | −90° | L₁ | θ₁* | θ₁ |
| 2 | L₂ | −π/2 | L_off | θ₂* − π/2 | θ₂ |
| 3 | 0 | 0° | L₃* | 0 | L₃ |
"""),
"variables said in words": ("a.md", """
| Link | θ | d | a | α |
|---|---|---|---|---|
| 1 | θ1 (variable) | L1 | 0 | -90° |
| 2 | θ2 - 90° (var) | Loff | L2 | -90° |
| 3 | 0 | L3 (variable) | 0 | 0 |
"""),
"formulas, bold heads": ("a.md", r"""
| **Link** | **$\theta_i$** | **$d_i$** | **$a_i$** | **$\alpha_i$** |
|:---:|:---:|:---:|:---:|:---:|
| 1 | $\theta_1^{*}$ | $L_1$ | $0$ | $-\frac{\pi}{2}$ |
| 2 | $\theta_2^{*}-\frac{\pi}{2}$ | $L_{off}$ | $L_2$ | $-\frac{\pi}{2}$ |
| 3 | $0$ | $L_3^{*}$ | $0$ | $0$ |
"""),
"units in the head": ("a.md", """
| # | θ (deg) | d [m] | a [m] | α (deg) |
|---|---|---|---|---|
| 1 | θ1* | L1 | 0 | -90 |
| 2 | θ2* - 90 | Loff | L2 | -90 |
| 3 | 0 | L3* | 0 | 0 |
"""),
"words in the head": ("a.md", """
| Link i | Joint angle θ_i | Link offset d_i | Link length a_i | Link twist α_i |
|---|---|---|---|---|
| 1 | θ1* | L1 | 0 | -90° |
| 2 | θ2* - 90° | Loff | L2 | -90° |
| 3 | 0 | L3* | 0 | 0 |
"""),
"on its side": ("a.md", """
| | 1 | 2 | 3 |
|---|---|---|---|
| θ | θ1* | θ2* - 90° | 0 |
| d | L1 | Loff | L3* |
| a | 0 | L2 | 0 |
| α | -90° | -90° | 0 |
"""),
"the four motions in the head": ("a.md", """
| Link | Rot z | Trans z | Trans x | Rot x |
|---|---|---|---|---|
| 1 | θ1* | L1 | 0 | -90° |
| 2 | θ2* - 90° | Loff | L2 | -90° |
| 3 | 0 | L3* | 0 | 0 |
"""),
"a page": ("a.html", """<html><body><table><tr><th>i</th><th>θ<sub>i</sub></th>
<th>d<sub>i</sub></th><th>a<sub>i</sub></th>
<th>α<sub>i</sub></th></tr>
<tr><td>1</td><td>θ<sub>1</sub>*</td><td>L<sub>1</sub></td><td>0</td><td>&minus;90°</td></tr>
<tr><td>2</td><td>θ<sub>2</sub>* &minus; 90°</td>
<td>L<sub>off</sub></td><td>L<sub>2</sub></td>
<td>-90&deg;</td></tr>
<tr><td>3</td><td>0</td><td>L<sub>3</sub>*</td><td>0</td><td>0</td></tr></table></body></html>"""),
"a page with paragraphs in its cells": ("a.html", """<table>
<caption>DH table</caption>
<thead>
<tr>
<th>i</th>
<th><p>a</p></th>
<th><p>alpha</p></th>
<th><p>d</p></th>
<th><p>theta</p></th>
</tr>
</thead>
<tbody>
<tr>
<td>1</td>
<td><p>0</p></td><td><p>-90</p></td><td><p>L1</p></td><td><p>theta1<sup>*</sup></p></td></tr>
<tr><td>2</td><td>L2</td><td>-90</td><td>Loff</td><td>theta2<sup>*</sup> - 90</td></tr>
<tr><td>3</td><td></td><td></td><td>L3<sup>*</sup></td><td></td></tr>
</tbody></table>"""),
"a page with formulas": ("a.html", r"""<table><tr><td>Link</td><td>\(a_i\)</td>
<td>\(\alpha_i\)</td><td>\(d_i\)</td>
<td>\(\theta_i\)</td></tr>
<tr><td>1</td><td>\(0\)</td><td>\(-90^\circ\)</td><td>\(L_1\)</td><td>\(\theta_1^*\)</td></tr>
<tr><td>2</td><td>\(L_2\)</td>
<td>\(-90^{\circ}\)</td><td>\(L_{off}\)</td>
<td>\(\theta_2^*-90^\circ\)</td></tr>
<tr><td>3</td><td>0</td><td>0</td><td>\(L_3^*\)</td><td>0</td></tr></table>"""),
"a page whose tags are not closed": ("a.html", """<table>
<tr><th>i<th>a<th>alpha<th>d<th>theta
<tr><td>1<td>0<td>-90<td>L1<td>theta1*
<tr><td>2<td>L2<td>-90<td>Loff<td>theta2* - 90
<tr><td>3<td>0<td>0<td>L3*<td>0</table>"""),
"a matrix with a head": ("a.tex", r"""
\[ \begin{pmatrix} \theta & d & a & \alpha \\
\theta_1 & L_1 & 0 & -90^\circ \\
\theta_2 - 90^\circ & L_{off} & L_2 & -90^\circ \\
0 & L_3 & 0 & 0 \end{pmatrix} \]
"""),
"a matrix": ("a.tex", r"""
\[ DH = \begin{pmatrix} \theta_1^* & L_1 & 0 & -\pi/2 \\
\theta_2^* - \frac{\pi}{2} & L_{off} & L_2 & -\frac{\pi}{2} \\
0 & L_3^* & 0 & 0 \end{pmatrix} \]
"""),
"a title over all columns": ("a.tex", r"""
\begin{tabular}{|l|l|l|l|l|}
\hline
\multicolumn{5}{|c|}{DH parameters} \\ \hline
Link & $a_i$ & $\alpha_i$ & $d_i$ & $\theta_i$ \\ \hline
1 & 0 & $-90\degree$ & $L_1$ & $\theta_1^{*}$ \\ \hline
2 & $L_2$ & $-90\degree$ & $L_{off}$ & $\theta_2^{*} - 90\degree$ \\ \hline
3 & 0 & 0 & $L_3^{*}$ & 0 \\ \hline
\end{tabular}
"""),
"degrees of siunitx": ("a.tex", r"""
\begin{tabular}{ccccc}
\textbf{Link} & $\boldsymbol{a_i}$ & $\boldsymbol{\alpha_i}$
& $\boldsymbol{d_i}$ & $\boldsymbol{\theta_i}$ \\ \midrule
1 & 0 & \ang{-90} & $L_1$ & $\theta_1^\ast$ \\
2 & $L_2$ & \SI{-90}{\degree} & $L_\mathrm{off}$ & $\theta_2^\ast - \SI{90}{\degree}$ \\
3 & 0 & 0 & $L_3^\ast$ & 0
\end{tabular}
"""),
"columns of text": ("a.txt", """
DH table:

i   theta         d     a    alpha
1   theta1*       L1    0    -90
2   theta2* - 90  Loff  L2   -90
3   0             L3*   0    0
"""),
"columns between tabs": ("a.txt", "i\ttheta\td\ta\talpha\n"
    "1\ttheta1*\tL1\t0\t-90\n2\ttheta2* - 90\tLoff\tL2\t-90\n3\t0\tL3*\t0\t0\n"),
"text as it was typed": ("a.md", """
```
i | a | alpha | d | theta
1 | 0 | -90 | L1 | theta1*
2 | L2 | -90 | Loff | theta2* - 90
3 | 0 | 0 | L3* | 0
```
"""),
"rows in brackets": ("a.md", "DH = [[theta1*, L1, 0, -90], [theta2* - 90, Loff, L2, -90], [0, L3*, 0, 0]]\n"),
"a star as text": ("a.tex", r"""
\begin{tabular}{|c|c|c|c|c|}
\hline
Joint & $\theta_i$ & $d_i$ & $a_i$ & $\alpha_i$ \\ \hline
1 & $\theta_1$ (var) & $L_1$ & $0$ & $-90^{\circ}$ \\ \hline
2 & $\theta_2$\textsuperscript{*}$-90^{\circ}$ & $L_{off}$ & $L_2$ & $-90^{\circ}$ \\ \hline
3 & $0^{\circ}$ & $L_3$ & $0$ & $0^{\circ}$ \\ \hline
\end{tabular}
"""),
"commas in a block of text": ("a.yaml", """answers:
  DH: |
    i, a, alpha, d, theta
    1, 0, -90, L1, theta1*
    2, L2, -90, Loff, theta2* - 90
    3, 0, 0, L3*, 0
"""),
"a table in a block of text": ("a.yaml", """answers:
  DH: |
    | i | a | alpha | d | theta |
    |---|---|---|---|---|
    | 1 | 0 | -90 | L1 | theta1* |
    | 2 | L2 | -90 | Loff | theta2* - 90 |
    | 3 | 0 | 0 | L3* | 0 |
"""),
"Greek keys": ("a.yaml", """answers:
  DH:
    - {θ: θ1*, d: L1, a: 0, α: -90°}
    - {θ: θ2* - 90°, d: Loff, a: L2, α: -90°}
    - {θ: 0, d: L3*, a: 0, α: 0}
"""),
"a key a column": ("a.yaml", """answers:
  DH:
    theta: [theta1*, theta2* - 90deg, 0]
    d: [L1, Loff, L3*]
    a: [0, L2, 0]
    alpha: [-90deg, -90deg, 0]
"""),
}  # fmt: skip


def verdict(found: Submission) -> str:
    """The verdict of the table, empty of none."""
    report = checker(ARM)(found)
    return next((str(answer.verdict) for answer in report.answers if answer.given), "")


@pytest.mark.parametrize(("file", "text"), DRAWN.values(), ids=DRAWN)
def test_a_table_is_read_however_it_is_set(file: str, text: str) -> None:
    found = read_submission(problem(ARM), text, file)
    assert verdict(found) == "correct"
    assert not found.not_recognized


@pytest.mark.parametrize(("file", "text"), DRAWN.values(), ids=DRAWN)
def test_a_slip_in_it_is_wrong(file: str, text: str) -> None:
    slipped = text.replace("off", "3")
    assert verdict(read_submission(problem(ARM), slipped, file)) == "wrong"


IN_MARKDOWN = ("bars at the ends, a minus sign, a column of variables", "formulas, bold heads", "on its side")


@needs_pandoc
@pytest.mark.parametrize("ending", FORMATS)
@pytest.mark.parametrize("name", IN_MARKDOWN)
def test_a_table_of_a_document_is_read(name: str, ending: str) -> None:
    found = read_submission(problem(ARM), document(DRAWN[name][1], ending), f"hand-in{ending}")
    assert verdict(found) == "correct"


NONE_OF_THESE = {
    "two lengths and a mass": "| mass | d | a |\n|---|---|---|\n| 1 | 2 | 3 |\n",
    "a sentence with its letters": "theta is the angle, d the offset, a a length, alpha a twist\nof i\n",
    "a head and nothing below": "i  theta  d  a  alpha\n\nas above\n",
}


@pytest.mark.parametrize("text", NONE_OF_THESE.values(), ids=NONE_OF_THESE)
def test_what_is_no_table(text: str) -> None:
    assert not read_submission(problem(ARM), text, "a.md").answers
