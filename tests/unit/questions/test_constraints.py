"""Constraints: what is refused, dependent ones, what acts beside them, and that a wrong result is found."""

from __future__ import annotations

import unicodedata

import pytest
import sympy

import dynsolve
from dynsolve.derivation.graph import known
from dynsolve.errors import ProblemError, VerificationError
from dynsolve.explain.context import style_of
from dynsolve.notation.tree import Matrix, Negative
from dynsolve.notation.unicode import to_unicode
from dynsolve.problem.reader import find
from dynsolve.questions.constraints.check import verify_constraints
from dynsolve.render.files import Format
from dynsolve.solution.leading import leading
from dynsolve.solution.reports import report
from tests.support import numbers, solve_json

ELBOW = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]
"""
EVERYTHING = """
friction: {q1: fv}
springs: [{stiffness: k, of: q2}]
passive: [q2]
forces: [{link: 2, at: tip, force: [F, 0, 0]}]
points: {P: {link: 1, at: tip}}
constraints: [tip.y + P.x, {rates: q1' - cos(q2)*q2'}]
find: [Ac, Ac_dot, lambda]
"""
LINE = "constraints: [tip.x - k]\nfind: [Ac, Ac_dot, lambda]\n"


def test_it_is_told_where_the_multipliers_are_determined() -> None:
    """At s1 = s2 = 0 the tip moves across the line alone, so that the row of A_c is 0."""
    text = report(dynsolve.solve(ELBOW + LINE), Format.TEXT).decode()
    assert text.count("It is determined where 𝐀_c is not 0: not where s₁ = 0 and s₂ = 0.") == 2
    never = "model: {coordinates: {x: prismatic, y: prismatic}, bodies: [{mass: m, at: [x, y, 0]}]}\n"
    plane = report(dynsolve.solve(f"{never}constraints: [y - k*x]\nfind: [lambda]"), Format.TEXT).decode()
    assert "𝛌 = " in plane and "determined" not in plane


def test_where_the_energy_does_not_change_along_what_is_free_all_is_indifferent() -> None:
    level = f"{ELBOW}constraints: [l1*sin(q1) + l2*sin(q1 + q2) - k]\nfind: [equilibria]"
    text = report(dynsolve.solve(level.replace("{mass: m1, link: 1}, ", "")), Format.TEXT).decode()
    assert text.count("they allow is an equilibrium, and all are indifferent.") == 2
    assert "indifferent" not in report(dynsolve.solve(level), Format.TEXT).decode()


def test_the_summary_has_the_inertia_matrix_itself() -> None:
    """Not the formula by which it is assembled directly."""
    sledge = """
        gravity: none
        model:
          coordinates: {x: prismatic, y: prismatic, theta: revolute}
          bodies: [{mass: m, at: [x + d*cos(theta), y, 0], turn: theta, inertia: {zz: J}}]
        constraints: [{rates: "x'*sin(theta) - y'*cos(theta)"}]
        find: [D, reduced]
    """
    summary = report(dynsolve.solve(sledge), Format.TEXT).decode().partition("Summary")[2]
    assert "𝐉_v1" not in summary and "𝐃 = ⎢" in summary


def test_everything_that_acts_stands_in_the_multipliers() -> None:
    solution = dynsolve.solve(ELBOW + EVERYTHING)
    assert solution.to_json()["results"]["Ac"][1] == ["1", "-cos(q2)"]
    found = known(solution.values["lambda"])
    names = {found.ring.generators[k].name for one in found.entries for k in one.numerator.used}
    assert {"fv", "k", "F", "g", "tau1"} <= names and "tau2" not in names


@pytest.mark.parametrize("name", ["hc", "Ac", "Ac_dot", "lambda"])
def test_a_wrong_result_is_found(name: str) -> None:
    solution = dynsolve.solve(ELBOW + LINE)
    right = {n: solution.forms(n) for n in ("hc", "Ac", "Ac_dot", "lambda", "D", "Cqd", "g")}
    verify_constraints(solution.robot, right)
    form = right[name]
    assert isinstance(form, Matrix)
    wrong = Matrix(tuple(tuple(map(Negative, row)) for row in form.rows))
    with pytest.raises(VerificationError):
        verify_constraints(solution.robot, {**right, name: wrong})


def test_dependent_constraints_are_told_and_the_model_stands() -> None:
    text = ELBOW + "constraints: [q1 + q2 - a, 2*q1 + 2*q2 - b]\nfind: [D, lambda]\n"
    solution = dynsolve.solve(text)
    results = solution.to_json()["results"]
    assert "follows from the others" in results["lambda"]["skipped"]
    assert results["D"][1][1] == "m2*l2**2"
    assert any("lambda" in str(warning) for warning in solution.warnings)


def test_only_what_is_asked_is_worked_out() -> None:
    results = dynsolve.solve(ELBOW + "constraints: [tip.x - k]\nfind: [D]\n").to_json()["results"]
    assert "Ac" in results
    assert "lambda" not in results


@pytest.mark.parametrize(
    ("constraint", "message"),
    [
        ("k - l1", "no coordinate occurs"),
        ("tip.w", "has no meaning here"),
        ("Q.x - k", "there is no point Q"),
        ("1/q1", "in a denominator"),
        ("{rates: q1}", "no rate occurs"),
        ("{rates: q1'^2}", "not linear in the rates"),
        ("{rates: q1' + k}", "not linear in the rates"),
        ("{rates: q3'}", "q3"),
        ("{speed: q1'}", "rates"),
    ],
)
def test_what_is_no_constraint_is_refused(constraint: str, message: str) -> None:
    with pytest.raises(ProblemError, match=message):
        dynsolve.solve(ELBOW + f"constraints: [{constraint}]\n")


def test_it_does_not_matter_when_the_numbers_are_put_in() -> None:
    values = {"m1": "2", "m2": "1", "l1": "1/2", "l2": "1", "k": "3/4", "g": "10"}
    late = dynsolve.solve(ELBOW + LINE).with_values(**values)
    text = ELBOW + LINE
    for name, value in values.items():
        text = text.replace(f"mass: {name}", f"mass: {value}").replace(f"a: {name}", f"a: {value}")
    early = dynsolve.solve(text.replace("- k]", "- 3/4]").replace("-g", "-10")).to_json()["results"]["lambda"]
    state = {"q1": 0.3, "q2": 0.8, "q1_dot": 0.5, "q2_dot": -0.7, "tau1": 0.2, "tau2": 1.1}
    (found,) = late.to_json()["results"]["lambda"]
    assert numbers([found], state)[0] == pytest.approx(numbers(early, state)[0])


def reduced_rows(text: str) -> tuple[list[str], str]:
    """The equations of the step, and what stands above them."""
    (step,) = (step for step in dynsolve.solve(text).steps if step.id == "reduced")
    return [unicodedata.normalize("NFC", to_unicode(row)) for row in step.result], str(step.concluding)


def test_the_equations_without_multipliers_are_written_out() -> None:
    """m v̇ along the blade, with what drives it in this direction (by hand)."""
    text = find("knife-edge").read_text(encoding="utf-8").replace("lambda]", "lambda, reduced]")
    rows, told = reduced_rows(text)
    assert rows == ["m cos(φ) ẍ + m sin(φ) ÿ = f₂ sin(φ) + f₁ cos(φ)", "J φ̈ = τ₃"]
    assert "0 by" not in told


def test_they_are_worked_out_where_they_are_asked_for() -> None:
    assert "reduced" not in {step.id for step in dynsolve.solve("knife-edge").steps}


HOOP = """
gravity: [0, -g, 0]
model:
  coordinates: {r: prismatic, phi: revolute}
  bodies: [{mass: m, at: [r*sin(phi), -r*cos(phi), 0]}]
passive: [r, phi]
constraints: [r - R]
find: [reduced]
"""


def test_what_the_constraint_makes_zero_stands_in_no_equation() -> None:
    """2m r ṙ φ̇, where r is held (by hand)."""
    rows, told = reduced_rows(HOOP)
    assert rows == ["m r² φ̈ + m g r sin(φ) = 0"]
    assert "Multiplied out, with " in told and "0 by" not in told


SLIDE = """
model:
  coordinates: {x: prismatic, q: revolute}
  L: m*x'^2/2 + m*l*x'*q'*cos(q) + (m*l^2 + J)*q'^2/2
constraints: [x - r*q]
find: [reduced]
"""


ATWOOD = """
gravity: [0, -g, 0]
model:
  coordinates: {x1: prismatic, x2: prismatic}
  bodies: [{mass: m1, at: [0, -x1, 0]}, {mass: m2, at: [d, -x2, 0]}]
passive: [x1, x2]
constraints: [x1 + x2 - L]
find: [reduced]
"""
ROLLING = """
gravity: none
model:
  coordinates: {x: prismatic, y: prismatic, phi: revolute, psi: revolute}
  D: [[m, 0, 0, 0], [0, m, 0, 0], [0, 0, I, 0], [0, 0, 0, J]]
passive: [x, y]
constraints: [{rates: x' - R*cos(phi)*psi'}, {rates: y' - R*sin(phi)*psi'}]
find: [reduced]
"""


@pytest.mark.parametrize(
    ("text", "rows"),
    [
        (SLIDE, ["(m (l² + r² + 2l r cos(q)) + J) q̈ - m l r sin(q) q̇² = r f₁ + τ₂"]),
        (ATWOOD, ["(m₁ + m₂) ẍ₂ + g (m₁ - m₂) = 0"]),
        (ROLLING, ["I φ̈ = τ₃", "(m R² + J) ψ̈ = τ₄"]),
    ],
)
def test_what_the_constraints_give_is_put_in(text: str, rows: list[str]) -> None:
    """By hand: the equation of the slide is r times the first and the second, with ẍ = r q̈."""
    assert reduced_rows(text) == (rows, "('Put in:',)")


def test_before_that_no_equation_is_half_put_in() -> None:
    (step,) = (step for step in dynsolve.solve(SLIDE).steps if step.id == "reduced")
    before, given = (
        [unicodedata.normalize("NFC", to_unicode(row)) for row in line.formulas] for line in step.lines[1:]
    )
    assert before == ["m (r + l cos(q)) ẍ + (m (l² + l r cos(q)) + J) q̈ - m l r sin(q) q̇² = r f₁ + τ₂"]
    assert given == ["ẋ = r q̇", "ẍ = r q̈"]


def test_where_a_rate_takes_a_quotient_the_constraint_stands_beside_the_equations() -> None:
    (step,) = (
        step
        for step in dynsolve.solve(
            find("knife-edge").read_text(encoding="utf-8").replace("lambda]", "lambda, reduced]")
        ).steps
        if step.id == "reduced"
    )
    assert "as many equations as there are accelerations" in str(step.notes)


def test_what_stands_in_the_equations_without_multipliers_is_shown_before() -> None:
    solution = dynsolve.solve(SLIDE)
    told = [step.id for step in leading(solution, solution.steps)]
    assert {"D", "C", "g", "Ac"} <= set(told[: told.index("reduced")])


RAMP = """
gravity: [0, -g, 0]
model:
  coordinates: {x: prismatic, y: prismatic, s: prismatic}
  bodies: [{mass: m, at: [x, y, 0]}]
constraints: [x - s^2/R, y - s]
find: [D, Ac, Ac_dot, lambda]
"""
SLOT = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
masses: [{mass: m, link: 1}]
constraints: [tip.y]
find: [D, Cqd, g, Ac, Ac_dot, lambda]
"""


FIVE_BAR = """
gravity: none
dh:
  - {theta: q1*, a: l1}
  - {theta: q2*, a: l2}
  - {from: 0, a: c}
  - {from: 3, theta: q3*, a: l1}
  - {from: 4, theta: q4*, a: l2}
points: {A: {link: 2}, B: {link: 5}}
masses: [{mass: m, link: 1}, {mass: m, link: 4}]
constraints: [A.x - B.x, A.y - B.y]
passive: [q2, q4]
find: [D, tau, Ac, lambda, reduced]
"""


def test_where_both_systems_have_no_solution_is_told() -> None:
    """By hand: with the distal links in line their masses' motion does not fix the multipliers."""
    solution = dynsolve.solve(FIVE_BAR)
    steps = {step.id: step for step in solution.steps}
    told = str(steps["lambda"].concluding)
    assert "where the determinant of the matrix is not 0" in told
    (size,) = steps["lambda"].lines[-1].formulas
    assert "c₃₄ - c₁₂ s₃₄)²" in to_unicode(size, style_of(solution.robot))
    assert "𝐂" not in to_unicode(steps["lambda"].formula)
    rows = [unicodedata.normalize("NFC", to_unicode(row)) for row in steps["reduced"].result]
    assert rows == ["m l₁² q̈₁ = τ₁", "m l₁² q̈₃ = τ₃"]


def test_the_free_rates_are_shown_however_wide() -> None:
    text = report(dynsolve.solve(FIVE_BAR), Format.TEXT).decode()
    assert "Z₁₁ = " in text[text.index("The free rates:") :]


@pytest.mark.parametrize("text", [RAMP, SLOT])
def test_a_coordinate_without_mass_has_multipliers_as_any_other(text: str) -> None:
    """Against SymPy, which solves both systems together."""
    solution = dynsolve.solve(text)
    found = solution.to_json()["results"]
    read = {name: sympy.Matrix(sympy.sympify(found[name])) for name in ("D", "Ac", "Ac_dot")}
    coordinates = solution.robot.coordinates
    tau = sympy.Matrix(sympy.sympify(found["tau"]))
    still = {sympy.Symbol(q.acceleration): 0 for q in coordinates}
    forces = sympy.Matrix(sympy.symbols([q.force for q in coordinates])) - tau.subs(still)
    rates = sympy.Matrix(sympy.symbols([q.velocity for q in coordinates]))
    n, c = len(coordinates), read["Ac"].rows
    both = sympy.Matrix(sympy.BlockMatrix([[read["D"], -read["Ac"].T], [read["Ac"], sympy.zeros(c, c)]]))
    solved = both.LUsolve(sympy.Matrix([*forces, *(-read["Ac_dot"] * rates)]))
    assert read["D"].det() == 0
    assert sympy.simplify(sympy.Matrix(sympy.sympify(found["lambda"])) - solved[n:, :]) == sympy.zeros(c, 1)


def test_what_moves_no_mass_and_is_free_has_no_acceleration() -> None:
    why = dynsolve.solve(RAMP.replace("x - s^2/R, ", "x, ").replace("- s]", "- h]")).to_json()
    assert "moves no mass" in why["results"]["lambda"]["skipped"]


WHEEL = """
gravity: none
model:
  coordinates: {x: prismatic, y: prismatic, psi: revolute, phi: revolute}
  D: [[m, 0, 0, 0], [0, m, 0, 0], [0, 0, I, 0], [0, 0, 0, J]]
  P: 0
constraints: [{rates: x' - R*phi'*cos(psi)}, {rates: y' - R*phi'*sin(psi)}]
passive: [x, y]
find: [lambda]
"""


def test_what_a_denominator_divides_stands_apart() -> None:
    """Newton along y (by hand): m ÿ, with φ̈ = τ₄/(m R² + J)."""
    (step,) = (step for step in dynsolve.solve(WHEEL).steps if step.id == "lambda")
    told = unicodedata.normalize("NFC", to_unicode(step.result[0]))
    assert "m R cos(ψ) ψ̇ φ̇ + m R τ₄ sin(ψ)/(m R² + J)" in told


LADDER = """
gravity: [0, -g, 0]
model:
  coordinates: {x: prismatic, y: prismatic, th: revolute}
  bodies: [{mass: m, at: [x, y, 0], turn: th, inertia: {zz: J}}]
constraints: [x - L*cos(th), y - L*sin(th)]
find: [lambda]
"""


def test_the_factor_of_a_rate_is_cancelled_though_another_is_not() -> None:
    """(m L³ + J L)/(m L² + J) is L: θ̇² stands before the quotient."""
    found = dynsolve.solve(LADDER).to_json()["results"]["lambda"]
    for one, turned in zip(found, ("cos", "sin"), strict=True):
        assert f"m*L*{turned}(th)*th_dot**2" in one and "L**3" not in one


def test_what_is_kept_is_told_in_one_spelling() -> None:
    text = "model: {coordinates: {x: prismatic, y: prismatic}, D: [[m, 0], [0, m]]}\nconstraints: [y + c*x]\n"
    shown = report(dynsolve.solve(text + "find: [Ac]\n"), Format.TEXT).decode()
    assert "𝐡 = c x + y" in shown and "y + c x =" not in shown.partition("stays 0")[2]


AT_THE_EDGE = """
model:
  coordinates: {u: revolute, v: revolute}
  K: J*u'^2/2 + J*v'^2/2
  P: m*g*a*sin(u)
constraints: [a*sin(u) + b*sin(v) - h]
find: [equilibria]
"""


def test_where_nothing_can_move_nothing_is_said_to_fall() -> None:
    """At h = a + b the constraint leaves one configuration."""
    (_, above) = solve_json(AT_THE_EDGE)["results"]["equilibria_stability"]
    up = next(point for point in above if point.get("u") == "pi/2")
    assert up == {"u": "pi/2", "stability": "undecided", "unstable_if": ["b + h > a and a + b > h"]}
    shown = " ".join(report(dynsolve.solve(AT_THE_EDGE), Format.TEXT).decode().split())
    assert "at u = 90°, where b + h > a and a + b > h: not stable" in shown


def test_a_condition_that_is_0_all_along_decides_nothing() -> None:
    """On v = u + π the energy is 0, and what the condition comes to in numbers is rounding."""
    crossing = AT_THE_EDGE.replace("m*g*a*sin(u)", "k*(cos(u) + cos(v))").replace(
        "a*sin(u) + b*sin(v) - h", "sin(u) + sin(v)"
    )
    assert solve_json(crossing)["results"]["equilibria"] == [["sin(v - u) = 0", "sin(u) + sin(v) = 0"]]


def test_a_force_that_is_0_does_not_stand_beside_that_of_the_constraints() -> None:
    passive = report(dynsolve.solve(f"{ELBOW}passive: [q2]\n{LINE}"), Format.TEXT).decode()
    assert "    (𝐀_cᵀ 𝛌)₂ = d/dt" in passive and "τ₂ + " not in passive
    assert "τ₁ is what the motor does" in " ".join(passive.split())
    mass = "model: {coordinates: {x: prismatic, y: prismatic}, bodies: [{mass: m, at: [x, y, 0]}]}\n"
    text = report(dynsolve.solve(f"{mass}constraints: [x*y - k]\nfind: [lambda]"), Format.TEXT).decode()
    assert "f₁ and f₂ are the driving forces." in " ".join(text.split())
