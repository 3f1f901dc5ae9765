"""What a Python user holds: results, remarks, the notebook, the edition."""

from __future__ import annotations

import json
import re
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
import sympy

import dynsolve
from dynsolve.document import Document, Fold, Formula, Text
from dynsolve.document.books import SPONG
from dynsolve.errors import ExplanationWarning, ProblemError, UsageError, VerificationError
from dynsolve.explain.step import Detail, Step
from dynsolve.notation.text import read
from dynsolve.problem import read_problem
from dynsolve.problem.reader import bundled, find
from dynsolve.render.files import Format
from dynsolve.solution.documents import solution_document
from dynsolve.solution.numeric import to_sympy
from dynsolve.solution.reports import report
from tests.support import LIBRARY, numbers, solved

# -- solutions as Python users hold them: SymPy, NumPy, JSON -----------------------------------------


q1, q2, q1_dot, q2_dot = sympy.symbols("q1 q2 q1_dot q2_dot", real=True)
m2, l1, lc2, g = sympy.symbols("m2 l1 lc2 g", real=True)


@pytest.fixture(scope="module")
def planar() -> dynsolve.Solution:
    return dynsolve.solve("planar-2r")


def test_results_are_sympy_in_real_symbols(planar: dynsolve.Solution) -> None:
    """Spong, Hutchinson, Vidyasagar, section 7.4: h = -m_2 l_1 l_c2 sin q_2."""
    h = -m2 * l1 * lc2 * sympy.sin(q2)
    expected = sympy.Matrix([[h * q2_dot, h * (q2_dot + q1_dot)], [-h * q1_dot, 0]])
    assert sympy.expand(planar.C - expected) == sympy.zeros(2, 2)
    assert sympy.expand(planar.g[1] - m2 * g * lc2 * sympy.cos(q1 + q2)) == 0
    assert planar.christoffel(2, 1, 1) == planar.christoffel(1, 2, 1) == h


def test_sympy_s_own_derivation_agrees(planar: dynsolve.Solution) -> None:
    """D from K, and C q̇ + g from L, by SymPy's derivatives."""
    rates = sympy.Matrix([q1_dot, q2_dot])
    assert sympy.simplify(sympy.hessian(planar.K, rates) - planar.D) == sympy.zeros(2, 2)
    momenta = sympy.Matrix([planar.L]).jacobian(rates)
    moving = momenta.jacobian([q1, q2]) * rates - sympy.Matrix([planar.L]).jacobian([q1, q2]).T
    assert sympy.simplify(moving - planar.C * rates - planar.g) == sympy.zeros(2, 1)


def test_every_quantity_by_its_name(planar: dynsolve.Solution) -> None:
    assert planar.symbolic("H2") == planar.H[1] and planar.H[0] == planar.A[0]
    assert planar.J[:3, :] == planar.Jv and planar.J[3:, :] == planar.Jw
    assert planar.symbolic("Kw2").subs({q1_dot: 1, q2_dot: 1}) == 2 * sympy.Symbol("I2", real=True)
    for name in ("nonsense", "K9", "christoffel"):
        with pytest.raises(UsageError, match=name):
            planar.symbolic(name)


def test_a_solution_is_frozen(planar: dynsolve.Solution) -> None:
    with pytest.raises(AttributeError, match="immutable"):
        planar.problem = None  # type: ignore[misc,assignment]
    assert isinstance(planar.D, sympy.ImmutableMatrix)


@pytest.mark.parametrize(
    "text",
    ["m1*L1**2/2 - 3", "-x*(y - 1)**2", "sin(2*x + 90deg)*cos(y)", "sqrt(x**2 + 3)/y", "pi*x", "lambda_"],
)
def test_a_tree_in_sympy_is_the_formula(text: str) -> None:
    names = {name: sympy.Symbol(name.rstrip("_"), real=True) for name in ("m1", "L1", "x", "y", "lambda_")}
    functions = {"sin": sympy.sin, "cos": sympy.cos, "sqrt": sympy.sqrt, "pi": sympy.pi}
    expected = eval(text.replace("90deg", "pi/2"), {"__builtins__": {}}, {**names, **functions})  # noqa: S307
    assert sympy.simplify(to_sympy(read(text).tree) - expected) == 0


NUMBERS = {"m1": 1.2, "m2": 0.8, "l1": 0.5, "lc1": 0.2, "lc2": 0.3, "I1": 0.02, "I2": 0.01, "g": 9.81}


def test_numeric_functions_agree_with_each_other(planar: dynsolve.Solution) -> None:
    q, qd, qdd = [0.3, -1.1], [0.7, 0.4], [-0.2, 1.5]
    D, C, gravity, tau = (planar.numeric(name) for name in ("D", "C", "g", "tau"))
    both = D(q, **NUMBERS) @ qdd + C(q, qd, **NUMBERS) @ qd + gravity(q, **NUMBERS)
    assert tau(q, qd, qdd, **NUMBERS) == pytest.approx(both, rel=1e-12)
    assert D(q, **NUMBERS).shape == (2, 2) and gravity(q, **NUMBERS).shape == (2,)
    assert planar.numeric("K")(q, qd, **NUMBERS) == pytest.approx(0.5 * np.array(qd) @ D(q, **NUMBERS) @ qd)


def test_numeric_functions_take_many_states_at_once(planar: dynsolve.Solution) -> None:
    q = np.random.default_rng(1).uniform(-3, 3, (2, 50))
    many = planar.numeric("D")(q, **NUMBERS)
    assert many.shape == (2, 2, 50)
    assert many[:, :, 7] == pytest.approx(planar.numeric("D")(q[:, 7], **NUMBERS))


def test_numeric_functions_say_what_is_missing(planar: dynsolve.Solution) -> None:
    D = planar.numeric("D")
    assert set(D.parameters) == {"m1", "m2", "l1", "lc1", "lc2", "I1", "I2"}
    with pytest.raises(UsageError, match="D needs values for I2"):
        D([0, 0], **{name: value for name, value in NUMBERS.items() if name != "I2"})
    with pytest.raises(UsageError, match="q has 3 entries, the robot 2 coordinates"):
        D([0, 0, 0], **NUMBERS)


def test_values_of_the_file_are_defaults() -> None:
    text = "dh: [{theta: q1*, a: l1}]\ngravity: [0, -g, 0]\nmasses: [{mass: m, link: 1}]\n"
    text += "values: {m: 2, l1: 0.5, g: 10}\n"
    gravity = dynsolve.solve(text).numeric("g")
    assert gravity([0.0]) == pytest.approx([10.0])
    assert gravity([0.0], g=1) == pytest.approx([1.0])


def test_a_parameter_may_have_a_name_that_python_keeps() -> None:
    text = "dh: [{theta: q1*, a: lambda}]\nmasses: [{mass: q, link: 1}]"
    solution = dynsolve.solve(text)
    assert solution.numeric("D")([0.0], lambda_=2.0, q=3.0) == pytest.approx(np.array([[12.0]]))
    assert solution.to_json()["results"]["D"] == [["q*lambda_**2"]]


@pytest.mark.parametrize(
    "path", [path for path in LIBRARY if path.stem not in ("panda-7r", "puma560")], ids=lambda p: p.stem
)
def test_json_and_numpy_say_the_same(path: Path) -> None:
    solution = solved(path)
    results = json.loads(json.dumps(solution.to_json()))["results"]
    rng = np.random.default_rng(3)
    values = {name: rng.uniform(0.5, 1.5) for name in solution.robot.parameters}
    state = {name: rng.uniform(-1, 1, solution.robot.n) for name in ("", "_dot", "_ddot")}
    plain = {
        q.name + dots: x
        for dots, vector in state.items()
        for q, x in zip(solution.robot.coordinates, vector, strict=True)
    }
    for name in ("D", "C", "g", "tau", "K", "P", "L", "Jv", "Jw"):
        ours = solution.numeric(name)(*state.values(), **values)
        assert ours == pytest.approx(numbers(results[name], {**values, **plain}), rel=1e-9, abs=1e-12)


def test_steps_are_in_json_as_text_and_latex(planar: dynsolve.Solution) -> None:
    steps = {step["id"]: step for step in planar.to_json()["steps"]}
    assert steps["L"]["text"].startswith("ℒ = 𝒦 - 𝒫\n")
    assert steps["H2"]["latex"].count(r"\begin{bmatrix}") >= 2
    assert steps["D"]["stage"] == "vectorized" and steps["D"]["why"]


def test_a_robot_without_masses_ends_with_the_jacobian() -> None:
    solution = dynsolve.solve("dh: [{theta: q1*, a: l1}, {d: d2*, alpha: 30deg}]\n")
    assert set(solution.to_json()["results"]) == {"A", "H", "Jv", "Jw", "bodies"}
    assert solution.verification.max_relative_error < 1e-12
    with pytest.raises(UsageError):
        _ = solution.D


def test_what_can_be_solved(planar: dynsolve.Solution) -> None:
    """A path, a stem, a text, a problem: all the same."""
    path = bundled()["planar-2r"]
    for problem in (path, str(path), dynsolve.load(path), path.read_text()):
        assert dynsolve.solve(problem).D == planar.D
    assert dynsolve.load("planar-2r").title == planar.problem.title


def test_an_unknown_stem_is_a_problem_error() -> None:
    with pytest.raises(ProblemError, match="did you mean"):
        find("planar-2rr")


def test_progress_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    told: list[tuple[int, int]] = []
    dynsolve.solve("planar-2r", progress=lambda done, of: told.append((done, of)))
    assert [done for done, _ in told] == list(range(told[0][1]))


def test_ways_that_disagree_are_never_returned(monkeypatch: pytest.MonkeyPatch) -> None:
    from dynsolve.derivation import euler_lagrange
    from dynsolve.solution import dynamics

    monkeypatch.setattr(dynamics, "agreement", lambda *_: euler_lagrange.Agreement(True, False, True, True))
    with pytest.raises(VerificationError):
        dynsolve.solve("planar-2r")


def test_the_public_face() -> None:
    assert {"load", "solve"} <= set(dir(dynsolve))
    with pytest.raises(AttributeError, match="has no attribute 'sove'"):
        _ = dynsolve.sove  # type: ignore[attr-defined]


DRAWN = """
axes:
  - {turn: q1, about: [0, 0, 1], through: [0, 0, 0]}
  - {turn: q2, about: [0, -1, 0], through: [0, 0, d1]}
tip: [a2, 0, d1]
zero: drawn
velocity: [0, 0, v]
state: {q2: 0}
find: [r, det, qd]
"""


def test_numbers_go_into_what_only_this_exercise_asks() -> None:
    solution = dynsolve.solve(DRAWN)
    assert solution.to_json()["results"]["qd"] == ["0", "v/a2"]
    valued = solution.with_values(d1=1, a2=2, v=3)
    assert valued.to_json()["results"]["qd"] == ["0", "3/2"]
    assert valued.to_json()["results"]["det"] == "16*cos(q2)**2"
    assert solution.at(q1=0, q2="60deg").symbolic("det") == sympy.Symbol("a2", real=True) ** 4 / 4


# -- `edition`: by which edition of the course's book the sections are counted -----------------------


ARM = """
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
masses:
  - {mass: m1, link: 1, center: midpoint, inertia: {zz: I1}}
  - {mass: m2, link: 2, center: tip, shape: point}
springs: [{stiffness: k, of: q1}]
task: [tip.x, tip.y]
find: [tau, inverse]
"""


def sources(document: Document) -> list[str]:
    """The references beside formulas and in sentences, in order."""
    blocks = [
        inner
        for block in document.blocks
        for inner in (block.blocks if isinstance(block, Fold) else (block,))
    ]
    told = [block.source for block in blocks if isinstance(block, Formula)]
    words = (
        part for block in blocks if isinstance(block, Text) for part in block.parts if isinstance(part, str)
    )
    return [*told, *(reference for text in words for reference in re.findall(r"§[0-9.]*[0-9]", text))]


@pytest.mark.parametrize("detail", Detail)
def test_the_second_edition_has_dynamics_in_its_chapter_6(detail: Detail) -> None:
    first = sources(solution_document(dynsolve.solve(ARM), detail))
    second = sources(solution_document(dynsolve.solve("edition: 2" + ARM), detail))
    assert len(first) == len(second)
    for one, other in zip(first, second, strict=True):
        if "Siciliano" in one or not re.search(r"§[37]", one) or re.search(r"§3\.[12]", one):
            assert other == one
        else:
            assert other == one.replace("§7.", "§6.").replace("§3.3.", "§5.").replace("§3.3", "§5")


@pytest.mark.parametrize(("edition", "year"), [("", "2006"), ("edition: 2", "2020")])
def test_the_edition_is_named_and_in_full_its_sections_have_titles(edition: str, year: str) -> None:
    page = dynsolve.solve(edition + ARM).to_markdown("full")
    assert year in page and ("1st" in page) != ("2nd" in page)
    chapter = "6" if edition else "7"
    assert f"§{chapter}.1 {SPONG.sections['7.1']}" in page


def test_a_hint_has_the_sections_of_the_edition() -> None:
    assert sources(dynsolve.solve("edition: 2" + ARM).hint("energy"))
    assert not any(
        "§7" in source and "Siciliano" not in source
        for source in sources(dynsolve.solve("edition: 2" + ARM).hint("energy"))
    )


# -- remarks of a problem's author: at which steps they stand, in which words, in every format -------


RP = """
dh: [{theta: theta1*, d: L1, alpha: 90deg}, {d: L2*}]
masses: [{mass: m1, link: 1, center: midpoint, inertia: {zz: I1zz}}, {mass: m2, link: 2}]
"""

STEPS = {
    "Kv2": "Kv2",
    "f2": "tau2",  # a force by its own name, the step by that of its rule
    "M": "D",
    "d12": "D",
    "c121": "christoffel",
    "Jw2": "Jv2",  # both are results of one step
    "tau": "tau2",  # no step of its own: the last of its parts
    "DH": "dh",
}
"""The step at which a remark on a result stands."""


def noted(steps: tuple[Step, ...], text: str) -> list[str]:
    """The steps with a note of these words."""
    return [step.id for step in steps if (text,) in step.notes]


@pytest.mark.parametrize("name", STEPS)
def test_a_remark_stands_at_the_step_of_its_result(name: str) -> None:
    solution = dynsolve.solve(read_problem(f"remarks: {{{name}: the squares add up}}{RP}"))
    assert noted(solution.steps, "the squares add up") == [STEPS[name]]


def test_a_remark_is_words_and_may_have_several_lines() -> None:
    text = "remarks: {K: ['1 + 1 =  2, $x$ <b>', second]}" + RP
    solution = dynsolve.solve(read_problem(text))
    (step,) = (step for step in solution.to_json()["steps"] if step["id"] == "K")
    assert step["notes"][-2:] == ["1 + 1 = 2, $x$ <b>", "second"]
    assert "$x$ &lt;b&gt;" in report(solution, Format.HTML).decode()
    assert r"\$x\$ \textless{}b\textgreater{}" in report(solution, Format.LATEX, detail=Detail.FULL).decode()


def test_a_remark_on_what_has_no_step_is_an_error_at_its_place() -> None:
    problem = read_problem("remarks:\n  I_body2: a point has none" + RP)  # body 2 is a point
    with pytest.raises(ProblemError, match="no step of I_body2") as error:
        _ = dynsolve.solve(problem).steps
    assert [(finding.line, finding.column) for finding in error.value.findings] == [(2, 12)]


# -- what a notebook shows of a solution, and the pages it gives to Python ---------------------------


class _Tags(HTMLParser):
    """The tags that are open, and whether each was closed in its turn."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.seen: list[str] = []

    def handle_starttag(self, tag: str, attrs: object) -> None:
        if tag not in ("br", "wbr", "input"):
            self.open.append(tag)
            self.seen.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


@pytest.fixture(scope="module")
def solution() -> dynsolve.Solution:
    return dynsolve.solve("in3140-rp")


def test_a_solution_is_named_in_a_line(solution: dynsolve.Solution) -> None:
    assert repr(solution).startswith("<Solution of RP manipulator, verified")
    assert len(repr(solution)) < 100


def test_a_notebook_shows_the_results_before_the_steps(solution: dynsolve.Solution) -> None:
    page = _Tags()
    shown = solution._repr_html_()
    page.feed(shown)
    assert not page.open
    assert not {"html", "style", "script"} & set(page.seen)
    assert shown.index("Summary") < shown.index("Worked solution") < shown.index("Denavit-Hartenberg table")
    text = solution._repr_markdown_()
    assert text.index("## Summary") < text.index("<summary>Worked solution</summary>") < text.index("1.1 ")
    formulas = solution._repr_latex_().splitlines()
    assert all(line.startswith("$$") and line.endswith("$$") for line in formulas)
    assert any("\\boldsymbol{\\tau}" in line for line in formulas)


def test_pages_at_a_depth(solution: dynsolve.Solution) -> None:
    brief, full = solution.to_markdown("brief"), solution.to_markdown("full")
    assert len(brief) < len(solution.to_markdown()) < len(full)
    assert solution.to_latex("results").startswith("\\documentclass")
    assert 'id="brief" checked' in solution.to_html("brief")
    with pytest.raises(UsageError, match="long is no depth"):
        solution.to_markdown("long")


def test_a_check_that_fails_takes_away_its_own_question_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    def fails(held: object) -> None:
        raise VerificationError("planted")

    monkeypatch.setattr("dynsolve.questions.equilibria.check.verify", fails)
    arm = "gravity: [0, -g, 0]\ndh: [{theta: q1*, a: l}]\nmasses: [{mass: m, link: 1}]\n"
    with pytest.warns(ExplanationWarning, match="equilibria is left out: planted"):
        found = dynsolve.solve(arm + "find: [g, equilibria]\n").to_json()["results"]
    assert found["g"] == ["m*g*l*cos(q1)"]
    assert found["equilibria"] == {"skipped": "its check found it to be wrong"}
