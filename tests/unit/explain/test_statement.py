"""What is given and what is to be found, before the solution."""

from __future__ import annotations

import unicodedata
from typing import TypeGuard

import pytest

import dynsolve
from dynsolve.document import Block, Text
from dynsolve.explain.given import statement, to_be_found
from dynsolve.notation.unicode import to_unicode
from dynsolve.render.files import Format
from dynsolve.solution.documents import solution_document
from dynsolve.solution.dynamics import Dynamics
from dynsolve.solution.reports import report
from tests.support import solved

CASES = [
    (
        "in3140-rp",
        "Given: the table of the arm with a revolute and a prismatic joint and two rigid "
        "bodies: body 1 in link 1, of mass m₁, its mass centre half-way along the link, its axes "
        "those of the base turned by 𝐑_{z,θ1}; body 2 in link 2, a point of mass m₂ at 𝐨₂. The moment of "
        "inertia of body 1 about the axis through its mass centre parallel to 𝐳₀ is I_1zz. Gravity g acts "
        "along -𝐳₀; there is no friction.",
        "To be found: the generalized forces 𝛕, the inertia matrix 𝐃, the matrix of Coriolis and centrifugal "
        "terms 𝐂 and the gravity terms 𝐠.",
    ),
    (
        "puma560",
        "Given: the table of the arm with revolute joints, and mass, mass centre and inertia "
        "tensor of 6 rigid bodies. Gravity g acts along -𝐳₀; there is no friction. In numbers: "
        "a₂ = 0.4318 m, a₃ = 0.0203 m, d₃ = 0.15005 m and d₄ = 0.4318 m.",
        "To be found: the inertia matrix 𝐃, the matrix of Coriolis and centrifugal terms 𝐂, the gravity "
        "terms 𝐠 and the generalized forces 𝛕.",
    ),
    (
        "inf3480-rrp-drawn",
        "Given: the axes of the arm as they are drawn, in world coordinates. Joint 1, with "
        "the variable θ₁, turns about (0, 0, 1) "
        "through (0, 0, 0). Joint 2, with the variable θ₂, turns about (0, 1, 0) through (0, Loff, L₁). "
        "Joint 3, with the variable L₃, slides along (1, 0, 0) through (0, Loff, L₁ + L₂). In this pose the "
        "hand is at (L₃, Loff, L₁ + L₂).",
        "To be found: the Denavit-Hartenberg parameters, the task vector 𝐫, the linear part 𝐉_v of the "
        "Jacobian, the determinant det 𝐉_r "
        "and the singular configurations.",
    ),
    (
        "knife-edge",
        "Given: Body 1, of mass m, is at (x, y, 0). Body 1 turns by φ about the axis z. Its moment "
        "of inertia about axis z through its mass centre is J. There is no gravity, "
        "and no friction is given. Every motion keeps ẋ sin(φ) - ẏ cos(φ) = 0.",
        "To be found: the generalized forces 𝛕, the inertia matrix 𝐃, the matrix of Coriolis and "
        "centrifugal terms 𝐂, the gravity terms 𝐠, the matrix of the constraints 𝐀_c, the "
        "time derivative 𝐀̇_c of the matrix of the constraints and the multipliers 𝛌.",
    ),
]


AXES = {
    "Ry(90deg)": "its axes those of frame 1 turned by 𝐑_{y,90°}",
    "base": "its axes those of the base at 𝐪 = 𝟎",
    "{base: Rz(q1)}": "its axes those of the base turned by 𝐑_{z,q1}",
    "[[0, 1, 0], [-1, 0, 0], [0, 0, 1]]": (
        "its axes, seen from frame 1, along (0, -1, 0), (1, 0, 0) and (0, 0, 1)"
    ),
    "{base: [[cos(q1), -sin(q1), 0], [sin(q1), cos(q1), 0], [0, 0, 1]]}": (
        "its axes, seen from the base, along (c₁, s₁, 0), (-s₁, c₁, 0) and (0, 0, 1)"
    ),
}


@pytest.mark.parametrize("axes", AXES)
def test_it_is_told_how_the_axes_of_a_body_lie(axes: str) -> None:
    body = f"{{mass: m, link: 1, center: tip, inertia: {{xx: Ix, zz: Iz}}, axes: {axes}}}"
    given, *_ = stated(dynsolve.solve(f"dh: [{{theta: q1*, a: l}}]\nmasses: [{body}]\nfind: [D]\n"))
    assert f", {AXES[axes]}. Moments" in given


@pytest.mark.parametrize(("problem", "told"), [(name, told) for name, *told in CASES])
def test_the_exercise_is_stated_before_it_is_solved(problem: str, told: list[str]) -> None:
    assert stated(solved(problem)) == told


def stated(solution: Dynamics) -> list[str]:
    """The paragraphs of the statement, as text."""
    return [
        " ".join(
            "".join(
                part if isinstance(part, str) else to_unicode(part, solution.style) for part in block.parts
            ).split()
        )
        for block in (
            *statement(solution.forms, solution.problem),
            *to_be_found(solution.forms, solution.problem),
        )
        if isinstance(block, Text)
    ]


ARM = """
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
masses:
  - {mass: m1, link: 1, center: {near: [0, -e, 0]}, inertia: {zz: I1}}
  - {mass: m2, link: 2, center: %s}
"""

PLACES = [
    ("tip", "a point of mass m₂ at 𝐨₂"),
    ("origin", "a point of mass m₂ at 𝐨₂"),
    ("midpoint", "a point of mass m₂ half-way along the link"),
    ("{near: [lc, 0, 0]}", "a point of mass m₂ at l_c from 𝐨₁ along 𝐱₂"),
    ("{near: [0, 0, 0]}", "a point of mass m₂ at 𝐨₁"),
    ("{along: 2/3}", "a point of mass m₂ ⅔ of the way from 𝐨₁ to 𝐨₂"),
    ("[0, -e, 0]", "a point of mass m₂ at e from 𝐨₂ along -𝐲₂"),
    ("[0.25, 0, 0]", "a point of mass m₂ at 0.25 m from 𝐨₂ along 𝐱₂"),
    ("[e, 0, h]", "a point of mass m₂ at (e, 0, h) from 𝐨₂ along the axes of frame 2"),
]


@pytest.mark.parametrize(("center", "told"), PLACES)
def test_the_statement_says_where_a_mass_centre_is(center: str, told: str) -> None:
    (given, _) = stated(solved(ARM % center))
    assert "its mass centre at e from 𝐨₀ along -𝐲₁" in given
    assert told in given


def test_the_statement_says_which_angles_of_the_table_are_not_right() -> None:
    (given, *_) = stated(solved("dh:\n- {theta: q1* + 30deg, alpha: 90deg}\n- {theta: q2*, alpha: 45deg}"))
    assert "In the table θ of row 1 is q₁ + 30° and α of row 2 is 45°." in given


PLACED = [
    (
        "base: {rotate: Rx(30deg), move: [0, 0, h0]}",
        "Frame 0 is moved by h₀ along 𝐳_w and turned by 30° about 𝐱_w in the world w. ",
    ),
    (
        "base: Rz(90deg) Rx(30deg)",
        "Frame 0 is turned by 90° about 𝐳_w and by 30° about its own x-axis in the world w.",
    ),
    ("base: [[0, -1, 0], [1, 0, 0], [0, 0, 1]]", "Frame 0, seen from the world w, is "),
]


@pytest.mark.parametrize(("base", "told"), PLACED)
def test_the_statement_says_how_the_base_is_placed(base: str, told: str) -> None:
    (given, *_) = stated(solved(f"{base}\n{ARM % 'tip'}"))
    assert told.rstrip() in given


def test_the_statement_says_about_which_axis_a_body_turns() -> None:
    body = "{mass: m, at: [0, 0, 0], turn: p, about: [0, -3, 4], inertia: {zz: A}}"
    (given, _) = stated(solved(f"\nmodel: {{coordinates: {{p: revolute}}, bodies: [{body}]}}"))
    assert "Body 1 turns by p about the axis along (0, -3/5, 4/5)." in given.replace("\u00a0", " ")


MOMENTS = [
    ("numeric-2r", "about the axis through its mass centre parallel to 𝐳₂ is 0.02 kg m². "),
    ("planar-2r", "parallel to 𝐳₁ is I₁; that of body 2, about such an axis parallel to 𝐳₂, is I₂. "),
    (
        "spherical-rrp",
        "body 1 has I₁ about that parallel to 𝐳₀; body 2 has I₂ about those parallel to 𝐱₂ and 𝐲₂; "
        "the other entries of these tensors are taken as 0. ",
    ),
    (
        "gravity: none\ndh: [{theta: q1*, a: l1}]\n"
        "masses: [{mass: m, link: 1, center: tip, inertia: {xx: A, yy: B, zz: B}}]\n",
        "body 1 has A about that parallel to 𝐱₁ and B about those parallel to 𝐲₁ and 𝐳₁; ",
    ),
]


@pytest.mark.parametrize(("problem", "told"), MOMENTS)
def test_the_statement_says_which_moments_are_given(problem: str, told: str) -> None:
    assert told in stated(solved(problem))[0]


SHAPES = [
    ("{cylinder: {radius: r, length: h}}", "solid cylinder of mass m, radius r and length h along 𝐱₁, its"),
    ("{box: {x: b, y: b, z: h}}", "solid of mass m and sides b, b and h along 𝐱₁, 𝐲₁ and 𝐳₁, its"),
    ("{sphere: {radius: 0.1}}", "solid sphere of mass m and radius 0.1 m, its"),
    ("{disk: {radius: r}}", "thin disk of mass m and radius r, its axis along 𝐳₁, its"),
]


@pytest.mark.parametrize(("shape", "told"), SHAPES)
def test_the_statement_says_how_large_a_shape_is(shape: str, told: str) -> None:
    body = f"{{mass: m, link: 1, center: midpoint, shape: {shape}}}"
    (given, *_) = stated(solved(f"dh: [{{theta: q1*, a: l1}}]\nmasses: [{body}]"))
    assert told in given
    assert "oment of inertia" not in given, "the shape tells it"


DENSITIES = [
    ("{cylinder: {radius: r, length: l, axis: x, density: k*x}}",
     "solid cylinder of mass per volume k x at the distance x from its near end, radius r and length l"),
    ("{box: {x: l, y: b, z: b, axis: x, density: k*x}}",
     "solid of mass per volume k x at the distance x from its near end and sides l, b and b along"),
    ("{rod: {length: l, density: k}}", "slender rod of mass per length k and length l along 𝐱₁"),
]  # fmt: skip


@pytest.mark.parametrize(("shape", "told"), DENSITIES)
def test_the_statement_says_how_dense_a_body_is(shape: str, told: str) -> None:
    (given, _) = stated(solved(f"dh: [{{theta: q1*, a: l}}]\nmasses: [{{link: 1, shape: {shape}}}]"))
    assert told in given


ACTING = [
    ("gravity: [0, 0, 0]", "There is no gravity and no friction."),
    ("gravity: [g, 0, 0]", "Gravity g acts along 𝐱₀; there is no friction."),
    ("gravity: [0, -9.81, 0]", "Gravity, 9.81 m/s², acts along -𝐲₀; there is no friction."),
    (
        "gravity: [0, 0, -g]\nbase: {rotate: Rx(30deg)}",
        "Gravity g acts along -𝐳_w; there is no friction.",
    ),
    (
        "gravity: [g1, 0, -g2]",
        "The acceleration of gravity is 𝐠₀ = (g₁, 0, -g₂) along the axes of frame 0; there is no friction.",
    ),
    (
        "friction: {q1: {viscous: b1}}",
        "Gravity g acts along -𝐳₀. On q₁ acts viscous friction of coefficient b₁.",
    ),
]


@pytest.mark.parametrize(
    ("coordinates", "body", "friction"),
    [
        ("{x: prismatic}", "at: [x, 0, 0], turn: -x/R", "no friction is given"),
        ("{a: revolute}", "at: [R*a, 0, 0], turn: -a", "no friction is given"),
        ("{a: revolute}", "at: [(R - r)*sin(a), 0, 0], turn: -a*(R - r)/r", "no friction is given"),
        ("{a: revolute}", "at: [R*sin(a), 0, 0], turn: a", "there is no friction"),
        ("{x: prismatic}", "at: [x*cos(b), 0, x*sin(b)]", "there is no friction"),
    ],
)
def test_of_what_rolls_it_is_not_said_that_there_is_no_friction(
    coordinates: str, body: str, friction: str
) -> None:
    inertia = ", inertia: {zz: J}" * ("turn" in body)
    bodies = f"[{{mass: m, {body}{inertia}}}]"
    (given, _) = stated(
        solved(f"gravity: [0, 0, -g]\nmodel: {{coordinates: {coordinates}, bodies: {bodies}}}\n")
    )
    assert given.endswith(f"{friction}.")


@pytest.mark.parametrize(("keys", "told"), ACTING)
def test_the_statement_says_what_acts(keys: str, told: str) -> None:
    (given, _) = stated(solved(f"{keys}\n{ARM % 'tip'}"))
    assert given.endswith(told)


def test_a_link_of_a_tree_begins_where_its_row_starts() -> None:
    """Link 2 of the five-bar linkage is carried by the ground: Spong 7.4, figure 7.10."""
    (given, _) = stated(solved("five-bar"))
    assert "body 2 in link 2, of mass m₂, its mass centre at l_c2 from 𝐨₀ along 𝐱₂" in given


def test_a_part_of_a_solution_has_no_statement() -> None:
    def texts(stages: list[str] | None) -> str:
        document = solution_document(solved("planar-2r"), stages=stages)
        return "".join(block.parts[0] for block in document.blocks if is_words(block))

    assert "To be found: " in texts(None)
    assert "To be found: " not in texts(["jacobian"])


def is_words(block: Block) -> TypeGuard[Text]:
    return isinstance(block, Text) and isinstance(block.parts[0], str)


LOADED = "gravity: none\ndh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]\nfind: [tau_static]\nforces:\n  - "


@pytest.mark.parametrize(
    ("load", "told"),
    [
        ("{link: 2, at: tip, force: [F, 0, 0]}", "The force (F, 0, 0) acts on link 2 at the tip."),
        ("{link: 1, at: [-a, 0, 0], force: [F, 0, 0]}", "acts on link 1 at (-a, 0, 0) in frame 1."),
        ("{link: 2, moment: [0, 0, M]}", "The moment (0, 0, M) acts on link 2."),
        (
            "{link: 2, at: tip, force: [F, 0, 0], moment: [0, 0, M], by: robot}",
            "Link 2 exerts the force (F, 0, 0) and the moment (0, 0, M) at the tip.",
        ),
    ],
)
def test_a_force_from_outside_is_told_with_who_exerts_it_and_where(load: str, told: str) -> None:
    assert told in stated(solved(LOADED + load))[0]


ASKED = """
gravity: none
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}, {d: q3*}]
masses: [{mass: m, link: 3, center: origin}]
points: {P: {link: 2, at: {near: [lp, 0, 0]}}, E: {link: 1, at: tip}}
springs: [{stiffness: 30, of: q3, rest: 2}]
dampers: [{damping: 2, of: q2 - q1}]
friction: {q1: {viscous: 3, coulomb: 4}}
forces: [{link: 3, at: tip, force: [0, 0, -10], moment: [0, 0, 5]}]
state: {q1: 30deg, q3: 1/2, q1': 2, q3': 3}
limits: {q3: [0, 1/2]}
task: [P.x, P.y]
velocity: [0, v]
weights: {q1: 2}
find: [Q, qd, pP, pE]
"""

TOLD = [
    "Point P of link 2 is at l_p from 𝐨₁ along 𝐱₂. Point E of link 1 is at 𝐨₁.",
    "A spring of stiffness 30 N/m is at rest at q₃ = 2 m.",
    "A damper of coefficient 2 N m s/rad acts",
    "viscous friction of coefficient 3 N m s/rad and Coulomb friction of coefficient 4 N m",
    "The force (0, 0, -10) N and the moment (0, 0, 5) N m act on link 3 at the tip.",
    "Limits: 0 ≤ q₃ ≤ ½ m.",
    "The state: q₁ = 30°, q₃ = ½ m, q̇₁ = 2 rad/s, q̇₃ = 3 m/s.",
    "The weights are 𝐖 = [[2, 0, 0], [0, 1, 0], [0, 0, 1]]",
]


@pytest.mark.parametrize("told", TOLD)
def test_points_weights_and_units_are_given(told: str) -> None:
    solution = solved(ASKED)
    words = " ".join(
        part if isinstance(part, str) else to_unicode(part, solution.style)
        for block in statement(solution.forms, solution.problem)
        for part in (block.parts if isinstance(block, Text) else getattr(block, "node", ()) and (block.node,))
    )
    assert told.replace(" ", "") in words.replace(" ", "")


def test_a_rate_that_is_kept_is_given() -> None:
    hoop = """
dh: [{theta: phi*, alpha: 90deg}, {theta: theta* - 90deg, a: r}]
masses: [{mass: m, link: 2}]
steady: {phi: W}
find: [equilibria]
"""
    assert "The motion keeps φ̇ = W." in stated(solved(hoop))[0]


def test_bodies_of_a_drawing_are_given() -> None:
    drawn = """
axes: [{turn: q1, about: [0, 0, 1], through: [0, 0, 0]}, {slide: d2, along: [1, 0, 0]}]
tip: [a + d2, 0, 0]
zero: drawn
masses: [{mass: m1, link: 1, center: {drawn: [b/2, 0, 0]}}, {mass: m2, link: 2, center: tip}]
"""
    told = "body 1 in link 1, a point of mass m₁ at (b/2, 0, 0) in this pose; body 2 in link 2, a point"
    assert told in stated(solved(drawn))[0]


ORDERS = [
    ("dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]", ""),
    ("dh: [{theta: q1*, a: l1}, {theta: q3*, a: l2}]", "Index 2 stands for q₃: τ₂ belongs to q₃."),
    (
        "coordinates: [q2, q1]\ndh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]",
        "Indices 1 and 2 stand for q₂ and q₁: τ₁ belongs to q₂.",
    ),
    ("dh: [{theta: phi*, a: l1}, {theta: psi*, a: l2}]", ""),
]


@pytest.mark.parametrize(("table", "told"), ORDERS)
def test_an_index_that_is_not_the_number_of_its_coordinate_is_told(table: str, told: str) -> None:
    given = stated(solved(f"gravity: [0, -g, 0]\n{table}\nmasses: [{{mass: m, link: 2}}]"))[0]
    assert told in given
    assert ("stand" in given) == bool(told)


def test_a_tensor_about_another_point_is_given() -> None:
    problem = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}]
masses: [{mass: m, link: 1, center: {near: [c, 0, 0]}, inertia: {zz: J}, about: joint}]
"""
    solution = solved(problem)
    assert (
        "The moment of inertia of body 1 about the axis through 𝐨₀ parallel to 𝐳₁ is J."
        in stated(solution)[0]
    )


def masses_given(masses: list[str]) -> str:
    rows = "".join(f"  - {{theta: q{i + 1}*, a: l}}\n" for i in range(len(masses)))
    bodies = "".join(
        f"  - {{mass: {mass}, link: {i + 1}, center: tip, inertia: {{zz: J}}}}\n"
        for i, mass in enumerate(masses)
    )
    return stated(solved(f"dh:\n{rows}masses:\n{bodies}"))[0]


def test_a_mass_that_is_no_letter_has_one_in_formulas_which_is_told() -> None:
    few, many = masses_given(["2*M", "0", "M"]), masses_given(["2", "0.5", "M", "M", "0"])
    assert [mass for mass in ("m₁ = 2M", "m₂ = 0", "of mass M") if mass not in few] == []
    assert "5 rigid bodies, m₁ = 2 kg, m₂ = 0.5 kg and m₅ = 0." in many


def test_energies_are_given_as_they_are_in_the_file() -> None:
    K = "0.5*m*L^2*(2*a'^2 + b'^2 + 2*a'*b'*cos(a - b))"
    text = f"model:\n  coordinates: {{a: revolute, b: revolute}}\n  K: {K}\n  P: -m*g*L*cos(a)\nfind: [D]\n"
    told = unicodedata.normalize("NFC", stated(solved(text))[0])
    assert told == "Given: 𝒦 = ½ m L² (2ȧ² + ḃ² + 2ȧ ḃ cos(a - b)). 𝒫 = -m g L cos(a)."


def test_without_masses_nothing_of_the_dynamics_is_to_be_found() -> None:
    *_, last = stated(solved("base: Rx(90deg)\ndh: [{theta: q1*, a: l1}]\n"))
    assert last == "To be found: 𝐇₁^w and the Jacobian 𝐉."


def test_no_cosine_is_written_as_a_length_is() -> None:
    """A length c₂ beside cos t₁: c₁ would be read as another length."""
    text = "dh: [{theta: t1*, a: c2}]\nmasses: [{mass: m, link: 1}]\nfind: [tau]\n"
    told = report(dynsolve.solve(text), Format.TEXT).decode()
    assert "cos(t₁)" in told and "c₁" not in told
