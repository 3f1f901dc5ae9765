"""What a depth shows of a solution can be read by itself: no name, sentence or result is without its own."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from itertools import pairwise

import pytest
from msgspec.structs import replace

from dynsolve.document import Block, Equations, Fold, Formula, Heading, List, Table, Text, Uses
from dynsolve.explain.signs import formulas_in, kind_of
from dynsolve.explain.step import Detail
from dynsolve.explain.terms import ID
from dynsolve.notation.printing import Style
from dynsolve.notation.tree import Function, Letter, Matrix, Node, Relation, Sum, Symbol, children, walk
from dynsolve.notation.unicode import to_unicode, width
from dynsolve.render.files import Format
from dynsolve.render.page import leads_on
from dynsolve.solution.depths import condensed
from dynsolve.solution.reports import rendered
from tests.strangers.generator import stranger, written
from tests.support import document, solved

PROBLEMS = [
    "in3140-rp", "planar-2r", "elbow-3r", "spherical-rrp", "cartesian-pp", "numeric-2r",
    "planar-2r-friction", "planar-2r-motors", "cart-pole", "inf3480-rrp-drawn", "knife-edge",
    *map(written, map(stranger, (1, 3, 5))),
]  # fmt: skip
SHOWN = [(problem, detail) for problem in PROBLEMS for detail in Detail]
WIDEST = 100


def blocks_of(problem: str, detail: Detail) -> tuple[Block, ...]:
    return document(problem, detail).blocks


def page_of(problem: str, detail: Detail) -> str:
    return rendered(document(problem, detail), solved(problem).style, Format.TEXT, fragment=False).decode()


def flat(blocks: Iterable[Block]) -> Iterator[Block]:
    """Every block; of a fold its title, and what is in it."""
    for block in blocks:
        if isinstance(block, Fold):
            yield Heading(block.title, 3)
            yield from flat(block.blocks)
        else:
            yield block


def sections(blocks: Iterable[Block]) -> Iterator[tuple[str, list[Block]]]:
    """The steps, and what stands between them, each with its title."""
    title, found = "", list[Block]()
    for block in flat(blocks):
        if isinstance(block, Heading):
            yield title, found
            title, found = block.text, []
        else:
            found.append(block)
    yield title, found


# -- names -------------------------------------------------------------------------------------------


def signs(nodes: Iterable[Node], style: Style) -> set[Node]:
    """The names and letters of formulas, without their dots."""
    found: set[Node] = set()
    pending = list(nodes)
    while pending:
        node = pending.pop()
        if kind_of(node, style):
            found.add(replace(node, dots=0) if isinstance(node, Letter | Symbol) and node.dots else node)
        elif not isinstance(node, Letter):
            pending += children(node)
    return found


def left_sides(nodes: Iterable[Node]) -> Iterator[Node]:
    yield from (part for node in walk(*nodes) if isinstance(node, Relation) for part in node.parts[:-1])


def in_words(blocks: Iterable[Block]) -> Iterator[Node]:
    words = (block for block in blocks if isinstance(block, Text | Uses | List | Table))
    yield from formulas_in(words)


def is_general(sign: Node) -> bool:
    """Whether it stands for those of all bodies or entries: mᵢ, dₖⱼ."""
    return isinstance(sign, Letter) and not any(map(str.isdigit, to_unicode(sign).translate(SUBSCRIPTS)))


SUBSCRIPTS = str.maketrans("₀₁₂₃₄₅₆₇₈₉", "0123456789")
NO_NAMES = {Letter("0", style="bold"), *map(Symbol, "ijkt")}
"""Zeros, what counts, and the time."""


def unintroduced(problem: str, detail: Detail) -> list[str]:
    """The names that a step uses and neither it nor anything before it has defined, or told in words."""
    style = solved(problem).style
    known, letters, general = set(NO_NAMES), set[str](), set[object]()
    missing = []
    for title, blocks in sections(blocks_of(problem, detail)):
        shown = [replace(block, entries=()) if isinstance(block, Formula) else block for block in blocks]
        nodes = list(formulas_in(shown))
        new = signs((*in_words(shown), *left_sides(nodes)), style)
        known |= new
        used = signs(nodes, style)
        letters |= {to_unicode(sign)[0] for sign in new}
        general |= {kind_of(sign, style) for sign in used if is_general(sign)}
        for sign in used - known:
            is_told = is_general(sign) and to_unicode(sign)[0] in letters
            if not (is_told or isinstance(sign, Function) or kind_of(sign, style) in general):
                missing.append(f"{title}: {to_unicode(sign, style)}")
    return missing


@pytest.mark.parametrize("problem", PROBLEMS)
def test_every_name_is_introduced_where_it_is_used_or_before(problem: str) -> None:
    assert unintroduced(problem, Detail.NORMAL) == []


# -- words and formulas ------------------------------------------------------------------------------


@pytest.mark.parametrize(("problem", "detail"), SHOWN)
def test_words_that_lead_on_lead_to_a_formula(problem: str, detail: Detail) -> None:
    blocks = [*flat(blocks_of(problem, detail)), Heading("")]
    for one, other in pairwise(blocks):
        if isinstance(one, Text | Uses) and (leads_on(one.parts) or isinstance(one, Uses)):
            assert isinstance(other, Formula | Equations | Table | List), one


def equations_of(block: Block) -> list[Relation]:
    nodes = (
        [block.node] if isinstance(block, Formula) else block.nodes if isinstance(block, Equations) else ()
    )
    return [part for node in nodes for part in walk(node) if isinstance(part, Relation)]


@pytest.mark.parametrize(("problem", "detail"), SHOWN)
def test_no_equation_stands_twice_in_a_row(problem: str, detail: Detail) -> None:
    for title, blocks in sections(blocks_of(problem, detail)):
        displays = [block for block in blocks if isinstance(block, Formula | Equations)]
        for one, other in pairwise([*displays, Text(("",))]):
            shown = [*equations_of(one), *equations_of(other)]
            twice = {to_unicode(each) for k, each in enumerate(shown) if each in shown[:k]}
            assert not twice, title


@pytest.mark.parametrize(("problem", "detail"), SHOWN)
def test_no_line_is_wider_than_the_page(problem: str, detail: Detail) -> None:
    page = page_of(problem, detail)
    assert [line for line in page.splitlines() if width(line) > WIDEST] == []


# -- results and steps -------------------------------------------------------------------------------

STAGES = re.compile(r"(A|rc|P|K|dLdqd|ddt|dLdq|tau)\w*|H([2-9]|\d\d)|J|P|K|L|D|C|g")
"""The names of the results that a worked example has; H₁ is A₁, and a rate may be the force."""


@pytest.mark.parametrize("problem", PROBLEMS)
def test_normal_has_the_result_of_every_stage(problem: str) -> None:
    shown = set(left_sides(formulas_in(blocks_of(problem, Detail.NORMAL))))
    missing = []
    solution = solved(problem)
    for step in solution.steps:
        force = step.id.replace("ddt", "tau")
        if force != step.id and solution.values[force] == solution.values[step.id]:
            continue
        if STAGES.fullmatch(step.id) and step.result and isinstance(step.result[0], Relation):
            missing += [step.id] if step.result[0].parts[0] not in shown else []
    assert missing == []


@pytest.mark.parametrize("problem", PROBLEMS)
def test_full_has_every_step(problem: str) -> None:
    titles = {title.partition(" ")[2] for title, _ in sections(blocks_of(problem, Detail.FULL))}
    assert {step.title for step in solved(problem).steps if step.id != ID} <= titles


LINES = {
    "in3140-rp": (45, 110, 300),
    "planar-2r": (45, 120, 340),
    "elbow-3r": (70, 160, 640),
}


@pytest.mark.parametrize("problem", LINES)
def test_a_depth_is_as_long_as_it_is_meant_to_be(problem: str) -> None:
    depths = (Detail.RESULTS, Detail.BRIEF, Detail.NORMAL)
    pages = [page_of(problem, detail) for detail in depths]
    lengths = [len(page.splitlines()) for page in pages]
    assert all(length <= most for length, most in zip(lengths, LINES[problem], strict=True)), lengths


SLIDERS = """
gravity: [0, 0, -g]
model:
  coordinates: {x: prismatic, y: prismatic, a: revolute, b: revolute}
  bodies:
    - {mass: M, at: [x, y, 0]}
    - {mass: m, at: [x + l*sin(a)*cos(b), y + l*sin(a)*sin(b), BODY]}
"""
"""A model of four coordinates."""


@pytest.mark.parametrize("height", ["-l*cos(a)", "h*x*cos(b) + r*y*sin(a + b) + r*cos(2*a)"])
def test_the_results_of_four_coordinates_hold_the_forces(height: str) -> None:
    page = page_of(SLIDERS.replace("BODY", height), Detail.RESULTS)
    assert all(f"\n    {force} = " in page for force in ("f₁", "f₂", "τ₃", "τ₄"))
    summary = page.partition("Summary")[2]
    assert "    𝐂 = " in summary or "    C₁₃ = " in summary or "⎤ ⎡ẋ⎤" in summary


def test_a_chain_of_matrices_under_others_stays_one_and_can_be_broken() -> None:
    """As wide as a line each: none gets a row of its own around it, which a page could not break at =."""
    long = Sum(tuple(Symbol(f"m{k}") for k in range(1, 9)))
    chains = tuple(
        Relation((Symbol(name), Matrix(((long,),)), Matrix(((long,),))), ("=", "=")) for name in "ab"
    )
    (shown,) = condensed([Equations(chains)], Style())
    assert isinstance(shown, Equations) and shown.nodes == chains


# -- headings and letters ----------------------------------------------------------------------------


@pytest.mark.parametrize("problem", ["articulated-6r", "spatial-3r-acceleration", "planar-2r"])
@pytest.mark.parametrize("detail", [Detail.BRIEF, Detail.NORMAL, Detail.FULL])
def test_no_number_of_a_section_is_passed_over(problem: str, detail: Detail) -> None:
    headings = [block.text for block in blocks_of(problem, detail) if isinstance(block, Heading)]
    numbers = [int(text.split(". ")[0]) for text in headings if re.match(r"\d+\. ", text)]
    assert numbers == list(range(1, len(numbers) + 1))


def test_brief_tells_what_goes_beyond_the_course() -> None:
    arm = "dh: [{theta: q1*, a: l1}]\nmasses: [{mass: m1, link: 1}]\nfriction: {q1: {viscous: b}}"
    assert any(isinstance(b, Text) and b.parts[0] == "Notation: " for b in blocks_of(arm, Detail.BRIEF))
    assert not any(
        isinstance(b, Text) and b.parts[0] == "Notation: " for b in blocks_of("planar-2r", Detail.BRIEF)
    )


def test_a_heading_names_what_is_asked_for() -> None:
    body = "dh: [{theta: q1*, a: l1}]\nmasses: [{mass: m1, link: 1}]\n"
    for asked, heading in (
        ("equilibria", "Equilibria"),
        ("equilibria, linear_A", "Equilibria and linearization"),
    ):
        text = f"{body}linearize: {{q1: 0}}\nfind: [{asked}]"
        assert any(
            isinstance(b, Heading) and b.text.endswith(f". {heading}") for b in blocks_of(text, Detail.NORMAL)
        )


AT_REST = """
model:
  coordinates: {p: revolute}
  bodies:
    - {mass: m1, at: [0, 0, 0], turn: p, inertia: {zz: J1}}
    - {mass: m2, at: [0, 0, 0], turn: 2*p, inertia: {zz: J2}}
    - {mass: m3, at: [0, a, 0], turn: 3*p, inertia: {zz: J3}}
"""


@pytest.mark.parametrize("detail", [Detail.BRIEF, Detail.NORMAL])
def test_bodies_of_which_the_same_is_said_have_one_line(detail: Detail) -> None:
    text = page_of(AT_REST, detail)
    assert text.count("The position is given") == (detail is Detail.NORMAL)
    assert "𝐫_c1 = 𝐫_c2 = 𝟎" in text


@pytest.mark.parametrize("detail", [Detail.BRIEF, Detail.NORMAL])
def test_a_height_and_an_energy_that_are_0_stay_apart(detail: Detail) -> None:
    assert "η₁ = P₁" not in page_of("cart-pole", detail)


TREE = """
dh: [{theta: q1*, a: l}, {theta: q2*, a: b}, {theta: q3*, a: c, from: 1}]
masses: [{mass: m, link: 2}, {mass: m, link: 3}]
find: [tau]
"""


def test_brief_has_the_frame_at_each_end_of_a_tree() -> None:
    text = page_of(TREE, Detail.BRIEF)
    assert all(f"𝐇{end}⁰ = 𝐀₁ 𝐀{end}" in text for end in "₂₃")
    assert "𝐇₁" not in text
