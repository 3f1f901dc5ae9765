"""What a reader with a pencil asks of the lines: each says what was done, and none says what is not so."""

from __future__ import annotations

from unicodedata import normalize

import dynsolve
from dynsolve.explain.step import Detail
from dynsolve.render.files import Format
from dynsolve.solution.reports import report

CART = """
gravity: [0, -g, 0]
model:
  coordinates: {x: prismatic, a: revolute}
  bodies:
    - {mass: m, at: [x + l*sin(a), -l*cos(a), 0]}
"""
SWING = """
gravity: [0, -g, 0]
dh:
  - {theta: q1*, a: l1, alpha: 90deg}
  - {theta: q2*, alpha: -90deg, a: l2}
masses: [{mass: m1, link: 2}]
"""
ELBOW = """
gravity: none
dh:
  - {theta: q1*, d: h, alpha: 90deg}
  - {theta: q2*, a: l2}
  - {theta: q3*, a: l3}
"""


def told(problem: str) -> str:
    """The worked solution, its words and formulas one after the other."""
    text = report(dynsolve.solve(problem), Format.TEXT, detail=Detail.NORMAL).decode()
    return " ".join(normalize("NFC", text).split())


def test_a_line_that_only_reorders_stands_in_place_of_the_one_before() -> None:
    text = told(CART + "find: [K]")
    assert "K_v1 = ½ m (ẋ² + 2l cos(a) ẋ ȧ + l² ȧ²)" in text
    assert "Collected:" not in text


def test_every_identity_on_the_way_is_named() -> None:
    text = told(SWING + "find: [K]")
    assert text.index("= U² + V²") < text.index("By s₂² + c₂² = 1:")
    text = told(ELBOW + "task: [tip.x, tip.y, tip.z]\nfind: [det]")
    assert "signs in turn, with s₁² + c₁² = 1:" in text
    assert "By the sine of a difference, s₂₃ c₂ - c₂₃ s₂ = s₃:" in text


ARM = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]
"""


def test_recursions_end_at_the_forces() -> None:
    assert "τ₂ = (𝐧₂²)ᵀ 𝐳₁²" in told(ARM + "find: [tau, fl2, nl2]")


def test_a_passive_coordinate_has_no_force_to_read_off() -> None:
    text = told(ARM + "passive: [q2]\nfind: [tau, D]")
    assert "in the right side of equation i" in text and "dᵢⱼ = ∂τᵢ/∂q̈ⱼ" not in text
    assert "dᵢⱼ = ∂τᵢ/∂q̈ⱼ" in told(ARM + "find: [tau, D]")


def test_how_a_product_is_read_off_is_said_where_it_is_used() -> None:
    text = told(ARM + "find: [K]")
    assert "(-u₂, u₁, 0)ᵀ" in text and "read off as in" not in text


def test_what_is_conserved_is_what_is_there() -> None:
    text = told(
        CART.replace("sin(a)", "cos(b)").replace("prismatic, a", "prismatic, b").replace("cos(a)", "sin(b)")
    )
    assert "As long as" in text
    text = told(CART + "passive: [x]\nconstraints: [a]\nfind: [tau, D, C, g, Ac]")
    assert "f₁" not in text[text.index("cyclic") : text.index("momentum")]


def test_nothing_is_lost_where_the_task_can_move_any_way() -> None:
    problem = "gravity: none\ndh: [{theta: q1*, a: l}, {theta: q2*, a: l}]\ntask: [tip.x, tip.y]\n"
    text = told(problem + "state: {q1: 0, q2: 90deg}\nfind: [lost]")
    assert "no motion is lost" in text and "A force along it" not in text


def test_no_angle_is_free_where_that_can_never_be() -> None:
    arm = "gravity: none\ndh: [{theta: q1*, a: %s}, {theta: q2*, a: %s}]\nreach: [5, 0]\nfind: [inverse]\n"
    assert "is free" not in told(arm % (3, 4))
    assert "is free" in told(arm % (3, 3))


CUFF = """
gravity: [0, 0, -g]
dh: [{theta: q1*, d: h, alpha: 90deg}, {theta: q2*, a: l}, {theta: q3*, a: b}]
masses:
  - {mass: m2, link: 2, center: midpoint, shape: {cylinder: {radius: r, length: l, axis: x}}}
  - {mass: m3, link: 3, center: tip}
"""


def test_an_identity_that_a_rotational_energy_needs_has_its_line() -> None:
    text = told(CUFF)
    line = text[text.index("K_ω1 = ½ (1/12) m₂") :]
    assert line.index("By s₂² + c₂² = 1") < line.index("K_ω1 = (1/24)")


def test_what_symbols_abbreviate_is_derived_before_them() -> None:
    text = told(CUFF + "find: [D, C, g]\n")
    assert text.index("∂d₁₁/∂q₂ = -") < text.index("Abbreviations") < text.index("c₁₂₁ = c₂₁₁")
