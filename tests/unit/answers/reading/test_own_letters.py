"""Letters of the student's own that books use for something else: J, v_2, θ, I with a mark, D of cos q_2."""

from __future__ import annotations

from functools import cache

import pytest

from dynsolve.answers.judge import Checker
from dynsolve.answers.reading.files import read_submission
from dynsolve.problem import load, read_problem
from dynsolve.problem.reader import find
from tests.unit.answers.reading.submissions import report, shown

PENDULUM = """
gravity: [0, 0, -g]
model:
  coordinates: {q1: revolute, q2: revolute}
  D: [[J + (I + m*l^2)*sin(q2)^2, 0], [0, I + m*l^2]]
  P: m*g*l*cos(q2)
find: [D, P]
"""
WHEEL = """
gravity: [0, -g, 0]
model:
  coordinates: {x: prismatic, gamma: revolute}
  bodies:
    - {mass: M, at: [x, R, 0], turn: -x/R, about: [0, 0, 1], inertia: {zz: M*R^2/2}}
    - {mass: m, at: [x + l*sin(gamma), R - l*cos(gamma), 0]}
find: [K]
"""
REACH = "{gravity: none, dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}], reach: [x, y], find: [inverse]}"


@cache
def checker(name: str) -> Checker:
    texts = {"pendulum": PENDULUM, "reach": REACH, "wheel": WHEEL}
    return Checker(read_problem(texts[name]) if name in texts else load(find(name)))


def verdict(problem: str, text: str, name: str) -> str:
    judge = checker(problem)
    report = judge(read_submission(judge.problem, text, "report.md"))
    return next((answer.verdict.value for answer in report.answers if answer.name == name), "")


D = r"$$D=\begin{{pmatrix}}J+{0}\sin^2q_2&0\\0&{0}\end{{pmatrix}}$$"
MARKED = [r"\hat I", r"\bar I", r"\tilde I", "I^*", "I'"]


@pytest.mark.parametrize("letter", MARKED)
@pytest.mark.parametrize(
    "form", ["$${0}:={1}$$\n\n{2}", "{2}\nwhere ${0}={1}$.", "{2}\nmit ${0}={1}$", "Sei ${0}={1}$.\n\n{2}"]
)
def test_another_letter_by_its_mark(letter: str, form: str) -> None:
    for value, expected in (("I+ml^2", "correct"), ("I+ml", "wrong")):
        assert verdict("pendulum", form.format(letter, value, D.format(letter)), "D") == expected


@pytest.mark.parametrize("form", [
    "Let ${0}={1}$. Then\n{2}", "$${0}={1}$$\n\n{2}", "{2}\nder ${0}={1}$", "$${0}:={1}$$\n{2}",
])  # fmt: skip
@pytest.mark.parametrize(("left", "used"), [("B(q_2)", "B(q_2)"), ("B(q_2)", "B"), ("B", "B")])
def test_a_scalar_under_the_letter_of_a_matrix(form: str, left: str, used: str) -> None:
    for value, expected in (("I+ml^2", "correct"), ("2I+ml^2", "wrong")):
        assert verdict("pendulum", form.format(left, value, D.format(used)), "D") == expected


def test_a_scalar_that_nothing_uses_is_an_answer_of_another_shape() -> None:
    assert verdict("pendulum", "$$D = I + m l^2$$", "D") == "unreadable"


@pytest.mark.parametrize(
    "said", [r"Let $\theta=q_2$.", r"Sei $\alpha=q_1$ und $\theta=q_2$.", r"$$\theta=q_2$$"]
)
def test_a_coordinate_under_the_letter_of_the_vector(said: str) -> None:
    assert verdict("pendulum", f"{said}\n\n$$P=mgl\\cos\\theta$$", "P") == "correct"
    assert verdict("pendulum", f"{said}\n\n$$P=mgl\\sin\\theta$$", "P") == "wrong"


FORCE = [
    (r"m_2\dot v_2-m_2L_2\omega_1^2", r"$v_2=\dot L_2$, $\omega_1=\dot\theta_1$"),
    (r"m_2\ddot L_2-m_2L_2\omega^2", r"$\omega=\dot\theta_1$"),
    (r"m_2\ddot r-m_2r\omega^2", r"$r=L_2$, $\omega=\dot\theta_1$"),
]


@pytest.mark.parametrize("word", ["with", "where", "mit", "wobei", "der", "hvor"])
@pytest.mark.parametrize(("formula", "said"), FORCE)
def test_rates_by_other_letters(word: str, formula: str, said: str) -> None:
    assert verdict("in3140-rp", f"$$f_2={formula}$$ {word} {said}", "f2") == "correct"
    assert verdict("in3140-rp", f"$$f_2=2{formula}$$ {word} {said}", "f2") == "wrong"


def test_heights_and_squares_of_speeds() -> None:
    heights = r"mit $h_1=l_{c1}\sin q_1$ und $h_2=l_1\sin q_1+l_{c2}\sin(q_1+q_2)$"
    assert verdict("planar-2r", f"$$P=m_1gh_1+m_2gh_2$$ {heights}", "P") == "correct"
    square = r"l_1^2\dot q_1^2+l_{c2}^2(\dot q_1+\dot q_2)^2+2l_1l_{c2}\cos q_2\dot q_1(\dot q_1+\dot q_2)"
    turning = r"\tfrac12I_1\dot q_1^2+\tfrac12I_2(\dot q_1+\dot q_2)^2"
    K = rf"$$K=\tfrac12m_1l_{{c1}}^2\dot q_1^2+\tfrac12m_2v_2^2+{turning}$$"
    assert verdict("planar-2r", f"$$v_2^2={square}$$\n\n{K}", "K") == "correct"
    assert verdict("planar-2r", f"{K} where $v_2^2={square.replace('2l_1', 'l_1')}$", "K") == "wrong"


OF_WHEEL = (
    r"$$K=\frac12M\dot x^2+\frac14MR^2\dot\theta^2"
    r"+\frac12m(\dot x^2+2l\dot x\dot\gamma\cos\gamma+l^2\dot\gamma^2)$$"
)


@pytest.mark.parametrize("said", [
    r"$$\dot\theta=\dot x/R$$", r"$$\theta=\frac{x}{R}$$", r"With the angle of the disk, $\theta=x/R$,",
    r"The disk turns by $\theta$ with $\dot\theta=\dot x/R$ (rolling without slipping).",
])  # fmt: skip
@pytest.mark.parametrize("letter", [r"\theta", r"\varphi"])
def test_an_angle_of_the_own_is_not_the_only_one_that_turns(said: str, letter: str) -> None:
    text = f"{said}\n\n{OF_WHEEL}".replace(r"\theta", letter)
    assert verdict("wheel", text, "K") == "correct"
    assert verdict("wheel", text.replace("x/R", "x").replace("{x}{R}", "{x}{2}"), "K") == "wrong"


COSINE = r"\frac{x^2+y^2-l_1^2-l_2^2}{2l_1l_2}"
BRANCHES = (
    r"q_2{1}=\operatorname{{atan2}}(\pm\sqrt{{1-D^2}},D){0}"
    r"q_1{1}=\operatorname{{atan2}}(y,x)-\operatorname{{atan2}}(l_2\sin q_2,l_1+l_2\cos q_2)"
)


@pytest.mark.parametrize("text", [
    rf"$$\cos q_2={COSINE}=:D$$" + f"$${BRANCHES.format(', ', '')}$$",
    rf"$$D:={COSINE}$$" + f"\n\n$${BRANCHES.format(', ', '')}$$",
    rf"$$\begin{{aligned}}D&:=\cos q_2={COSINE}\\{BRANCHES.format(chr(92) * 2, '&')}\end{{aligned}}$$",
    rf"$\cos q_2={COSINE}=:D$, so" + f"\n$${BRANCHES.format(', ', '')}$$",
    f"Sei $D={COSINE}$. Dann\n$${BRANCHES.format(', ', '')}$$",
])  # fmt: skip
def test_the_cosine_that_gives_the_branches(text: str) -> None:
    assert verdict("reach", text, "inverse") == "correct"
    assert verdict("reach", text.replace("{2l_1l_2}", "{l_1l_2}"), "inverse") == "wrong"


@pytest.mark.parametrize("text", [
    r"$$K_1=\tfrac12(m_1l_{c1}^2+I_1)\omega^2,\quad\text{der }\omega=\dot q_1$$",
    r"$$K_1=\tfrac12(m_1l_{c1}^2+I_1)\omega_1^2\qquad(\omega_1=\dot q_1)$$",
    "K1 = 1/2*(m1*lc1^2+I1)*w1^2 mit w1 = dq1",
    "K1 = 1/2*(m1*lc1^2+I1)*w1^2 where w1 = dq1",
])  # fmt: skip
def test_a_definition_on_the_same_line(text: str) -> None:
    assert verdict("planar-2r", text, "K1") == "correct"
    assert verdict("planar-2r", text.replace("m_1", "m_2").replace("m1", "m2"), "K1") == "wrong"


def test_the_rate_of_a_formula_of_ones_own() -> None:
    text = r"$$p_2=m_2\dot L_2$$ $$f_2=\dot p_2-m_2L_2\dot\theta_1^2$$"
    assert verdict("in3140-rp", text, "f2") == "correct"
    assert verdict("in3140-rp", text.replace("p_2=m", "p_2=2m"), "f2") == "wrong"


def test_two_alternatives_in_one_display_define_nothing() -> None:
    judge = Checker(read_problem(REACH.replace("[inverse]", "[inverse, singular]")))
    text = r"The arm is singular where $$q_2 = 0 \text{ or } q_2 = \pi$$"
    report = judge(read_submission(judge.problem, text, "report.md"))
    assert next(answer.verdict for answer in report.answers if answer.name == "singular") == "correct"


ARM = """
gravity: none
dh: [{theta: q1*, a: a1}, {theta: q2*, a: a2}, {theta: q3*, a: a3}]
task: [tip.x, tip.y, q1 + q2 + q3]
reach: [x, y, phi]
find: [r, Jr, inverse]
"""
X, Y = r"$$x = a_1c_1+a_2c_{12}+a_3c_{123}$$", r"$$y = a_1s_1+a_2s_{12}+a_3s_{123}$$"
IN_XY = r"""$$J_r = \begin{bmatrix} -y & -(y - a_1s_1) & -a_3s_{123}\\
x & x - a_1c_1 & a_3c_{123}\\ 1&1&1\end{bmatrix}$$"""
WRIST = "xw = x - a3*cos(phi), yw = y - a3*sin(phi)"
Q2 = "acos((xw^2+yw^2-a1^2-a2^2)/(2*a1*a2))"
OTHERS = "q1 = atan2(yw, xw) - atan2(a2*sin(q2), a1+a2*cos(q2))\nq3 = phi-q1-q2"


def arm(text: str, ending: str = "md") -> dict[str, tuple[str, str]]:
    judge = Checker(read_problem(ARM))
    report = judge(read_submission(judge.problem, text, f"a.{ending}"))
    return {one.name: (str(one.verdict), "; ".join(one.notes)) for one in report.answers}


@pytest.mark.parametrize("text", [f"{X}{Y}{IN_XY}", f"{IN_XY}\nwhere {X} and {Y}"])
def test_what_is_to_be_reached_stands_in_a_jacobian_for_the_task(text: str) -> None:
    assert arm(text)["Jr"][0] == "correct"
    assert arm(text.replace("-y &", "y &"))["Jr"][0] == "wrong"


@pytest.mark.parametrize(("text", "ending"), [
    (rf"{X}{Y}$$\phi = q_1 + q_2 + q_3$$", "md"), ("answers: {phi: q1 + q2 + q3}", "yaml"),
])  # fmt: skip
def test_a_component_of_the_task_is_called_as_what_is_to_be_reached(text: str, ending: str) -> None:
    assert arm(text, ending)["r3"][0] == "correct"
    assert arm(text.replace("+ q", "- q"), ending)["r3"][0] == "wrong"


@pytest.mark.parametrize("sign", ["±", "+/-", "+-", "+- "])
@pytest.mark.parametrize("form", [f"q2 = {{0}}{Q2} where {WRIST}\n{OTHERS}",
                                  f"{WRIST}\nq2 = {{0}}{Q2}\n{OTHERS}"])  # fmt: skip
def test_what_a_branch_defines_on_its_line_and_both_signs(sign: str, form: str) -> None:
    assert arm(form.format(sign), "txt")["inverse"] == ("correct", "")
    assert arm(form.format(""), "txt")["inverse"] == ("correct", "incomplete")


def test_a_further_value_is_no_definition() -> None:
    arm = read_problem("{dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}], find: [singular]}")
    found = read_submission(arm, r"The arm is singular where $$ q_2 = 0, \pi $$", "a.md")
    assert [len(one.alternatives) for one in found.configurations] == [2]


def test_blanks_in_a_matrix_stand_between_entries_or_also_between_factors() -> None:
    judge = Checker(
        read_problem("""
gravity: none
model:
  coordinates: {x: prismatic, y: prismatic, phi: revolute, theta: revolute}
  D: [[m, 0, 0, 0], [0, m, 0, 0], [0, 0, Id, 0], [0, 0, 0, Ia]]
constraints: [{rates: x' - R*theta'*cos(phi)}, {rates: y' - R*theta'*sin(phi)}]
find: [Ac]
""")
    )
    for rows, expected in {
        "1 0 0 -R*cos(phi); 0 1 0 -R*sin(phi)": "correct",
        "1 0 0 -R cos(phi); 0 1 0 -R sin(phi)": "correct",
        "1 0 0 -R cos(phi); 0 1 0 R sin(phi)": "wrong",
        "1 0 0 - R*cos(phi); 0 1 0 -R sin(phi)": "unreadable",
        "1 0 R m cos(phi); 0 1 R m sin(phi)": "unreadable",
        "1 0 0; 0 1 0": "wrong",
    }.items():
        report = judge(read_submission(judge.problem, f"Ac = [{rows}]", "a.txt"))
        assert (rows, [str(a.verdict) for a in report.answers if a.name == "Ac"]) == (rows, [expected])


POINT = """
gravity: [0, -g, 0]
model:
  coordinates: {r: prismatic, alpha: revolute}
  bodies: [{mass: m, at: [r*sin(alpha), -r*cos(alpha), 0]}]
find: [K]
"""
RODS = """
gravity: [0, -g, 0]
dh: [{theta: p1*, a: a1}, {theta: p2* - p1*, a: a2}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}, {mass: mL, name: L, link: 2}]
find: [D, g]
"""


@pytest.mark.parametrize(("problem", "own", "answer", "names", "slip"), [
    (POINT, r"\omega = \dot\alpha", r"K = \frac12 m(\dot r^2 + r^2\omega^2)", ("K", "w1"), ("r^2", "r")),
    (RODS, "m_{12} = m_2 + m_L",
     r"g = \begin{pmatrix}(m_1 + m_{12})ga_1\cos p_1\\(m_2 + m_L)ga_2\cos p_2\end{pmatrix}",
     ("g", "d12"), ("m_1 +", "m_1 -")),
])  # fmt: skip
def test_a_name_of_the_own_that_makes_an_answer_right_is_none(
    problem: str, own: str, answer: str, names: tuple[str, str], slip: tuple[str, str]
) -> None:
    judge = Checker(read_problem(problem))
    for written, expected in ((answer, ("correct", None)), (answer.replace(*slip), ("wrong", "wrong"))):
        for said in (f"$${own}$$\n\n$${written}$$", f"With ${own}$:\n\n$${written}$$"):
            report = judge(read_submission(judge.problem, said, "report.md"))
            found = {one.name: one.verdict.value for one in report.answers}
            assert tuple(map(found.get, names)) == expected
            assert len(report.set_aside) == (expected[1] is None)


@pytest.mark.parametrize("rate", ["dth", "thdot", "th_dot", "th'"])
def test_the_rate_of_the_only_angle_by_another_letter(rate: str) -> None:
    (answer,) = report(f"K = m*l^2*{rate}^2", "a.txt", stem="cart-pole").answers
    assert shown(answer) == "m l² θ̇²"
    assert answer.notes == ("th is read as theta",)


def test_a_letter_of_the_coordinates_that_is_given_a_scalar_is_one() -> None:
    (answer,) = report("Theta = I1 + m1 lc1^2\nK = Theta/2", "a.txt").answers
    assert shown(answer) == "(I₁ + m₁ l_c1²)/2"


def test_bars_around_the_jacobian_begin_no_table() -> None:
    found = report("|J| = 2*sin(q2)", "a.txt", stem="planar-rrp-task")
    assert [(one.name, one.fault) for one in found.answers] == [("det", "")]
