r"""Names of a problem that books, commands or the student use for something else: \ell, φ_1, Θ_1, M."""

from __future__ import annotations

import pytest

from dynsolve.answers.judge import Checker
from dynsolve.answers.reading.files import read_submission
from dynsolve.problem import read_problem

ARM = """
gravity: [0, 0, -g]
model:
  coordinates: {q1: revolute, q2: revolute}
  D: [[M*ell^2, m*ell^2*cos(q2)], [m*ell^2*cos(q2), m*ell^2]]
  P: m*g*ell*sin(q2)
find: [K, P, L, tau, D, C, g]
"""
CHECKERS = {
    letter: Checker(read_problem(ARM.replace("q1", f"{letter}1").replace("q2", f"{letter}2")))
    for letter in ("q", "phi", "alpha")
}
COMMANDS = {"q": "q", "phi": r"\varphi", "alpha": r"\alpha"}
D = r"\begin{{pmatrix}}{0}\ell^2&m\ell^2\cos Q_2\\m\ell^2\cos Q_2&m\ell^2\end{{pmatrix}}"
K = r"\frac12 {0}\ell^2\dot Q_1^2+m\ell^2\cos Q_2\dot Q_1\dot Q_2+\frac12 m\ell^2\dot Q_2^2"
TAU = r"$$\tau_1={0}\ell^2\ddot Q_1+m\ell^2\cos Q_2\ddot Q_2-m\ell^2\sin Q_2\dot Q_2^2$$"
TAU += "\n\n" + r"$$\tau_2=m\ell^2\cos Q_2\ddot Q_1+m\ell^2\ddot Q_2+mg\ell\cos Q_2.$$"
G = r"$$g=\begin{pmatrix}0\\mg\ell\cos Q_2\end{pmatrix}$$"


def verdicts(text: str, letter: str = "q") -> dict[str, str]:
    judge = CHECKERS[letter]
    text = text.replace("Q", COMMANDS[letter])
    report = judge(read_submission(judge.problem, text, "report.md"))
    return {answer.name: answer.verdict.value for answer in report.answers}


@pytest.mark.parametrize("letter", CHECKERS)
@pytest.mark.parametrize("form", [
    "$$P=mg{0}\\sin Q_2.$$", "$$P={0}\\,mg\\sin{{Q_{{2}}}},$$",
])  # fmt: skip
def test_a_command_is_the_parameter_that_is_spelled_so(letter: str, form: str) -> None:
    for length, expected in ((r"\ell", "correct"), (r"\ell^2", "wrong"), ("ℓ", "correct")):
        assert verdicts(form.format(length), letter)["P"] == expected


@pytest.mark.parametrize("letter", ["phi", "alpha"])
@pytest.mark.parametrize("rate", [
    r"\frac{d Q_#}{dt}", r"\frac{\mathrm d Q_#}{\mathrm dt}", r"\frac{d}{dt}Q_#",
])  # fmt: skip
def test_the_rate_of_a_coordinate_is_no_entry_of_g(letter: str, rate: str) -> None:
    for mass, expected in (("M", "correct"), ("2M", "wrong")):
        text = K.format(mass)
        for index in "12":
            written = rate.replace("#", index)
            text = text.replace(rf"\dot Q_{index}^2", rf"\left({written}\right)^2")
            text = text.replace(rf"\dot Q_{index}", written)
        assert verdicts(f"$$K={text}$$", letter)["K"] == expected


@pytest.mark.parametrize("letter", CHECKERS)
@pytest.mark.parametrize("arguments", ["Q", r"\boldsymbol{Q}", "Q_1,Q_2"])
def test_the_coordinates_of_a_function_are_read_off(letter: str, arguments: str) -> None:
    for mass, expected in (("M", "correct"), ("2M", "wrong")):
        assert verdicts(f"$$M({arguments})={D.format(mass)}$$", letter)["D"] == expected
        model = rf"$$M(Q)\ddot Q+C(Q,\dot Q)\dot Q+g({arguments})=\tau$$"
        whole = f"$$M({arguments})={D.format(mass)}$$\n\n{G.replace('g=', f'g({arguments})=')}\n\n{model}"
        found = verdicts(whole, letter)
        assert (found["D"], found["g"]) == (expected, "correct")


def test_a_number_among_the_arguments_is_one_configuration() -> None:
    text = f"$$M={D.format('M')}$$\n\n$$M(Q_1,0)={D.format('M').replace('cos Q_2', 'cos 0')}$$"
    assert verdicts(text)["D"] == "correct"


@pytest.mark.parametrize("heading", ["First attempt (wrong):", "Første forsøk (feil):"])
@pytest.mark.parametrize("struck", ["~~$K=0$~~", "~~$$K=0$$~~"])
def test_what_is_struck_out_takes_nothing_else_back(heading: str, struck: str) -> None:
    for mass, expected in (("M", "correct"), ("2M", "wrong")):
        assert verdicts(f"{heading}\n\n{struck}\n\n$$K={K.format(mass)}$$")["K"] == expected


@pytest.mark.parametrize("matrix", ["M", "M(q)", r"\underline{M}"])
@pytest.mark.parametrize("row", [r"\dot q^T", r"\dot{q}^{\top}"])
def test_the_matrix_of_a_quadratic_form_is_no_mass(matrix: str, row: str) -> None:
    form = "$$K={}$$\n\n$${}={}$$\n\n$$K=\\frac12{}{}\\dot q$$"
    for mass, expected in (("M", "correct"), ("2M", "wrong")):
        text = form.format(K.format(mass), matrix, D.format("M"), row, matrix)
        assert verdicts(text)["K"] == expected


@pytest.mark.parametrize("letter", ["Q_1", "M_1", "L_2"])
@pytest.mark.parametrize("form", ["$${0}={1}$$\n\n{2}", "{2}\nwhere ${0}={1}$.", "- ${0}={1}$\n\n{2}"])
def test_case_counts_where_the_report_defines_a_name(letter: str, form: str) -> None:
    """Theta_1 beside theta1: a constant, and no coordinate."""
    judge = Checker(read_problem(ARM.replace("M*", "m1*").replace("ell", "l2")))
    for value, expected in (("m_1l_2^2", "correct"), ("2m_1l_2^2", "wrong")):
        matrix = D.replace(r"{0}\ell^2", letter).replace(r"\ell", "l_2").replace("Q_2", "q_2").format("")
        text = form.format(letter, value, f"$$D={matrix}$$")
        report = judge(read_submission(judge.problem, text, "report.md"))
        assert {a.name: a.verdict.value for a in report.answers}["D"] == expected


LATER = [
    r"$$\tau_2\big|_{\dot q=\ddot q=0}=5mg$$", r"$$\tau=D(\ddot q_d+K_d\dot e+K_p e)+C\dot q+g$$",
    r"$$\tau=D\ddot q_{d}+K_p(q_{d}-q)$$",
]  # fmt: skip


@pytest.mark.parametrize("later", LATER)
def test_an_unread_line_holds_nothing_back_where_its_quantity_is_read(later: str) -> None:
    for mass, expected in (("M", "correct"), ("2M", "wrong")):
        text = f"{TAU.format('M')}\n\n$$D={D.format(mass)}$$\n\n{later}"
        found = verdicts(text)
        assert (found["tau"], found["D"]) == ("correct", expected)


@pytest.mark.parametrize("later", LATER[1:])
def test_a_control_law_takes_the_place_of_no_torque(later: str) -> None:
    C = r"$$C=\begin{pmatrix}0&-m\ell^2\sin Q_2\dot Q_2\\0&0\end{pmatrix}$$"
    for mass, expected in (("M", "correct"), ("2M", "follows")):
        text = f"$$D={D.format(mass)}$$\n\n{C}\n\n{G}\n\n$$\\tau=D\\ddot q+C\\dot q+g$$\n\n{later}"
        assert verdicts(text)["tau"] == expected


@pytest.mark.parametrize("words", [
    "Comparing coefficients,", "By comparison", "Durch Vergleich der Koeffizienten", "Ved sammenligning",
    "Vergleich der Faktoren:", "Sammenligner vi leddene:",
])  # fmt: skip
def test_a_comparison_of_coefficients_is_no_case(words: str) -> None:
    for mass, expected in (("M", "correct"), ("2M", "wrong")):
        assert verdicts(f"{words}\n\n$$D={D.format(mass)}$$")["D"] == expected


def test_a_definition_that_is_used_waits_for_nothing() -> None:
    text = "$$\\varphi := q_1+q_2$$\n\n$$P=mg\\ell\\sin(\\varphi-q_1)$$"
    judge = CHECKERS["q"]
    report = judge(read_submission(judge.problem, text, "report.md"))
    assert not report.not_recognized
    assert {a.name: a.verdict.value for a in report.answers}["P"] == "correct"


@pytest.mark.parametrize("letters", ["TV", "KP", "TU"])
def test_energies_that_braces_name_in_the_lagrangian(letters: str) -> None:
    form = r"$$L=\underbrace{%s}_{%s}-\underbrace{%s}_%s$$"
    for mass, expected in (("M", "correct"), ("2M", "wrong")):
        found = verdicts(form % (K.format(mass), letters[0], r"mg\ell\sin Q_2", letters[1]))
        assert (found["K"], found["P"]) == (expected, "correct")


def test_a_potential_energy_called_u_has_a_zero_of_its_height() -> None:
    for sine, expected in (("sin", "correct"), ("cos", "wrong")):
        assert verdicts(rf"$$u=mg\ell\{sine} Q_2+P_0$$")["P"] == expected


SPRINGS = """
gravity: none
model:
  coordinates: {p: prismatic, d: prismatic}
  bodies: [{mass: m, at: [p, 0, 0]}, {mass: m, at: [d, 0, 0]}]
springs: [{stiffness: k, of: p}, {stiffness: c, of: d - p, rest: l}]
find: [K, P, L, tau, D, g]
"""
MODEL = "D = [m 0; 0 m]\ng = [k p - c (d-p-l); c (d-p-l)]\n"
OF_SPRINGS = """{K} = 1/2 m (p'^2 + d'^2)
{P} = 1/2 k p^2 + 1/2 c (d - p - l)^2
"""


@pytest.mark.parametrize(("letters", "ending"), [("KP", "txt"), ("KV", "txt"), ("TU", "txt"), ("KP", "yaml")])
@pytest.mark.parametrize(("sign", "expected"), [("-", "correct"), ("+", "wrong")])
def test_a_letter_that_was_handed_in_is_no_symbol_in_another_case(
    letters: str, ending: str, sign: str, expected: str
) -> None:
    """K is not the stiffness k, P not the coordinate p, D not the coordinate d."""
    K, P = letters
    energies, L = OF_SPRINGS.format(K=K, P=P), f"L = {K} {sign} {P}\n"
    for before in (energies + L, L + energies):
        text = f"{before}{MODEL}tau = D q'' + g\n"
        if ending == "yaml":
            text = "answers:\n  " + text.replace(" = ", ": ").replace("\n", "\n  ") + "\n"
        judge = Checker(read_problem(SPRINGS))
        found = judge(read_submission(judge.problem, text, f"answers.{ending}"))
        wanted = {**dict.fromkeys(("K", "P", "D", "g", "tau"), "correct"), "L": expected}
        assert {answer.name: answer.verdict.value for answer in found.answers} == wanted


MATRIX = r"\begin{pmatrix}M\ell^2&m\ell^2\cos Q_2\\m\ell^2\cos Q_2&m\ell^2\end{pmatrix}"
CORIOLIS = r"$$C=\begin{pmatrix}0&-m\ell^2\sin Q_2\dot Q_2\\0&0\end{pmatrix}$$"


@pytest.mark.parametrize("letter", CHECKERS)
@pytest.mark.parametrize("arguments", ["", "(q)"])
@pytest.mark.parametrize("font", ["M", r"\mathbf M", r"\boldsymbol{M}"])
def test_the_matrix_of_a_hand_in_stands_before_accelerations(letter: str, arguments: str, font: str) -> None:
    """M is a mass in the problem, and in its entries."""
    model = f"$${font}{arguments}={MATRIX}$$\n\n{CORIOLIS}\n\n{G}"
    motion = rf"$$\tau={font}\ddot{{\mathbf q}}+C\dot{{\mathbf q}}+g$$"
    for text in (f"{model}\n\n{motion}", f"{motion}\n\n{model}"):
        assert [verdicts(text, letter)[name] for name in ("D", "C", "g", "tau")] == ["correct"] * 4


def test_a_mass_stands_before_accelerations_where_the_matrix_has_another_letter() -> None:
    judge = Checker(read_problem(SPRINGS))
    for mass, expected in (("m", "correct"), ("k", "wrong")):
        text = f"{MODEL}tau = {mass} q'' + g\n"
        found = judge(read_submission(judge.problem, text, "answers.txt"))
        assert {a.name: a.verdict.value for a in found.answers}["tau"] == expected
