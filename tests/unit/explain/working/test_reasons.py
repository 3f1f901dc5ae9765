"""What is said of a line is why it follows, and no line is a detour."""

from __future__ import annotations

import dynsolve
from dynsolve.explain.step import Detail
from dynsolve.render.files import Format
from dynsolve.solution.reports import report
from tests.unit.explain.working.test_lines import lines

FINGERS = """
dh: [{theta: w*}, {from: 1, theta: f*, a: l}, {from: 1, theta: -f*, a: l}]
masses: [{mass: m, link: 2, center: tip}, {mass: m, link: 3, center: tip}]
gravity: [0, -g, 0]
"""

PARALLEL_LINK = """
gravity: none
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}, {theta: -q1*, a: l3}]
masses: [{mass: m, link: 3, center: tip}]
"""

ON_A_SLOPE = """
gravity: [g*sin(beta), -g*cos(beta), 0]
dh: [{theta: q1*, a: l1}]
masses: [{mass: m, link: 1, center: tip}]
"""

LEANING = """
gravity: none
dh: [{theta: q1*, d: h, alpha: 60deg}, {d: x*}]
masses: [{mass: m, link: 1, center: [0, 0, e]}]
"""

LEANING_BASE = """
gravity: none
base: Rx(30deg)
dh: [{d: x*, alpha: 90deg}, {theta: t*}]
masses: [{mass: m, link: 1, center: origin}]
"""

LONGER_LINK = """
gravity: none
dh: [{theta: u1*, a: l1}, {theta: u2* - u1*, a: l2}, {theta: u1* - u2*}]
masses: [{mass: m, link: 3, center: {near: [e, 0, 0]}}]
"""

ROLL_AND_SWING = """
gravity: none
dh: [{theta: q1*, alpha: 90deg}, {theta: q2*, alpha: -90deg}, {theta: q3*, a: l}]
masses: [{mass: m, link: 3, center: midpoint, shape: {rod: {length: l, axis: x}}}]
"""

WRIST = """
gravity: none
dh: [{theta: q1*, alpha: -90deg}, {theta: q2*, alpha: 90deg}, {theta: q3*, d: e}]
masses: [{mass: m, link: 3, center: tip}]
"""

MODIFIED = """
convention: modified
dh: [{d: x*}, {theta: t*, alpha: 45deg}]
masses: [{mass: m, link: 2, center: [c, 0, 0]}]
"""

LEANING_AXES = """
gravity: none
axes: [{turn: q1, about: [0, 0, 1], through: [0, 0, 0]},
  {turn: q2, about: [cos(30deg), 0, sin(30deg)], through: [0, 0, 0]}]
tip: [0, b, 0]
zero: drawn
masses: [{mass: m, link: 2, center: tip}]
"""

ON_A_CONE = """
gravity: none
model:
  coordinates: {r: prismatic, W: revolute}
  bodies: [{mass: m, at: [r*cos(W)*cos(30deg), r*sin(W)*cos(30deg), r*sin(30deg)]}]
"""

PAN_TILT = """
gravity: [0, 0, -9.81]
dh: [{theta: q1*, d: 0.3, alpha: 90deg}, {theta: q2*, a: c}]
masses: [{mass: m1, link: 1, center: origin}, {mass: m2, link: 2, center: tip}]
"""

PENDULUM = """
gravity: none
dh: [{theta: q1*, a: l}]
masses: [{mass: 0.5, link: 1, center: tip}]
"""

TWO_SLIDES = """
gravity: none
dh: [{d: x*}, {d: y*}]
masses: [{mass: MASS, link: 1, center: origin}, {mass: MASS, link: 2, center: origin}]
"""

BESIDE_THE_ARM = """
gravity: none
dh: [{theta: q1*, a: l, alpha: 90deg}, {theta: q2*, a: 0.3}]
masses: [{mass: m, link: 2, center: [0, 0.1, 0]}]
"""


def normal(problem: str) -> str:
    """A worked example without its breaks of lines."""
    page = report(dynsolve.solve(problem), Format.TEXT, detail=Detail.NORMAL).decode()
    return " ".join(page.split())


def test_a_potential_energy_says_by_what_it_is_collected() -> None:
    opened = (
        "Collected, with the sine of a sum, sin(w + f) = sin(w) cos(f) + cos(w) sin(f) and the sine of a "
        "difference, sin(f - w) = sin(f) cos(w) - cos(f) sin(w):"
    )
    assert lines(FINGERS, "P")[1:] == ["𝒫 = m g l sin(w + f) - m g l sin(f - w)", opened]
    assert opened in normal(FINGERS)


def test_a_row_times_a_column_says_by_what_it_is_added() -> None:
    added = "With the sine of a difference, s₁ cos(β) - c₁ sin(β) = sin(q₁ - β):"
    assert lines(ON_A_SLOPE, "P1") == [added]
    assert added in normal(ON_A_SLOPE)


def test_squares_in_angles_that_are_none_of_the_ring_are_multiplied_out_as_they_stand() -> None:
    assert lines(PARALLEL_LINK, "Kv1") == [
        "Multiplied out, with s₁² + c₁² = 1, s₂² + c₂² = 1, s₁₂² + c₁₂² = 1 and the cosine of a difference "
        "(c₂ c₁ + s₂ s₁ = cos(q₂ - q₁), c₁ c₁₂ + s₁ s₁₂ = c₂ and c₂ c₁₂ + s₂ s₁₂ = c₁), and collected:"
    ]
    for body in "12":
        (products,) = (text for text in lines(FINGERS, f"D_direct{body}") if "Multiplied" in text)
        assert "cancel" not in products  # of the ring's angle, in which it is not written


def test_a_root_among_the_components_asks_for_no_other_axes() -> None:
    assert lines(LEANING, "Kv1") == ["By s₁² + c₁² = 1:"]
    assert lines(LEANING_BASE, "Kv1") == ["Collected:"]


def test_a_sum_of_lengths_that_stays_is_not_opened() -> None:
    assert lines(LONGER_LINK, "Kv1") == [
        "Multiplied out, with s₁² + c₁² = 1, s₂² + c₂² = 1 and the cosine of a difference, "
        "c₂ c₁ + s₂ s₁ = cos(u₂ - u₁), and collected:"
    ]


def test_slopes_are_put_in_where_an_identity_adds_them() -> None:
    page = normal(ROLL_AND_SWING)
    assert "c₂₃₁ = c₃₂₁ = ½ (∂d₁₃/∂q₂ + ∂d₁₂/∂q₃) = ½ (" in page
    assert "Put into the formula, with s₃² + c₃² = 1 and the cosine of twice an angle," in page
    assert "c₁₂₁ = c₂₁₁ = ½ ∂d₁₁/∂q₂ = ½ (" not in page


def test_a_lever_along_the_axis_is_seen_to_give_nothing() -> None:
    assert "𝐳₂ × (𝐨₃ - 𝐨₂) = 𝐳₂ × (e 𝐳₂) = 𝟎" in normal(WRIST)


def test_a_point_less_itself_is_not_told() -> None:
    page = normal(MODIFIED)
    assert "𝐨₂ - 𝐨₂)" in page and "𝐨₂ - 𝐨₂ = 𝟎" not in page


def test_numbers_are_multiplied_where_they_do_not_stay() -> None:
    assert lines(PENDULUM, "Kv1") == ["By s₁² + c₁² = 1:"], "½·0.5 l² q̇₁²"
    assert lines(TWO_SLIDES.replace("MASS", "2"), "Kv2") == ["The numbers multiplied:"], "½·2(ẋ + ẏ)²"


def test_what_is_shown_as_it_is_printed_is_not_collected() -> None:
    assert lines(TWO_SLIDES.replace("MASS", "m"), "Kv2") == []


def test_the_square_of_a_sum_of_decimals_stays_one() -> None:
    assert lines(BESIDE_THE_ARM, "Kv1")[-1] == "Collected:"


def test_products_beside_two_rates_are_multiplied_and_what_cancels_is_told() -> None:
    assert "+ b² q̇₁ q̇₂ + b² q̇₂²" in lines(LEANING_AXES, "Kv1")[-2]
    *_, leaning, cancelling = lines(ON_A_CONE, "Kv1")
    assert "(3r sin(W) cos(W)/2 - 3r sin(W) cos(W)/2)" in leaning
    assert "(the terms with " in cancelling and cancelling.endswith(" cancel):")


def test_a_number_has_its_unit_beside_letters() -> None:
    page = normal(PAN_TILT)
    assert "η₁ = 0.3 m" in page and "[0 0 -9.81]ᵀ m/s² g = 9.81 m/s²" in page


def test_an_identity_has_the_angle_of_the_lines() -> None:
    page = normal("""
gravity: [-g, 0, 0]
dh: [{theta: q1* + 45deg, a: a1, alpha: 180deg}, {theta: q2*, a: a2}]
masses: [{mass: m, link: 2, center: tip}]
""")
    assert "sin²(q₂ - q₁ - 45°) + cos²(q₂ - q₁ - 45°) = 1" in page and "q₁ - q₂" not in page
