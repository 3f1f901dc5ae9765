"""Steps whose results are numbers, and what is left out."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from fractions import Fraction
from itertools import pairwise

import pytest
from msgspec.structs import replace

import dynsolve
from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.answers.judge import check
from dynsolve.answers.reading.files import FileReader
from dynsolve.document import Block, Fold, Formula
from dynsolve.errors import ExplanationWarning, ProblemError
from dynsolve.explain import energy, vectorized
from dynsolve.explain.abbreviations import Abbreviate
from dynsolve.explain.signs import formulas_in
from dynsolve.explain.step import Detail, Step
from dynsolve.notation.build import times
from dynsolve.notation.printing import Style
from dynsolve.notation.rounding import is_rounded, marked
from dynsolve.notation.tree import Matrix, Node, Relation, walk
from dynsolve.notation.unicode import to_unicode
from dynsolve.problem import read_problem
from dynsolve.render.files import Format
from dynsolve.render.terminal_boxes import entry_equations
from dynsolve.solution import documents
from dynsolve.solution.documents import measured_steps, solution_document
from dynsolve.solution.reports import report
from tests.support import solved

# -- A model in numbers: what is rounded has ≈ before it, what stands alone has its unit -------------


def steps() -> dict[str, Step]:
    solution = solved("numeric-2r")
    return {step.id: step for step in measured_steps(solution.explain(), solution.robot, solution.style)}


def shown(node: Node) -> str:
    style = solved("numeric-2r").style
    return to_unicode(marked(node, style), style)


@pytest.mark.parametrize(
    ("step", "printed"),
    [
        ("I_body1", "𝐈₁ ≈ [[0, 0, 0], [0, 0.0520833, 0], [0, 0, 0.0520833]] kg m²"),  # 2.5·0.5²/12
        ("I_body2", "(𝐈₂)_zz = 0.02 kg m²"),
        ("P1", "P₁ = 6.13125 s₁"),  # ends within the six digits
        ("K1", "K₁ ≈ ½·0.208333 q̇₁²"),  # half the inertia about the joint, as in D
        ("D", "𝐃 ≈ [[0.862833 + 0.48 c₂, 0.167 + 0.24 c₂], [0.167 + 0.24 c₂, 0.167]] kg m²"),
        ("g", "𝐠 = [[15.696 c₁ + 4.7088 c₁₂], [4.7088 c₁₂]] N m"),
        ("rc1", "𝐫_c1 = [[0.25 c₁], [0.25 s₁], [0]] m"),
        ("v1", "𝐯₁ = [[-0.25 s₁ q̇₁], [0.25 c₁ q̇₁], [0]] m/s"),
        ("D_direct1", "m₁ 𝐉_v1ᵀ 𝐉_v1 = [[0.15625, 0], [0, 0]] kg m²"),
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
    assert "g = 9.81 m/s²" in map(shown, found["P1"].further)
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
    assert to_unicode(marked(given, style), style).endswith(" ≈ [[0.123457], [0], [0]] m")


def test_a_line_keeps_the_steps_that_go_into_it() -> None:
    (line,) = (line for line in steps()["skew"].lines if line.uses)
    assert line.uses == ("D",)


def test_of_a_sum_the_number_that_comes_out_has_its_unit() -> None:
    printed = list(map(shown, steps()["D_sum"].result))
    assert printed[1].endswith("= 0.167 + 0.24 c₂")
    assert printed[2] == "d₂₂ = 0.027 + 0.02 + 0.12 = 0.167 kg m²"


VALUED = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2, center: midpoint, shape: {rod: {length: l2}}}]
values: {l1: 0.41, l2: 0.3, m1: 2, m2: 1.23, g: 9.81}
"""


def relations(blocks: Iterable[Block], style: Style) -> Iterator[Relation]:
    """The equations of a document, those of the entries of its matrices too."""
    for node in formulas_in(blocks):
        yield from (part for part in walk(node) if isinstance(part, Relation))
    for block in blocks:
        match block:
            case Fold():
                yield from relations(block.blocks, style)
            case Formula(Relation((left, Matrix() as matrix))):
                yield from entry_equations(matrix, left, block, style)


@pytest.mark.parametrize("detail", Detail)
@pytest.mark.parametrize("values", ["numeric-2r", VALUED])
def test_equality_is_never_claimed_for_what_is_rounded(values: str, detail: Detail) -> None:
    """= stands between members of which every number is written whole."""
    solution = solved(values).beside()
    style, signs = solution.style, set[str]()
    for node in relations(solution_document(solution, detail).blocks, style):
        rounded = [is_rounded(part, style) for part in node.parts]
        beside = [sign for sign, pair in zip(node.signs, pairwise(rounded), strict=True) if any(pair)]
        assert "=" not in beside
        signs |= {*beside}
    assert "≈" in signs


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


# -- an explanation never takes a result away: what fails in it is left out, and a warning says so ---


Fails = Callable[..., object]

PENDULUM = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l}, {theta: q2*, a: l}]
masses: [{mass: m, link: 1}, {mass: m, link: 2}]
"""


def fails(*_: object, **__: object) -> Iterator[Step]:
    raise LookupError("planted")


def page(abbreviate: str = "auto", detail: Detail = Detail.NORMAL) -> str:
    return report(dynsolve.solve(PENDULUM), Format.TEXT, detail=detail, abbreviate=abbreviate).decode()


def test_a_form_that_is_another_function_gives_way_to_the_plain_polynomial(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    collected = Compactor._collected

    def wrong(self: Compactor, expr: object) -> Node:
        return times(2, [(collected(self, expr), 1)])  # type: ignore[arg-type]

    monkeypatch.setattr(Compactor, "_collected", wrong)
    with pytest.warns(ExplanationWarning, match="compact form is left out: it is not equal"):
        found = dynsolve.solve(PENDULUM)
    monkeypatch.undo()
    state, numbers = [0.3, 2.0], {"m": 2, "l": 0.7}
    assert len(str(found.D)) > len(str(solved(PENDULUM).D))
    assert found.numeric("D")(state, **numbers) == pytest.approx(
        solved(PENDULUM).numeric("D")(state, **numbers)
    )


@pytest.mark.parametrize("stage", [energy, vectorized])
def test_a_stage_that_fails_shows_its_bare_results(stage: object, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(stage, "steps", fails)
    with pytest.warns(ExplanationWarning, match="LookupError at .*test_numeric"):
        text = page()
    assert "K₁" in text or "𝐃" in text
    assert "m l² θ̈" in text or "q̈₁" in text


def test_a_stage_that_fails_half_way_keeps_what_was_shown(monkeypatch: pytest.MonkeyPatch) -> None:
    steps = vectorized.steps

    def half(context: object) -> Iterator[Step]:
        yield next(steps(context))  # type: ignore[arg-type]
        raise LookupError("planted")

    monkeypatch.setattr(vectorized, "steps", half)
    with pytest.warns(ExplanationWarning, match="stage vectorized"):
        shown = list(dynsolve.solve(PENDULUM).explain(["vectorized"]))
    first = next(steps(dynsolve.solve(PENDULUM)._context))
    assert shown[0].id == first.id and shown[0].result == first.result
    assert {"C", "g"} <= {step.id for step in shown}


@pytest.mark.parametrize("part", ["summary_blocks", "notation", "statement"])
def test_a_part_of_the_document_that_fails_is_left_out(part: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(documents, part, fails)
    with pytest.warns(ExplanationWarning):
        assert "Verified" in page(detail=Detail.FULL)


def test_names_that_fail_leave_the_results_in_full(monkeypatch: pytest.MonkeyPatch) -> None:
    in_full = page("never")
    monkeypatch.setattr("dynsolve.explain.named_steps.in_names", fails)
    with pytest.warns(ExplanationWarning, match="names"):
        assert page(Abbreviate.ALWAYS) == in_full


CART = "gravity: none\nmodel: {coordinates: {x: prismatic}, bodies: [{mass: m, at: [x, 0, 0]}]}"


@pytest.mark.parametrize(("text", "maker"), [(PENDULUM, "scene.scene"), (CART, "placed_bodies.placed_scene")])
def test_a_picture_that_fails_is_left_out(monkeypatch: pytest.MonkeyPatch, text: str, maker: str) -> None:
    monkeypatch.setattr(f"dynsolve.draw.{maker}", fails)
    with pytest.warns(ExplanationWarning, match="the picture is left out: LookupError"):
        shown = report(dynsolve.solve(text), Format.LATEX).decode()
    assert r"\section" in shown and r"\begin{picture}" not in shown


# -- `state: reach`: what is asked at the configuration within the limits, held against the same state given


TWO_LINKS = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
masses: [{mass: m1, link: 1, center: midpoint}, {mass: m2, link: 2, center: midpoint}]
velocity: [1, 0]
acceleration: [0, 0]
forces: [{link: 2, at: tip, force: [F, 0, 0]}]
find: [qd, qdd, Q, tau_static, lost]
"""
TARGET = TWO_LINKS + "values: {l1: 2, l2: 1}\nstate: reach\n"
POLAR = """
gravity: none
dh: [{theta: q1* + 90deg, alpha: 90deg}, {d: d2*}]
reach: [3, 4]
limits: {d2: [0, 10]}
state: reach
velocity: [vx, vy]
find: [qd]
"""


def results(text: str) -> dict[str, object]:
    return dynsolve.solve(text).to_json()["results"]


def test_it_is_the_state_itself() -> None:
    """[1, 2] is reached by q1 = 90°, q2 = -90°."""
    reached = results(TARGET + "reach: [1, 2]\nlimits: {q2: [-180deg, 0]}\n")
    given = results(TWO_LINKS + "state: {q1: 90deg, q2: -90deg}\n")
    assert all(reached[name] == given[name] for name in ("qd", "qdd", "Q", "tau_static", "lost"))


def test_an_angle_of_zero_is_exact() -> None:
    """[2, 1] is reached by q1 = 0, q2 = 90°."""
    reached = results(TARGET + "reach: [2, 1]\nlimits: {q2: [0, 180deg]}\n")
    given = results(TWO_LINKS + "state: {q1: 0, q2: 90deg}\n")
    assert all(reached[name] == given[name] for name in ("qd", "qdd", "Q", "tau_static", "lost"))


def test_an_angle_of_known_sine_is_exact() -> None:
    """In q1 = atan2(4, 3), d2 = 5 the hand moves by (c1 d2' - s1 d2 q1', s1 d2' + c1 d2 q1')."""
    assert results(POLAR)["qd"] == ["-0.04*(4*vx - 3*vy)", "(3*vx + 4*vy)/5"]


def test_answers_are_judged_there() -> None:
    problem = read_problem(POLAR, "own.yaml")
    for value, verdict in (("[(3*vy - 4*vx)/25, 0.6*vx + 0.8*vy]", "correct"), ("[0, vx]", "wrong")):
        (answer,) = check(problem, FileReader(problem)(f"answers:\n  qd: {value}\n", "answer.yaml")).answers
        assert answer.verdict == verdict


@pytest.mark.parametrize(
    ("task", "reach", "state"),
    [
        ("[tip.x, tip.y]", "[2*cos(0), 1 + sin(0)]", "{q1: 0, q2: 90deg}"),
        ("[q1, q1 + q2]", "[20deg, 110deg + 0]", "{q1: 20deg, q2: 90deg}"),
    ],
)
def test_what_is_exact_is_a_state(task: str, reach: str, state: str) -> None:
    """A cosine of 0, and an angle whose sine is no sum of roots."""
    asks = "find: [qd, qdd, Q, tau_static, lost]"
    held = TARGET.replace("velocity: [1, 0]\nacceleration: [0, 0]\n", "").replace(
        asks, "find: [Q, tau_static]"
    )
    reached = results(f"{held}task: {task}\nreach: {reach}\nlimits: {{q2: [0, 180deg]}}\n")
    given = results(f"{held.replace('state: reach', f'state: {state}')}")
    assert all(reached[name] == given[name] for name in ("Q", "tau_static"))


def test_the_tip_is_the_task_where_the_file_gives_none() -> None:
    held = TARGET.replace("velocity: [1, 0]\nacceleration: [0, 0]\n", "").replace("qd, qdd, ", "")
    reached = results(held.replace(", lost", "") + "reach: [2, 1]\nlimits: {q2: [0, 180deg]}\n")
    assert reached["tau_static"]


def test_nested_roots_are_no_state() -> None:
    """q3 of a shoulder with an offset: r is √(x² + y²) - 1, and its square has a root in it."""
    text = """
dh: [{theta: q1*, alpha: 90deg, a: 1}, {theta: q2*, a: 1}, {theta: q3*, a: 1}]
masses: [{mass: m, link: 3}]
reach: [1.3, 0.7, 0.4]
limits: {q3: [0, 180deg], q1: [0, 90deg]}
state: reach
find: [tau_static]
"""
    with pytest.raises(ProblemError, match="no short sums of roots"):
        dynsolve.solve(text)


# (what is added to the file, what is wrong, the remedy)
FAULTS = [
    ("reach: [1, 2]\n", "2 configurations reach the target: {q1: atan2(3, 4), q2: pi/2} and", "limits"),
    ("reach: [1, 2]\nlimits: {q1: [0, 10deg]}\n", "no configuration within the limits", "find: [inverse]"),
    ("reach: [1, 5]\n", "no configuration within the limits", "find: [inverse]"),
]


@pytest.mark.parametrize(("more", "message", "help"), FAULTS)
def test_not_exactly_one_configuration_is_a_fault_at_the_state(more: str, message: str, help: str) -> None:
    text = TARGET + more
    with pytest.raises(ProblemError) as error:
        dynsolve.solve(text)
    (finding,) = error.value.findings
    assert (message in finding.message, help in finding.help) == (True, True), finding
    assert finding.excerpt == "state: reach"


def test_a_coordinate_that_is_free_leaves_no_state() -> None:
    text = TARGET.replace("l1: 2", "l1: 1") + "reach: [0, 0]\n"
    with pytest.raises(ProblemError, match="q1 may be anything"):
        dynsolve.solve(text)


def test_the_steps_of_the_json_mark_what_is_rounded() -> None:
    (tensor,) = (step for step in solved("numeric-2r").to_json()["steps"] if step["id"] == "I_body1")
    assert tensor["text"].endswith("𝐈₁ ≈ [[0, 0, 0], [0, 0.0520833, 0], [0, 0, 0.0520833]]")
    assert r"\mathbf{I}_{1} \approx" in tensor["latex"]


# -- Without a decimal in its file a model in numbers stays exact ------------------------------------

FRACTIONS = """
gravity: [0, -10, 0]
dh: [{theta: q1*, a: 1/2}]
masses: [{mass: 8, link: 1, center: tip, inertia: {zz: 1/6}}]
"""


@pytest.mark.parametrize(
    ("written", "digits", "D", "rounded"),
    [
        ("1/6", None, "𝐃 = [13/6] kg m²", False),
        ("1/6", 3, "𝐃 ≈ [2.17] kg m²", True),
        ("0.5", None, "𝐃 = [2.5] kg m²", False),
        ("5e-1", None, "𝐃 = [2.5] kg m²", False),
    ],
)
def test_numbers_are_decimals_where_one_is(written: str, digits: int | None, D: str, rounded: bool) -> None:
    solution = dynsolve.solve(FRACTIONS.replace("1/6", written))
    text = report(solution.beside(digits=digits), Format.TEXT).decode()
    assert D in text
    assert ("significant digits" in text) == rounded
    assert solution.to_json()["results"]["D"] == [["13/6" if written == "1/6" else "2.5"]]


@pytest.mark.parametrize(("length", "D"), [("l", "7/12 + 0.7 l²"), ("0.5", "0.758333")])
def test_a_number_beside_letters_is_exact_where_its_fraction_is_short(length: str, D: str) -> None:
    inertia = FRACTIONS.replace("mass: 8", "mass: 0.7").replace("1/6", "7/12").replace("1/2", length)
    solution = dynsolve.solve(inertia)
    assert to_unicode(solution.forms("D"), solution.style) == f"[[{D}]]"


def test_half_of_a_whole_number_is_multiplied() -> None:
    solution = dynsolve.solve(FRACTIONS.replace("1/2", "1.0"))
    assert to_unicode(solution.forms("Kv1"), solution.style) == "4q̇₁²"


INTEGRATED = """
gravity: [0, -9.81, 0]
dh: [{theta: q1*, a: 0.9}, {theta: q2*, a: 0.6}]
masses:
  - {link: 1, shape: {rod: {length: 0.9, density: 2*(1 + x/0.9)}}}
  - {mass: 1.75, link: 2, center: {near: [0.11, -0.02, 0]}, inertia: {zz: 0.013}, about: joint}
"""


def test_what_is_found_by_integration_and_a_tensor_that_is_moved_have_units() -> None:
    text = report(dynsolve.solve(INTEGRATED), Format.TEXT).decode()
    mass, first, center, moment = (
        "dx = 2.7 kg\n",
        "x dx = 1.35 kg m\n",
        "x_c1 = 0.5 m\n",
        "x² dx = 0.8505 kg m²\n",
    )
    assert all(told in text for told in (mass, first, center, moment, "(𝐈_{2,given})_zz = 0.013 kg m²\n"))
