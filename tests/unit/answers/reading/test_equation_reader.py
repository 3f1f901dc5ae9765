"""Chains of equations: names, values, definitions, and what needs the whole file."""

from __future__ import annotations

from dynsolve.answers.reading.files import read_submission
from dynsolve.problem import read_problem
from tests.unit.answers.reading.submissions import named, report, shown

ONE = read_problem("""
dh: [{theta: q1*, a: l}]
masses: [{mass: m, link: 1}]
friction: {q1: {coulomb: fc}}
""")


def test_what_stands_after_a_comma_is_not_dropped() -> None:
    (answer,) = report("$$K = m_1, m_2$$").answers
    assert "`,`" in answer.fault


def test_every_value_of_a_chain_is_an_answer_to_every_name() -> None:
    found = report(r"$$K_1 = K_{v_1} + K_{\omega_1} = m_1 = m_1 + 0$$ $$d_{12} = d_{21} = I_2$$")
    assert [(a.name, a.occurrence) for a in found.answers] == [
        ("K1", (1, 2)),
        ("K1", (1, 3)),
        ("d12", (2, 2)),
        ("d21", (2, 2)),
    ]


def test_rows_go_on_with_a_chain() -> None:
    found = report("\\begin{align}\nP &= P_1 + P_2 \\\\\n &= m_1 g \\\\\n &\\quad + m_2 g\n\\end{align}")
    assert [shown(answer) for answer in found.answers] == ["m₁ g + m₂ g"]


def test_an_abbreviation_holds_for_what_follows() -> None:
    found = report("$$h = -m_2 l_1 l_{c2} s_2$$ $$c_{221} = h$$ $$c_{211} = c_{121} = h$$")
    assert [a.name for a in found.answers] == ["c221", "c211", "c121"]
    assert {shown(answer) for answer in found.answers} == {"-m₂ l₁ l_c2 sin(q₂)"}


def test_what_is_not_defined_is_unreadable_and_says_what_there_is() -> None:
    (answer,) = report("$$\\tau_1 = k \\dot q_1$$").answers
    assert answer.node is None
    assert "`k`" in answer.fault
    assert "lc1" in answer.expected


def test_an_index_that_is_none_is_the_one_answer_that_is_absent() -> None:
    found = report("$$\\tau_1 = m_1$$ $$\\tau_3 = m_2$$")
    assert [a.name for a in found.answers] == ["tau1", "tau2"]
    assert "taken for tau2" in " ".join(found.answers[1].notes)


def test_an_index_that_is_none_is_not_recognized_where_two_are_absent() -> None:
    found = report("$$\\tau_3 = m_2$$", stem="scara-rrpr")
    assert [a.name for a in report("$$\\tau_9 = m_2$$", stem="scara-rrpr").answers] == []
    assert found.answers[0].name == "f3"


def test_the_model_in_matrices_gives_its_parts() -> None:
    model = (
        r"$$\tau = \begin{bmatrix} m_1 & 0 \\ 0 & m_2 \end{bmatrix}"
        r"\begin{bmatrix} \ddot q_1 \\ \ddot q_2 \end{bmatrix}"
        r" + \begin{bmatrix} 0 & I_1 \\ 0 & 0 \end{bmatrix}\begin{bmatrix} \dot q_1 \\ \dot q_2 \end{bmatrix}"
        r" + \begin{bmatrix} g \\ 0 \end{bmatrix}$$"
    )
    found = report(model)
    assert [a.name for a in found.answers] == ["D", "C", "g", "tau"]
    assert [a.name for a in report(r"$$\tau_1 = m_1$$ $$\tau_2 = m_2$$" + model).answers] == [
        "tau1",
        "tau2",
        "D",
        "C",
        "g",
    ]


def test_a_zero_level_of_height_stays_a_symbol() -> None:
    (answer,) = report("$$P_1 = m_1 g (l_{c1} s_1 + h_0)$$").answers
    assert answer.free == ("h0",)


def test_what_a_symbol_of_the_problem_is_said_to_be_is_no_answer() -> None:
    found = report("$$g = 9.81 m/s^2$$ $$I_1 = \\frac{1}{12} m_1 l_1^2$$ $$m_1 = 3\\,\\text{kg}$$")
    assert found.answers == ()
    assert len(found.not_recognized) == 3


def test_a_moment_of_inertia_without_its_body_is_that_of_the_answer() -> None:
    (answer,) = report("$$K_{\\omega_2} = \\frac12 I_{zz} \\dot\\theta_1^2$$", stem="elbow-3r").answers
    assert "I_2zz" in shown(answer)
    assert answer.notes


def test_equations_without_a_name_are_listed() -> None:
    found = report("$$x + y = 3$$ $$v_2^2 = l_1^2$$ $$K = m_1$$")
    assert [refused.text for refused in found.not_recognized][:1] == ["x + y = 3"]
    assert named(found) == [("K", "")]


def test_a_pair_of_equal_christoffel_symbols_says_which_index_is_the_row() -> None:
    first = report("$$c_{112} = c_{121} = m_1$$ $$c_{211} = -m_1$$").answers
    assert {a.name for a in first[:-1]} == {"c121", "c211"}
    assert first[-1].name == "c112"
    assert [a.name for a in report("$$c_{121} = c_{211} = m_1$$").answers] == ["c121", "c211"]


def test_y_and_a_are_what_a_product_of_theirs_holds() -> None:
    product = (
        r"\begin{bmatrix} \ddot q_1 & g_0 \\ 0 & \ddot q_2 \end{bmatrix}"
        r"\begin{bmatrix} m_1 \\ m_2 \end{bmatrix}"
    )
    for left in ("Y a", r"Y(q, \dot q, \ddot q)\, \pi", r"\tau"):
        found = report(f"$${left} = {product}$$", stem="rp-parameters")
        assert [a.name for a in found.answers] == ["Y", "a", "tau"]
    assert report(r"$$\tau = Y a$$", stem="rp-parameters").answers == ()


def test_a_single_coordinate_may_be_written_by_the_usual_letters() -> None:
    for letter in ("q", r"\theta", r"\theta_1"):
        text = rf"$$m l^2\ddot{{{letter}}} = \tau - f_c\,\text{{sgn}}\,\dot{{{letter}}}$$"
        (answer,) = read_submission(ONE, text, "report.md").answers
        assert shown(answer) == "m l² q̈₁ + f_c sgn(q̇₁)"
