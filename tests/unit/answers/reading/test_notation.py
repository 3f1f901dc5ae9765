r"""One thing written in many ways: what stands before, above and behind a name or a value changes neither."""

from __future__ import annotations

import pytest

from dynsolve.answers.reading.files import read_submission
from dynsolve.problem.reader import find
from tests.unit.answers.hands import checker, verdicts
from tests.unit.answers.reading.submissions import report

g1 = r"(m_1 l_{c1} + m_2 l_1) g \cos q_1 + m_2 l_{c2} g \cos(q_1 + q_2)"
g2 = r"m_2 l_{c2} g \cos(q_1 + q_2)"
P = "m1*g*lc1*sin(q1) + m2*g*(l1*sin(q1) + lc2*sin(q1 + q2))"
tau2 = (
    r"(m_2 l_{c2}^2 + I_2)(\ddot q_1 + \ddot q_2) + m_2 l_1 l_{c2} (\cos q_2 \ddot q_1 + \sin q_2 \dot q_1^2)"
    rf" + {g2}"
)
tau1 = (
    r"(m_1 l_{c1}^2 + m_2 l_1^2 + I_1) \ddot q_1 + m_2 l_1 l_{c2} \cos q_2 (2 \ddot q_1 + \ddot q_2)"
    r" - m_2 l_1 l_{c2} \sin q_2 (2 \dot q_1 \dot q_2 + \dot q_2^2)"
    rf" + (m_2 l_{{c2}}^2 + I_2)(\ddot q_1 + \ddot q_2) + {g1}"
)
ONE = """model:
  coordinates: {q: revolute}
  bodies: [{mass: m, at: [lc*cos(q), lc*sin(q), 0], turn: q, about: [0, 0, 1], inertia: {zz: I}}]
gravity: [0, -g, 0]
"""
ARM = find("planar-2r").read_text(encoding="utf-8").replace("find: [", "find: [A1, H1, ")
CRANE = """model:
  coordinates: {psi: revolute, theta: revolute, s: prismatic}
  bodies:
    - {mass: 0, at: [0, 0, 0], turn: psi, about: [0, 0, 1], inertia: {zz: J}}
    - {mass: m, at: [s*cos(theta)*cos(psi), s*cos(theta)*sin(psi), s*sin(theta)]}
gravity: [0, 0, -g]
find: [tau]
"""


def judged(text: str, file: str = "report.md", stem: str = "planar-2r") -> dict[str, str]:
    return verdicts(checker(stem)(report(text, file, stem)))


def own(problem: str, text: str, file: str) -> dict[str, str]:
    check = checker(problem)
    return verdicts(check(read_submission(check.problem, text, file)))


def right_and_wrong(name: str, text: str, slip: tuple[str, str], file: str = "report.md") -> tuple[str, str]:
    assert slip[0] in text
    return judged(text, file)[name], judged(text.replace(*slip), file)[name]


BEHIND = [
    r"\quad [\mathrm{N\,m}]", r"\;\left[\frac{\mathrm{kg\,m^2}}{\mathrm{s}^2}\right]", r"\ (\text{Nm})",
    r"\text{kg m}^2", r"\,\text{kg m}^{2}\text{s}^{-2}", r"\text{ kg m}^2/\text{s}^2", r"\text{m}^2",
    r"~\mathrm{N\,m}", r"\ \text{N}\cdot\text{m}", r"\ [\si{N m}]", r"\quad\mathrm{in\ N\,m}",
    r"\neq g_1", "≠ 0", r"\in ℝ", r"\ \forall\, q_1", r"\text{ for all } q", r"\quad\text{für alle } q",
]  # fmt: skip


@pytest.mark.parametrize("behind", BEHIND)
def test_what_is_said_behind_a_value(behind: str) -> None:
    text = f"$$g_2 = {g2} {behind}$$"
    assert right_and_wrong("g2", text, (r"\cos", r"\sin")) == ("correct", "wrong")


@pytest.mark.parametrize("behind", [
    "in Nm", "(in Nm)", "[N m]", "(Nm)", "[kg m^2/s^2]", "N*m", "[N·m]", "for all q", "für alle q1",
    "  (qd = q1_dot, qe = q2_dot)",
])  # fmt: skip
def test_what_is_said_behind_a_value_in_plain_text(behind: str) -> None:
    text = f"g2 = m2*lc2*g*cos(q1 + q2) {behind}\n"
    assert right_and_wrong("g2", text, ("cos", "sin"), "report.txt") == ("correct", "wrong")


def test_a_letter_of_a_unit_that_is_a_symbol_of_the_problem() -> None:
    assert own(ONE.replace("lc*", "s*"), "g1 = g*cos(q1)*m*s\n", "report.txt")["g1"] == "correct"


@pytest.mark.parametrize("name", [
    "S_2", "C_2", "L_2", "G_2", "s_2", r"\tau^{(2)}", r"\sum M_2", "∑ M_2", "Q_2^{nc}", r"\tau_2^{ext}",
])  # fmt: skip
def test_what_a_value_with_accelerations_is(name: str) -> None:
    text = f"$${name} = {tau2}$$"
    assert right_and_wrong("tau2", text, ("+ I_2", "- I_2")) == ("correct", "wrong")


@pytest.mark.parametrize("name", ["Q", "Q^{nc}", r"\tau^{ext}"])
def test_a_column_with_accelerations(name: str) -> None:
    text = rf"$${name} = \begin{{bmatrix}} {tau1} \\ {tau2} \end{{bmatrix}}$$"
    assert right_and_wrong("tau", text, ("+ I_2", "- I_2")) == ("correct", "wrong")


@pytest.mark.parametrize("gradient", [r"\nabla P", r"\nabla_q V", r"∇P", r"g = \nabla P"])
def test_the_gradient_of_the_potential_energy(gradient: str) -> None:
    text = rf"$${gradient} = \begin{{bmatrix}} {g1} \\ {g2} \end{{bmatrix}}$$"
    assert right_and_wrong("g", text, ("m_2 l_1", "m_1 l_1")) == ("correct", "wrong")


@pytest.mark.parametrize(("left", "factor"), [("2P", "2"), (r"2\cdot P", "2"), ("3 P", "3")])
def test_a_factor_on_the_left(left: str, factor: str) -> None:
    text = rf"$${left} = {factor} ({P.replace('*', ' ')})$$".replace("lc", "l_c").replace("sin", r"\sin")
    assert right_and_wrong("P", text, ("l1", "l2")) == ("correct", "wrong")


@pytest.mark.parametrize("words", [
    "Potential energy", "The potential energy", "Total potential energy", "Potenzielle Energie",
    "Die gesamte potentielle Energie", "Den potensielle energien", "- Potensiell energi",
    "2. Potential energy",
])  # fmt: skip
@pytest.mark.parametrize("sign", [" =", ":"])
def test_a_name_in_words(words: str, sign: str) -> None:
    text = f"{words}{sign} {P}\n"
    assert right_and_wrong("P", text, ("lc2", "l2"), "report.txt") == ("correct", "wrong")


def test_words_before_what_is_no_formula() -> None:
    assert judged(f"Potential energy: the sum of both\nU = {P}\n", "report.txt")["P"] == "correct"


@pytest.mark.parametrize("value", [
    rf"\left|\begin{{matrix}} {g1} \\ {g2} \end{{matrix}}\right|", rf"\left| {g1}, {g2} \right|^T",
    rf"\left. \begin{{bmatrix}} {g1} \\ {g2} \end{{bmatrix}} \right|",
])  # fmt: skip
def test_bars_around_a_matrix(value: str) -> None:
    assert right_and_wrong("g", f"$$g = {value}$$", ("m_2 l_1", "m_1 l_1")) == ("correct", "wrong")


@pytest.mark.parametrize("zero", [r"0_{2\times 1}", r"\mathbf{0}_{2\times1}", r"\mathbf 0_2"])
def test_zeros_of_a_size(zero: str) -> None:
    assert judged(f"$$g = {zero}$$", stem="in3140-rp")["g"] == "correct"


@pytest.mark.parametrize("rate", ["q1˙", r"\dot{q}_1", "q˙_1"])
def test_dots_as_characters_behind_their_letter(rate: str) -> None:
    K1 = f"$$K_1 = (m_1 l_{{c1}}^2 + I_1) {rate}^2/2$$"
    assert right_and_wrong("K1", K1, ("+ I_1", "- I_1")) == ("correct", "wrong")


@pytest.mark.parametrize("rate", [r"(\dot q_1 + \dot q_2)\dot{}", r"(q_1 + q_2)\ddot{}"])
def test_dots_behind_a_parenthesis(rate: str) -> None:
    text = f"$$\\tau_2 = {tau2}$$".replace(r"(\ddot q_1 + \ddot q_2)", rate)
    assert right_and_wrong("tau2", text, (rate, rate.replace("+", "-"))) == ("correct", "wrong")


@pytest.mark.parametrize("text", [
    "tau = (I + m*lc^2) q̈ + m*g*lc*cos q\n", "tau = (I + m*lc^2)*qddot + m*g*lc*cos(q)\n",
])  # fmt: skip
def test_one_joint_needs_no_index(text: str) -> None:
    problem = ONE.replace("q:", "theta1:").replace("(q)", "(theta1)").replace("turn: q", "turn: theta1")
    right, wrong = (own(problem, one, "report.txt") for one in (text, text.replace("cos", "sin")))
    assert right.get("tau1", right.get("tau")) == "correct"
    assert "wrong" in wrong.values()


@pytest.mark.parametrize("letter", ["Q", "tau", "M", "F"])
def test_forces_by_the_names_of_their_coordinates(letter: str) -> None:
    lines = {
        "psi": "(J + m*s^2*cos(theta)^2)*psi'' + 2*m*s*s'*psi'*cos(theta)^2 - m*s^2*sin(2*theta)*psi'*theta'",
        "theta": "m*s^2*theta'' + 2*m*s*s'*theta' + m*s^2*sin(2*theta)*psi'^2/2 + m*g*s*cos(theta)",
        "s": "m*s'' - m*s*theta'^2 - m*s*cos(theta)^2*psi'^2 + m*g*sin(theta)",
    }
    for order in (list(lines), list(reversed(lines))):
        text = "\n".join(f"{letter}_{name} = {lines[name]}" for name in order)
        assert own(CRANE, text, "report.txt")["tau"] == "correct"
    text = text.replace("m*g*s*cos", "m*g*s*sin")
    found = own(CRANE, text, "report.txt")
    assert (found["tau1"], found["tau2"], found["f3"]) == ("correct", "wrong", "correct")


def test_the_first_frame_has_two_names() -> None:
    c, s = r"\cos q_1", r"\sin q_1"
    rows = rf"{c} & -{s} & 0 & l_1 {c} \\ {s} & {c} & 0 & l_1 {s} \\ 0&0&1&0 \\ 0&0&0&1"
    for name in ("{}^0T_1", "A_1", "H_1"):
        found = own(ARM, rf"$${name} = \begin{{bmatrix}} {rows} \end{{bmatrix}}$$", "report.md")
        assert found.get("A1") == found.get("H1") == "correct"
