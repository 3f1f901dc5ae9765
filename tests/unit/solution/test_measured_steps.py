"""A model in numbers: what is rounded has ≈ before it, what stands alone has its unit."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise

import pytest
from msgspec.structs import replace

from dynsolve.explain.step import Step
from dynsolve.notation.tree import Node, Number, Relation, walk
from dynsolve.notation.unicode import to_unicode
from dynsolve.solution.documents import measured_steps
from tests.support import solved


def steps() -> dict[str, Step]:
    solution = solved("numeric-2r")
    return {step.id: step for step in measured_steps(solution.explain(), solution.robot, solution.style)}


def shown(node: Node) -> str:
    return to_unicode(node, solved("numeric-2r").style)


@pytest.mark.parametrize(
    ("step", "printed"),
    [
        ("I_body1", "𝐈₁ ≈ [[0, 0, 0], [0, 0.0520833, 0], [0, 0, 0.0520833]] kg m²"),  # 2.5·0.5²/12
        ("I_body2", "𝐈₂ = [[0, 0, 0], [0, 0, 0], [0, 0, 0.02]] kg m²"),
        ("P1", "P₁ = 6.13125 s₁"),  # ends within the six digits
        ("K1", "K₁ ≈ ½·0.208333 q̇₁²"),  # half the inertia about the joint, as in D
        ("D", "𝐃 ≈ [[0.862833 + 0.48 c₂, 0.167 + 0.24 c₂], [0.167 + 0.24 c₂, 0.167]] kg m²"),
        ("g", "𝐠 = [[15.696 c₁ + 4.7088 c₁₂], [4.7088 c₁₂]] N m"),
        ("rc1", "𝐫_c1 = [[0.25 c₁], [0.25 s₁], [0]] m"),
        ("v1", "𝐯₁ = [[-0.25 s₁ q̇₁], [0.25 c₁ q̇₁], [0]] m/s"),
        ("Dw1", "𝐉_ω1ᵀ 𝓘₁ 𝐉_ω1 ≈ [[0.0520833, 0], [0, 0]] kg m²"),
        ("Cqd", "𝐂 𝐪̇ = [[-0.24 s₂ (2q̇₁ q̇₂ + q̇₂²)], [0.24 s₂ q̇₁²]] N m"),
        ("C", "𝐂 = [[-0.24 s₂ q̇₂, -0.24 s₂ (q̇₁ + q̇₂)], [0.24 s₂ q̇₁, 0]] kg m²/s"),
        ("H1", "𝐇₁⁰ = 𝐀₁ = [[c₁, -s₁, 0, 0.5 c₁], [s₁, c₁, 0, 0.5 s₁], [0, 0, 1, 0], [0, 0, 0, 1]]"),
    ],
)
def test_results(step: str, printed: str) -> None:
    assert shown(steps()[step].result[0]) == printed


def test_given_numbers_have_their_units() -> None:
    found = steps()
    assert shown(found["I_body1"].working[0]) == "m = 2.5 kg, l = 0.5 m"
    assert "m₁ = 2.5 kg, g = 9.81 m/s²" in map(shown, found["P1"].further)
    assert shown(found["P1"].further[0]) == "𝐠₀ = [[0, -9.81, 0]]ᵀ m/s²"
    assert shown(found["A1"].working[0]) == "θ = q₁⋆, d = 0, a = 0.5 m, α = 0"
    assert shown(found["rc2"].further[0]) == "𝐫_{1,c2}² = [[0.15], [0], [0]] m"


def test_a_given_number_of_many_digits_is_rounded_where_it_is_printed() -> None:
    problem = """
dh: [{theta: q1*, a: 0.5}]
masses: [{mass: 1.5, link: 1, center: {near: [0.12345678, 0, 0]}, inertia: {zz: 0.02}}]
gravity: [0, -9.81, 0]
"""
    solution = solved(problem)
    style = replace(solution.style, digits=6)
    found = {step.id: step for step in measured_steps(solution.explain(), solution.robot, style)}
    (given,) = found["rc1"].further
    assert to_unicode(given, style).endswith(" ≈ [[0.123457], [0], [0]] m")


def test_a_line_keeps_the_steps_that_go_into_it() -> None:
    (line,) = (line for line in steps()["Kw1"].lines if line.uses)
    assert line.uses == ("I_body1",)


def test_of_a_sum_the_number_that_comes_out_has_its_unit() -> None:
    printed = list(map(shown, steps()["D_sum"].result))
    assert printed[1].endswith("= 0.167 + 0.24 c₂")
    assert printed[2] == "d₂₂ = 0.027 + 0.02 + 0.12 = 0.167 kg m²"


def test_equality_is_never_claimed_for_what_is_rounded() -> None:
    """= stands between members of which every number is written whole."""
    style = solved("numeric-2r").style
    for step in steps().values():
        for node in (*step.working, *step.result, *(f for line in step.lines for f in line.formulas)):
            if isinstance(node, Relation):
                rounded = [
                    any(isinstance(p, Number) and style.rounds(p) for p in walk(part)) for part in node.parts
                ]
                assert [
                    sign for sign, (a, b) in zip(node.signs, pairwise(rounded), strict=True) if a or b
                ] == ["≈"] * sum(a or b for a, b in pairwise(rounded))


def test_the_digits_that_are_shown_add_up() -> None:
    """The terms of d_11, as they are printed, come to its printed value, to half its last digit."""
    (line,) = (f for f in steps()["D_sum"].result if isinstance(f, Relation) and shown(f).startswith("d₁₁"))
    terms, value = (shown(part).split(" + ") for part in line.parts[-2:])
    constants = [sum(Fraction(term) for term in part if " " not in term) for part in (terms, value)]
    assert abs(constants[0] - constants[1]) <= Fraction("0.0000005")


def test_a_model_in_symbols_stays_as_it_is() -> None:
    solution = solved("planar-2r")
    plain = tuple(solution.explain())
    assert tuple(measured_steps(plain, solution.robot, solution.style)) == plain
