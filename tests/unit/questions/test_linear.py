"""Linearization and the inertia of the task: against SymPy, exams, and the checks on numbers."""

from __future__ import annotations

import math

import pytest
import sympy

import dynsolve
from dynsolve.derivation.rules import derive
from dynsolve.errors import VerificationError
from dynsolve.explain.forms import Forms
from dynsolve.notation.python import to_python
from dynsolve.notation.template import formula
from dynsolve.notation.tree import Matrix, Relation, Symbol, mapped, walk
from dynsolve.problem import read_problem
from dynsolve.questions.equilibria.linear_check import verify_linear
from dynsolve.questions.task_inertia.check import verify_task_inertia
from dynsolve.render.files import Format
from dynsolve.solution.reports import report
from tests.support import numbers, solve_json

ARM = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]
friction: {q1: {viscous: f1, coulomb: c1}, q2: f2}
passive: [q2]
linearize: {q1: 60deg, q2: 30deg}
find: [linear_A, linear_B]
"""
RODS = """
gravity: none
dh: [{theta: q1*, a: L}, {theta: q2*, a: L}, {theta: q3*, a: L}]
masses:
  - {mass: m, link: 1, shape: {rod: {length: L, axis: x}}, center: midpoint}
  - {mass: m, link: 2, shape: {rod: {length: L, axis: x}}, center: midpoint}
  - {mass: m, link: 3, shape: {rod: {length: L, axis: x}}, center: midpoint}
task: [tip.x, tip.y]
find: [Lambda]
"""


def results(text: str) -> dict[str, list[list[str]]]:
    return dynsolve.solve(text).to_json()["results"]


def test_linearization_is_that_of_sympy() -> None:
    found = results(ARM)
    q, rates, tau = sympy.symbols("q1 q2"), sympy.symbols("q1_dot q2_dot"), sympy.symbols("tau1 tau2")
    names = {str(s): s for s in (*q, *rates)} | {"sgn": lambda x: 0}
    D = sympy.Matrix(sympy.sympify(found["D"], names))
    left = sympy.Matrix(sympy.sympify(found["tau"], {**names, "q1_ddot": 0, "q2_ddot": 0}))
    at = {q[0]: sympy.pi / 3, q[1]: sympy.pi / 6, rates[0]: 0, rates[1]: 0}
    accelerations = D.inv() * (sympy.Matrix(tau) - left)
    held = dict(zip(tau, left.subs(at), strict=True))
    theirs = accelerations.jacobian([*q, *rates]).subs(at).subs(held)
    ours = sympy.Matrix(sympy.sympify(found["linear_A"]))[2:, :]
    assert sympy.simplify(ours - theirs) == sympy.zeros(2, 4)
    inputs = D.inv().subs(at)[:, 0]
    assert sympy.simplify(sympy.Matrix(sympy.sympify(found["linear_B"]))[2:, :] - inputs) == sympy.zeros(2, 1)


def test_no_equilibrium_is_told() -> None:
    found = results(ARM.replace("q1: 60deg, q2: 30deg", "q1: 60deg, q2: 0"))
    why = "the given state is no equilibrium: gravity moves q₂, which no motor holds"
    assert found["linear_A"] == {"skipped": why}


def test_the_inertia_of_the_task_of_the_exam() -> None:
    """Sapienza, Robotics 2, 10 September 2021: 35/3 and 35/24 at (90°, 90°, 0), m = 5, L = 0.5."""
    found = results(RODS)["Lambda"]
    at = {"q1": math.pi / 2, "q2": math.pi / 2, "q3": 0.0, "m": 5.0, "L": 0.5}
    names = {"sin": math.sin, "cos": math.cos, **at}
    numbers = [[eval(entry, {"__builtins__": {}}, names) for entry in row] for row in found]  # noqa: S307
    assert numbers[0][0] == pytest.approx(35 / 3)
    assert numbers[1][1] == pytest.approx(35 / 24)
    assert numbers[0][1] == pytest.approx(0, abs=1e-12) == numbers[1][0]


def test_of_a_square_jacobian() -> None:
    text = "dh: [{d: d1*, alpha: 90deg}, {d: d2*}]\nmasses: [{mass: m1, link: 1, center: origin}, "
    text += "{mass: m2, link: 2, center: origin}]\ntask: [tip.z, tip.y]\nfind: [Lambda]\n"
    assert results(text)["Lambda"] == [["m1 + m2", "0"], ["0", "m2"]]
    dependent = text.replace("[tip.z, tip.y]", "[tip.z, 2*tip.z]")
    assert results(dependent)["Lambda"] == {"skipped": "the Jacobian of the task has dependent rows"}


def test_the_inertia_of_a_task_is_told_with_the_poses_in_which_there_is_one() -> None:
    """It is m 𝟏 of a point mass that moves everywhere, but where the arm is singular."""
    rows = "{theta: q1*, d: h, alpha: 90deg}, {theta: q2* + 90deg, alpha: 90deg}, {d: q3*}"
    text = f"gravity: none\ndh: [{rows}]\nmasses: [{{mass: m, link: 3}}]\nfind: [Lambda]\n"
    told = report(dynsolve.solve(text), Format.TEXT).decode()
    assert told.count("It exists where q₃ c₂ ≠ 0.") == 2
    spare = "gravity: none\ndh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}, {theta: q3*, a: l3}]\n"
    spare += "masses: [{mass: m1, link: 1}, {mass: m2, link: 2}, {mass: m3, link: 3}]\n"
    told = report(dynsolve.solve(spare + "task: [tip.x, tip.y]\nfind: [Lambda]\n"), Format.TEXT).decode()
    assert told.count("the rows of 𝐉_r are independent: not where s₃ = 0 and s₂ = 0.") == 2
    told = report(dynsolve.solve(spare + "task: [q1 + q2 + q3]\nfind: [Lambda]\n"), Format.TEXT).decode()
    assert "𝚲 = " in told and "xists" not in told


@pytest.mark.parametrize(("text", "name"), [(ARM, "linear_A"), (ARM, "linear_B"), (RODS, "Lambda")])
def test_the_check_finds_a_wrong_entry(text: str, name: str) -> None:
    robot = read_problem(text).robot
    forms = Forms(robot, derive(robot))
    right = {one: forms(one) for one in ((name, "Jr", "D") if name == "Lambda" else (name, "D", "tau"))}
    verify = verify_task_inertia if name == "Lambda" else verify_linear
    verify(robot, right)
    shown = right[name]
    assert isinstance(shown, Matrix)
    last = (*shown.rows[-1][:-1], Symbol(robot.parameters[0]))
    with pytest.raises(VerificationError, match=name):
        verify(robot, {**right, name: Matrix((*shown.rows[:-1], last))})


def test_the_steps_name_the_book() -> None:
    steps = {step.id: step for step in dynsolve.solve(ARM).steps if step.stage == "equilibria"}
    assert list(steps) == ["linear_A", "linear_B"]
    assert all("Slotine" in step.source for step in steps.values())
    assert "Coulomb" in str(steps["linear_A"].notes)


def test_the_inertia_of_the_task_may_be_singular_where_the_equations_are_linearized() -> None:
    stretched = ARM.replace("q2: 30deg", "q2: 0").replace("find: [", "task: [tip.x, tip.y]\nfind: [Lambda, ")
    assert "linear_A" in results(stretched)


def test_the_inertia_of_the_task_is_led_to_by_what_is_inverted() -> None:
    text = "gravity: none\ndh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]\n"
    text += "masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]\nfind: [Lambda]\n"
    (square,) = (step for step in dynsolve.solve(text).steps if step.id == "Lambda")
    (line,) = square.working
    assert isinstance(line, Relation) and line.parts[0] == formula("𝐉_r⁻¹")
    (wide,) = (step for step in dynsolve.solve(f"{text}task: [tip.x]\n").steps if step.id == "Lambda")
    (line,) = wide.working
    assert isinstance(line, Relation) and line.parts[0] == formula("𝐉_r 𝐃⁻¹ 𝐉_rᵀ")
    held = results(f"{text}constraints: [tip.y]\n")
    assert held["Lambda"] == {"skipped": "a force at the task meets the constraints, too"}


def test_a_force_from_outside_turns_the_linear_model() -> None:
    """A weight W at the end of a rod: l (m g/2 + W) cos q is held, and d = m l²/3."""
    rod = """
gravity: [0, -g, 0]
dh: [{theta: q*, a: l}]
masses: [{mass: m, link: 1, center: midpoint, shape: {rod: {length: l}}}]
forces: [{link: 1, at: tip, force: [0, -W, 0]}]
linearize: {q: 30deg}
find: [linear_A]
"""
    at = {"g": 9.81, "l": 0.7, "m": 1.3, "W": 2.0}
    found = numbers(solve_json(rod)["results"]["linear_A"][1][0], at)
    assert found == pytest.approx(
        at["l"] * (at["m"] * at["g"] / 2 + at["W"]) / 2 / (at["m"] * at["l"] ** 2 / 3)
    )


def test_beside_a_steady_motion_it_says_that_it_is_about_rest() -> None:
    steady = "find: [linear_A, equilibria]\nsteady: {q1: W}\n"
    arm = (
        "gravity: [0, 0, -g]\ndh: [{theta: q1*, alpha: 90deg}, {theta: q2*, a: l}]\n"
        "masses: [{mass: m, link: 2}]\nlinearize: {q1: 0, q2: 0}\n"
    )
    said = "The equilibrium is one at rest"
    assert said in dynsolve.solve(arm + steady).to_markdown()
    assert said not in dynsolve.solve(arm + "find: [linear_A]\n").to_markdown()


def test_an_angle_of_a_rolled_distance_is_taken_at_the_equilibrium() -> None:
    """A disk with a mass e from its centre, turned upside down, x = π R (by hand)."""
    disk = """
gravity: [0, -g, 0]
model:
  coordinates: {x: prismatic}
  bodies:
    - {mass: M, at: [x, R, 0], turn: -x/R, about: [0, 0, 1], inertia: {zz: J}}
    - {mass: m, at: [x + e*sin(x/R), R + e*cos(x/R), 0]}
linearize: {x: pi*R}
find: [linear_A, linear_B]
"""
    found = dynsolve.solve(disk).to_json()["results"]
    assert found["linear_A"][1][0] == "-m*g*e/(M*R**2 + m*(R - e)**2 + J)"
    assert found["linear_B"][1][0] == "R**2/(M*R**2 + m*(R - e)**2 + J)"


@pytest.mark.parametrize(
    ("place", "wire", "expected"),
    [
        ("a", "x/a", "(m*g*h*cos(1) - a**2*k)/(m*(a**2 + h**2*sin(1)**2))"),
        ("0.3", "x/2", "(m*g*h*cos(3/20) - 4*k)/(m*(4 + h**2*sin(3/20)**2))"),
        ("pi*a/2", "x/a", "-a**2*k/(m*(h**2 + a**2))"),
    ],
)
def test_a_length_in_an_angle_counts_radians(place: str, wire: str, expected: str) -> None:
    """A bead on y = h cos(x/a): A₂₁ = -(k - m g h cos(x/a)/a²)/(m (1 + h² sin²(x/a)/a²)) (by hand)."""
    bead = f"""
gravity: [0, -g, 0]
model: {{coordinates: {{x: prismatic}}, bodies: [{{mass: m, at: [x, h*cos({wire}), 0]}}]}}
springs: [{{stiffness: k, of: x}}]
linearize: {{x: {place}}}
find: [linear_A]
"""
    solution = dynsolve.solve(bead)
    assert solution.to_json()["results"]["linear_A"][1][0] == expected
    assert solution.steps


def test_where_the_state_is_no_equilibrium_there_is_no_b_either() -> None:
    found = results(ARM.replace("q1: 60deg, q2: 30deg", "q1: 60deg, q2: 0"))
    assert found["linear_B"] == found["linear_A"]


ELBOW = """
gravity: [0, -g, 0]
dh: [{theta: u*, a: A}, {theta: v* - u*, a: B}]
masses:
  - {mass: m1, link: 1, center: {along: 2/3}, inertia: {zz: J1}}
  - {mass: m2, link: 2, center: {along: 1/3}, inertia: {zz: J2}}
dampers: [{damping: b, of: v - u}]
passive: [v]
linearize: {u: 90deg, v: 90deg}
find: [linear_A, linear_B]
"""
SLIDING = (
    ELBOW.replace("dh: [", "dh: [{d: z*}, ")
    .replace("link: 2", "link: 3")
    .replace("link: 1", "link: 2")
    .replace("linearize: {", "linearize: {z: 0, ")
)
"""Its determinant is that of the elbow times a mass: what is left over that mass has no name."""


@pytest.mark.parametrize(("text", "is_determinant"), [(ELBOW, True), (SLIDING, False)])
def test_the_divisor_of_many_entries_has_a_name(text: str, is_determinant: bool) -> None:
    """Written out it stood in the ten entries, and twice: the name stands for exactly that."""
    solution = dynsolve.solve(text)
    steps = {step.id: step for step in solution.steps if step.id in ("linear_A", "linear_B")}
    (meaning,) = steps["linear_A"].defines
    assert isinstance(meaning, Relation)
    assert (formula("det 𝐃") in meaning.parts) is is_determinant
    letter, *_, value = meaning.parts
    at = {name: 0.3 + 0.17 * k for k, name in enumerate(solution.robot.parameters)}
    for name, step in steps.items():
        (result,) = step.result
        assert isinstance(result, Relation) and isinstance(result.parts[-1], Matrix)
        named = [entry for row in result.parts[-1].rows for entry in row]
        assert sum(letter in walk(entry) for entry in named) == {"linear_A": 8, "linear_B": 2}[name]
        exact = [entry for row in solution.to_json()["results"][name] for entry in row]
        for ours, theirs in zip(named, exact, strict=True):
            written = to_python(mapped(ours, lambda node: value if node == letter else node))
            assert numbers(written, at) == pytest.approx(numbers(theirs, at))


def test_a_short_divisor_is_written_where_it_is() -> None:
    cart = """
gravity: [0, -g, 0]
model:
  coordinates: {x: prismatic, t: revolute}
  bodies: [{mass: M, at: [x, 0, 0]}, {mass: m, at: [x + l*sin(t), l*cos(t), 0]}]
passive: [t]
linearize: {x: 0, t: 0}
find: [linear_A]
"""
    assert not any(step.defines for step in dynsolve.solve(cart).steps)


@pytest.mark.parametrize("detail", ["results", "brief", "normal", "full"])
def test_at_every_depth_the_name_is_told_before_it_is_used(detail: str) -> None:
    """It is another one where the problem has it."""
    shown = dynsolve.solve(ELBOW.replace("J1", "Delta")).to_markdown(detail=detail)
    before, after = shown.replace("{} ", "").split(r"\Theta", maxsplit=1)
    assert before.endswith("=: ") or after.startswith(r" = \text{det }")
    assert r"\Theta}" in after
    assert detail != "full" or "divided by" in after.split("Notation")[-1]


def test_the_shared_divisor_stands_wherever_it_is() -> None:
    """A pendulum with a wheel: below beside J₂, and above in m₁ c₁² + m₂ l₁² + J₁ + J₂."""
    wheel = """
gravity: [0, -g, 0]
model:
  coordinates: {q1: revolute, q2: revolute}
  bodies:
    - {mass: m1, at: [c1*sin(q1), c1*cos(q1), 0], turn: -q1, inertia: {zz: J1}}
    - {mass: m2, at: [l1*sin(q1), l1*cos(q1), 0], turn: -q1 - q2, inertia: {zz: J2}}
friction: {q2: b}
linearize: {q1: 0, q2: 0}
find: [linear_A, linear_B]
"""
    told = report(dynsolve.solve(wheel), Format.TEXT).decode().partition("Summary")[2]
    assert "-b (J₂ + Δ)/(J₂ Δ)" in told and told.count("m₁ c₁² + m₂ l₁² + J₁") == 1
