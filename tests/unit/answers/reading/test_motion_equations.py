"""Equations of motion whose sides are no names of answers: where the generalized force stands."""

from __future__ import annotations

import pytest

from dynsolve.answers.judge import Checker
from dynsolve.answers.reading.answer_list import UNDRIVEN
from dynsolve.answers.reading.files import read_submission
from dynsolve.answers.reading.grammar.brackets import SYMMETRIC_NOTE
from dynsolve.answers.reading.report_text import FREE
from dynsolve.problem import read_problem
from tests.unit.answers.reading.submissions import report, shown

# of the crane, q1 is driven and q2 is passive
CRANE = [
    (r"(m + m_p)\ddot q_1 + m_p d_p\ddot q_2\cos q_2 = F", "f1: (m + m_p) q̈₁ + m_p d_p q̈₂ cos(q₂)"),
    (r"m\ddot q_1 + m_p\ddot q_1 = u - f_v\dot q_1", "f1: m q̈₁ + m_p q̈₁ + f_v q̇₁"),
    (r"m\ddot q_1 - F_x = - m_p\ddot q_1", "f1: m q̈₁ + m_p q̈₁"),
    (r"-m\ddot q_1 = m_p\ddot q_1 - \tau", "f1: m_p q̈₁ + m q̈₁"),
    (r"d_p\ddot q_2 + \ddot q_1\cos q_2 = -g_0\sin q_2", "tau2: d_p q̈₂ + q̈₁ cos(q₂) + g₀ sin(q₂)"),
    (r"0 = \ddot q_1\cos q_2 + d_p\ddot q_2", "tau2: q̈₁ cos(q₂) + d_p q̈₂"),
    (r"\ddot q_2 = -\frac{g_0\sin q_2 + \ddot q_1}{d_p}", "tau2: q̈₂ + (g₀ sin(q₂) + q̈₁)/d_p"),
    (r"\ddot q_2 = -\frac{g_0\sin q_2}{d_p}", "tau2: q̈₂ + g₀ sin(q₂)/d_p"),
    (r"m\ddot q_1 = \tau_2", "tau2: m q̈₁"),
]


@pytest.mark.parametrize(("equation", "expected"), CRANE)
def test_the_force_is_what_drives_or_that_of_the_passive_coordinate(equation: str, expected: str) -> None:
    (answer,) = report(f"$${equation}$$", stem="crane").answers
    assert f"{answer.name}: {shown(answer)}" == expected


def test_what_is_solved_for_an_acceleration_is_none_where_its_equation_is_there() -> None:
    rows = r"$$(m + m_p)\ddot q_1 + m_p d_p\ddot q_2\cos q_2 = F$$ $$\ddot q_1\cos q_2 + d_p\ddot q_2 = 0$$"
    found = report(rows + r" $$\ddot q_2 = -\frac{m_p g_0\sin q_2}{m d_p}$$", stem="crane")
    assert [answer.name for answer in found.answers] == ["f1", "tau2"]
    assert [one.why for one in found.left_alone] == ["it is solved for an acceleration"]


def test_equations_are_those_of_all_coordinates_in_their_order_where_the_file_names_none_passive() -> None:
    found = report(r"$$M\ddot x = F$$ $$m\ddot\theta = 0$$ $$m l\ddot\theta = -g$$", stem="cart-pole")
    assert [(a.name, a.alternatives) for a in found.answers] == [("f1", ("tau2",)), ("tau2", ("f1",))]
    assert [UNDRIVEN in answer.notes for answer in found.answers] == [False, True]
    assert [(one.answers, one.why) for one in found.left_alone] == [(("f1",), FREE)]


@pytest.mark.parametrize("equation", [
    r"\ddot q_1 = 0",
    r"\ddot q_1 = \ddot q_2",
    r"g_0\sin q_2 = 0",
    r"m\ddot q_1 = F + u",
    r"m\ddot q_1 + z = 0",
    r"D \ddot q = 0",
])  # fmt: skip
def test_what_is_no_equation_of_motion_is_none(equation: str) -> None:
    assert report(f"$${equation}$$", stem="crane").answers == ()


def test_a_matrix_that_has_no_columns_by_itself_stops_nothing() -> None:
    text = r"$$Y = \begin{bmatrix} m_1 \\ g_0 \end{bmatrix}$$ $$Y + Y = m_1 \ddot q_1$$"
    found = report(text, stem="rp-parameters")
    assert [(answer.name, answer.fault) for answer in found.answers] == [("Y", "")]
    assert [one.why for one in found.left_alone] == ["a matrix of any size is named here"]


@pytest.mark.parametrize("equation", [
    r"\tau = \begin{bmatrix} F \\ 0 \end{bmatrix}",
    r"\tau = (u, 0)^T",
    r"\tau_2 = 0",
    r"\frac{d}{dt}\frac{\partial L}{\partial \dot q_1} - \frac{\partial L}{\partial q_1} = F - f_v \dot q_1",
])  # fmt: skip
def test_what_only_calls_the_forces_by_letters_is_left_alone(equation: str) -> None:
    found = report(f"$${equation}$$", stem="crane")
    assert found.answers == found.not_recognized == ()
    assert len(found.left_alone) == 1


def test_a_model_of_several_vectors_is_one_of_all_forces() -> None:
    model = (
        r"\begin{bmatrix} m & 0 \\ 0 & I_p \end{bmatrix}\begin{bmatrix}\ddot q_1 \\ \ddot q_2\end{bmatrix}"
        r"+ \begin{bmatrix} m_p\dot q_2^2 \\ 0 \end{bmatrix} + \begin{bmatrix} f_v\dot q_1 \\ 0 \end{bmatrix}"
        r"+ \begin{bmatrix} 0 \\ m_p g_0 \end{bmatrix} = \begin{bmatrix} F \\ 0 \end{bmatrix}"
    )
    assert [answer.name for answer in report(f"$${model}$$", stem="crane").answers] == ["D", "g", "tau"]


@pytest.mark.parametrize("before", [
    "For q1: ", "q1: ", "Eq. 1: ", "Equation of motion: ", "Cart: ", "E1) ", "=> ", "==> ", "-> ",
    "Hence ", "Thus, ", "and ", "Daraus folgt ", "We get ", "Finally we get ",
])  # fmt: skip
def test_words_before_an_equation_in_plain_text_are_no_part_of_it(before: str) -> None:
    first, second = "(m+mp) q1'' - mp dp q2'^2 sin(q2)", "mp dp q2''"
    found = report(f"{before}{first} = F\n{before}{second} = 0\n", "a.txt", stem="crane")
    read = [f"{answer.name}: {shown(answer)}" for answer in found.answers]
    assert read == ["f1: (m + m_p) q̈₁ - m_p d_p q̇₂² sin(q₂)", "tau2: m_p d_p q̈₂"]


def test_the_number_of_an_equation_that_is_zero_is_no_force() -> None:
    (answer,) = report("eq2 = mp dp q2'' = 0", "a.txt", stem="crane").answers
    assert (answer.name, shown(answer)) == ("tau2", "m_p d_p q̈₂")


@pytest.mark.parametrize("before", [
    "For small angles we get ", "If we assume ", "Linearized: ", "Check at rest: ", "Jtot ", "Jtot*",
])  # fmt: skip
def test_an_equation_of_one_case_and_one_of_an_unknown_letter_are_not_read(before: str) -> None:
    assert all(one.fault for one in report(f"{before}(m+mp) q1'' = F\n", "a.txt", stem="crane").answers)


@pytest.mark.parametrize(
    ("sentence", "expected"),
    [
        (r"For $q_1$ we find $m\ddot q_1 + m_p\ddot q_1=F$, as expected.", ["f1: m q̈₁ + m_p q̈₁"]),
        (r"Newton's law: $m\ddot q_1=F_{q_1}-f_v\dot q_1$.", ["f1: m q̈₁ + f_v q̇₁"]),
        (r"$m\ddot q_1=F$ and $m_p\ddot q_2=\tau_2$.", ["f1: m q̈₁", "tau2: m_p q̈₂"]),
        (r"We get $m\ddot q_1=\tau_1$ first. $$\tau_1 = m_p\ddot q_1$$", ["tau1: m_p q̈₁"]),
        (r"If $m\ddot q_1=F$ held, it would be easy.", []),
        (r"So $f_1$ must be $m\ddot q_1$.", ["f1: m q̈₁"]),
    ],
)
def test_in_a_sentence_it_counts_where_nothing_else_gives_its_force(
    sentence: str, expected: list[str]
) -> None:
    found = report(sentence, stem="crane").answers
    assert [f"{one.name}: {shown(one)}".replace("tau1", "f1") for one in found] == [
        one.replace("tau1", "f1") for one in expected
    ]


def test_one_of_no_force_in_a_sentence_waits() -> None:
    found = report(r"For the hook alone $m_p\ddot q_1 + m_p d_p\ddot q_2 = 0$ holds.", stem="crane")
    assert found.answers == () and [one.answers for one in found.not_recognized] == [("tau2",)]


@pytest.mark.parametrize(("name", "force"), [("Q_theta", "tau2"), ("F_x", "f1"), ("T_theta", "tau2")])
def test_a_force_has_the_index_of_its_coordinate(name: str, force: str) -> None:
    (answer,) = report(f"{name} = m*l^2*theta'' + m*l*x''", "a.txt", stem="cart-pole").answers
    assert answer.name == force


def test_a_force_that_may_be_any_names_all() -> None:
    found = report(r"$$F = \frac{d}{dt}(m_2\dot q_1) = m_2\ddot q_1$$")
    assert found.answers == () and [one.answers for one in found.not_recognized] == [("tau1", "tau2")]


@pytest.mark.parametrize("name", ["M_2", "T_2", r"\Gamma_2", r"Q_{q_2}"])
def test_a_torque_by_any_letter_counts_in_a_sentence(name: str) -> None:
    (answer,) = report(rf"The torque of joint two is ${name}=m_2\ddot q_1$, as it must be.").answers
    assert answer.name == "tau2"


RUBBED = """
gravity: [0, -g, 0]
model:
  coordinates: {q1: revolute, q2: revolute}
  D: [[m*l^2, 0], [0, m*l^2]]
  P: m*g*l*sin(q1)
friction: {q1: {viscous: b1, coulomb: fc}, q2: b2}
find: [friction, tau]
"""
RUBS, RUBS_TOO = r"F_1 = b_1\dot q_1 + f_c\,\mathrm{sgn}(\dot q_1)", r"F_2 = b_2\dot q_2"


@pytest.mark.parametrize("text", [
    f"The friction torques are\n\n$${RUBS}$$\n$${RUBS_TOO}$$",
    f"Friction torques: ${RUBS}$ and ${RUBS_TOO}$.",
    "friction: F1 = b1 q1' + fc sign(q1'), F2 = b2 q2'",
])  # fmt: skip
def test_what_holds_rates_beside_no_mass_is_friction_and_no_torque(text: str) -> None:
    judge = Checker(read_problem(RUBBED))
    for said, expected in ((text, "correct"), (text.replace("b", "2b"), "wrong")):
        found = judge(read_submission(judge.problem, said, "a.md"))
        verdicts = {answer.name: str(answer.verdict) for answer in found.answers}
        assert verdicts["friction2"] == verdicts["friction"] == expected
        assert verdicts.get("tau1", "missing") == "missing"


def test_friction_that_is_said_below_is_put_into_the_torque() -> None:
    judge = Checker(read_problem(RUBBED))
    text = rf"$$\tau_1 = m l^2\ddot q_1 + m g l\cos q_1 + F_1$$ where the friction is $${RUBS}$$"
    for said, expected in ((text, "correct"), (text.replace("b_1", "2b_1"), "wrong")):
        found = judge(read_submission(judge.problem, said, "a.md"))
        verdicts = {answer.name: str(answer.verdict) for answer in found.answers}
        assert verdicts["friction1"] == expected
        assert (verdicts["tau1"] == "correct") is (expected == "correct")


LONG = "m*l**2*(sin(q1(t))**2 + cos(q1(t))**2)*Derivative(q1(t), (t, 2))" + " + 0*sin(q2(t))" * 12


@pytest.mark.parametrize("line", [f"{LONG} = tau1", f"Eq({LONG}, tau1)", f"{LONG} - tau1 = 0"])
def test_a_long_equation_of_motion_as_programs_print_it(line: str) -> None:
    free = RUBBED.replace("friction: {q1: {viscous: b1, coulomb: fc}, q2: b2}", "")
    problem = read_problem(free.replace("[friction, tau]", "[tau]"))
    found = read_submission(problem, line, "a.txt")
    assert [answer.name for answer in found.answers] == ["tau1"]


def test_a_mark_in_a_symmetric_matrix_is_noted_on_that_matrix_alone() -> None:
    """D has a dot for an entry; the vectors beside it in the equation have none."""
    equation = (
        r"$$\begin{bmatrix} m + m_p & m_p d_p\cos q_2 \\ \cdot & m_p d_p^2 \end{bmatrix}"
        r"\begin{bmatrix} \ddot q_1 \\ \ddot q_2 \end{bmatrix}"
        r" + \begin{bmatrix} -m_p d_p\sin q_2 \dot q_2^2 \\ 0 \end{bmatrix}"
        r" + \begin{bmatrix} 0 \\ m_p g_0 d_p\sin q_2 \end{bmatrix} = \begin{bmatrix} F \\ 0 \end{bmatrix}$$"
    )
    answers = report(equation, stem="crane").answers
    assert {answer.name for answer in answers} > {"D", "g"}
    assert {answer.name for answer in answers if SYMMETRIC_NOTE in answer.notes} == {"D"}


@pytest.mark.parametrize(("kind", "name"), [
    ("dLdqd", "dLdqd"), ("dLdqd", "∂L/∂q̇"), ("dLdqd", "dL/dq'"), ("dLdq", "dLdq"), ("dLdq", "∂L/∂q"),
    ("ddt", "ddt"), ("ddt", "d/dt(∂L/∂q̇)"), ("dLdqd", r"\frac{\partial L}{\partial\dot{\mathbf q}}"),
])  # fmt: skip
def test_the_derivatives_of_the_lagrangian_by_all_coordinates_at_once(kind: str, name: str) -> None:
    problem = read_problem(RUBBED.replace("[friction, tau]", "[dLdqd, dLdq, ddt]"))
    found = [read_submission(problem, f"$${name} = [m, 2l]$$\n", "a.md")]
    if name.isalpha():
        found.append(read_submission(problem, f"answers:\n  {name}: [m, 2*l]\n", "a.yaml"))
    for one in found:
        read = [(answer.name, shown(answer)) for answer in one.answers]
        assert read == [(f"{kind}1", "m"), (f"{kind}2", "2l")]


def test_a_vector_of_derivatives_in_names_alone_is_a_definition() -> None:
    problem = read_problem(RUBBED.replace("[friction, tau]", "[dLdqd, D]"))
    found = read_submission(problem, r"$$\frac{\partial L}{\partial\dot q} = D\dot q$$", "a.md")
    assert found.answers == found.not_recognized == () and len(found.left_alone) == 1


@pytest.mark.parametrize("rate", [r"\ddot q", r"\ddot{\mathbf q}", " qddot", " q''"])
def test_accelerations_are_no_answer_in_the_model_though_they_are_asked_for(rate: str) -> None:
    free = RUBBED.replace("friction: {q1: {viscous: b1, coulomb: fc}, q2: b2}", "")
    judge = Checker(read_problem(free.replace("[friction, tau]", "[tau, D, C, g, qdd_forward]")))
    model = "D = [[m*l^2, 0], [0, m*l^2]]\nC = [[0, 0], [0, 0]]\ng = [m*g*l*cos(q1), 0]\n"
    for given, expected in ((model, "correct"), (model.replace("cos", "sin"), "follows")):
        found = judge(read_submission(judge.problem, f"{given}\n$$\\tau = D{rate} + g$$\n", "a.md"))
        assert {one.name: str(one.verdict) for one in found.answers}["tau"] == expected
