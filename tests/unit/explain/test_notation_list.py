"""One sign, one meaning: every sign of a report is in its list of notation, and stands for one thing."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from functools import cache

import pytest
from msgspec.structs import replace

from dynsolve.document import Block, Fold, Formula, Heading, Note, Table, Text
from dynsolve.explain.context import style_of
from dynsolve.explain.notation_list import COUNTING, notation, problem_names
from dynsolve.explain.signs import TRANSPOSED, Kind, formulas_in, kind_of, kinds_in, report_style
from dynsolve.explain.step import Detail
from dynsolve.notation.formulas import FormulaPrinter
from dynsolve.notation.markup import LatexPrinter, MathMLPrinter, TypstPrinter
from dynsolve.notation.tree import Function, Letter, Node, Sum, Symbol
from dynsolve.notation.unicode import UnicodePrinter, to_unicode
from dynsolve.problem import read_problem
from dynsolve.render import latex, markdown
from tests.strangers.held import signs_in
from tests.support import document, solved

TOLD_IN_WORDS = {TRANSPOSED, *(("", "name", name) for name in COUNTING)}
SHORT = [
    "box-cylinder-rod-sphere",
    "elbow-3r",
    "five-bar",
    "in3140-rp",
    "inf3480-rpr",
    "inf3480-rprr-drawn",
    "inertia-candidates",
    "knife-edge",
    "planar-2r-friction",
    "planar-2r-motors",
    "rp-parameters",
    "rp-vertical",
]
"""A problem for each kind of step; every drawn mechanism is held to the same (`tests/strangers`)."""

PROBLEMS = [*SHORT, pytest.param("puma560", marks=pytest.mark.slow)]

# Names that look like the textbook's letters: entries of D and g, energies, a force, an axis, the Jacobian
CLASHING = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: d12}, {theta: q2*, a: g1}, {d: L*, a: z1}]
masses:
  - {mass: P1, link: 1, center: {near: [f3, 0, 0]}, inertia: {zz: K1}}
  - {mass: J, link: 2}
  - {mass: C, link: 3}
"""

# A coordinate is called s1, so that s₁ cannot be the sine of θ₁; c12 is a length
TAKEN = """
dh: [{theta: theta1*, a: c12}, {theta: theta2*, a: l}, {d: s1*}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}, {mass: m3, link: 3}]
"""

# Names that look like the solution's own letters, and like those that stand in for them
OF_IDENTITIES = """
gravity: [0, 0, -eta1]
dh:
  - {theta: q1*, d: h, alpha: 90deg}
  - {theta: q2*, a: U}
  - {theta: q3*, a: zeta2}
masses:
  - {mass: u1, link: 2}
  - {mass: G, link: 2, center: [V, W, 0], inertia: {xx: h1, yy: h2, zz: h3}}
  - {mass: n_12, link: 3}
"""
OF_SOLUTIONS = """
gravity: none
dh:
  - {theta: psi*, a: A}
  - {theta: q2*, a: B}
  - {theta: q3*, a: c}
points: {P: {link: 2}}
task: [P.x, P.y, psi + q3]
reach: [X, Y, chi]
find: [inverse]
"""
OF_CONSTRAINTS = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: lambda1}, {theta: q2*, a: mu2}]
masses: [{mass: tau1, link: 1}, {mass: u2, link: 2}]
friction: {q1: f1}
constraints: [tip.x - c, tip.y]
find: [tau, lambda]
"""
OF_THE_TABLE = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: theta}, {theta: q2*, a: a}, {d: d3*, a: a1}]
masses: [{mass: d1, link: 1}, {mass: alpha, link: 2}, {mass: theta1, link: 3}]
"""
TAKING = [CLASHING, TAKEN, OF_IDENTITIES, OF_SOLUTIONS, OF_CONSTRAINTS, OF_THE_TABLE]

PRINTERS = (UnicodePrinter, LatexPrinter, MathMLPrinter, TypstPrinter)


@cache
def signs(problem: str) -> set[Node]:
    return signs_in(document(problem).blocks, solved(problem).style)


@pytest.mark.parametrize("problem", [*PROBLEMS, *TAKING])
@pytest.mark.parametrize("printer", PRINTERS, ids=lambda printer: printer.notation)
def test_no_sign_stands_for_two_things(problem: str, printer: type[FormulaPrinter]) -> None:
    style = solved(problem).style
    write = printer(style)
    meanings: dict[str, set[Kind]] = {}
    for node in signs(problem):
        kind = kind_of(node, style)
        assert kind is not None
        meanings.setdefault(write.text(node), set()).add(kind)
    assert {text: kinds for text, kinds in meanings.items() if len(kinds) > 1} == {}


@pytest.mark.parametrize("problem", [*PROBLEMS, *TAKING])
@pytest.mark.parametrize("detail", Detail)
def test_every_sign_is_in_the_list(problem: str, detail: Detail) -> None:
    solution = solved(problem)
    blocks = document(problem, detail).blocks
    told = notation(solution.robot, solution.style, blocks, solution.abbreviated("auto"))
    known = {kind for line in told.lines for kind in line.kinds} | TOLD_IN_WORDS
    assert kinds_in(formulas_in(blocks), solution.style) - known == set()


@pytest.mark.parametrize("problem", [*PROBLEMS, *TAKING])
def test_nothing_is_listed_that_is_not_printed(problem: str) -> None:
    """The names of entries count for nothing: where a matrix fits the page, they are not printed."""
    solution = solved(problem)
    blocks = document(problem).blocks
    told = notation(solution.robot, solution.style, blocks, solution.abbreviated("auto"))
    printed = [
        replace(block, entries=()) if isinstance(block, Formula) else block
        for block in unfolded(blocks)
        if not (isinstance(block, Table) and block.header[0] == "Symbol")
    ]
    kinds = kinds_in(formulas_in(printed), solution.style)
    listed = {kind_of(sign, solution.style): to_unicode(sign) for line in told.lines for sign in line.signs}
    assert {text for kind, text in listed.items() if kind not in kinds} == set()


_NO_LETTERS = re.compile(r"\\(?:text|begin|end|href|label|ref|tag|operatorname|mathrm)\{[^{}]*\}")
_INDEX = re.compile(r"_\{[^{}]*\}")
_SIGN = re.compile(
    r"\\math(?:bf|cal)\{\w\}|\\boldsymbol\{\\\w+\}|\\(?:theta|tau|omega|alpha|kappa|sigma)\b"
    r"|(?<![\\A-Za-z])[A-Za-z](?![A-Za-z])"
)


def letters_of(formulas: list[str]) -> set[str]:
    """The letters of LaTeX formulas, without their indices: read off the text, by no code of the program."""
    found: set[str] = set()
    for text in formulas:
        text = _NO_LETTERS.sub(" ", text)
        while (shorter := _INDEX.sub(" ", text)) != text:
            text = shorter
        text = re.sub(r"\\(?:dot|ddot)\{([^{}]*)\}", r" \1 ", text)
        found |= set(_SIGN.findall(text))
    return found


@pytest.mark.parametrize("problem", ["elbow-3r", "rp-vertical", "box-cylinder-rod-sphere", "numeric-2r"])
def test_every_letter_of_the_printed_page_is_in_the_printed_list(problem: str) -> None:
    text = markdown.render(document(problem), solved(problem).style)
    derived, listed = text.split("## 1. ", 1)[1].split("# Notation", 1)
    formula = re.compile(r"\$\$(.*?)\$\$|\$(.*?)\$", re.S)
    in_list = letters_of(["".join(found) for found in formula.findall(listed)])
    in_text = letters_of(["".join(found) for found in formula.findall(derived)])
    transposes_and_differentials = {"T", "d", "w"}
    assert in_text - in_list <= transposes_and_differentials


@pytest.mark.parametrize("problem", SHORT)
@pytest.mark.parametrize("detail", Detail)
def test_the_list_is_an_appendix_of_full(problem: str, detail: Detail) -> None:
    headings = [block.text for block in document(problem, detail).blocks if isinstance(block, Heading)]
    assert headings.count("Notation") == (headings[-1] == "Notation") == (detail is Detail.FULL)


def lines(problem: str, detail: Detail = Detail.FULL) -> dict[str, tuple[str, str]]:
    """The lines of the table: sign -> meaning and unit, as a terminal shows them."""
    style = solved(problem).style

    def cell(part: object) -> str:
        return part if isinstance(part, str) else to_unicode(part, style)  # type: ignore[arg-type]

    (table,) = (
        block
        for block in document(problem, detail).blocks
        if isinstance(block, Table) and block.header[0] == "Symbol"
    )
    return {cell(row[0]): (cell(row[1]), cell(row[2])) for row in table.rows}


# the table, and what its coordinates are
COORDINATES = [
    ("{theta: t1*, a: l}, {theta: t2* - t1*, a: l}", "angles of the links against 𝐱₀"),
    ("{theta: t1*, a: l}, {theta: t2* - t1*, alpha: 90deg}", "angles of the links against 𝐱₀"),
    ("{theta: t1*, a: l, alpha: 90deg}, {theta: t2* - t1*, a: l}", "angles"),
    ("{theta: t1* + 90deg, a: l}, {theta: t2* - t1*, a: l}", "angles"),
    ("{theta: t1*, a: l}, {theta: t2*, a: l}, {theta: -t2*, a: l}", "joint angles"),
]


@pytest.mark.parametrize(("rows", "called"), COORDINATES)
def test_angles_are_those_of_joints_where_a_joint_turns_by_each(rows: str, called: str) -> None:
    robot = solved(f"gravity: none\ndh: [{rows}]\nmasses: [{{mass: m, link: 2}}]").robot
    assert next(problem_names(robot)).words == f"{called}: generalized coordinates"


JACOBIANS = "Jacobian of the last frame, its linear part, its angular part, its column i"

# problem, sign -> meaning, unit
MEANINGS = [
    ("in3140-rp", "θ₁", "joint angle: generalized coordinate", "rad"),
    ("in3140-rp", "L₂", "joint displacement: generalized coordinate", "m"),
    ("in3140-rp", "L₁", "height of 𝐨₁ above 𝐨₀", "m"),
    ("in3140-rp", "m₁, m₂, mᵢ", "mass of body i", "kg"),
    ("in3140-rp", "I_1zz", "moment of inertia of body 1 about axis z through its mass centre", "kg m²"),
    ("planar-2r", "I₁, I₂", "moment of inertia of body i about axis z through its mass centre", "kg m²"),
    ("planar-2r", "l₁, l₂", "length of link i, from 𝐨ᵢ₋₁ to 𝐨ᵢ", "m"),
    ("planar-2r", "l_c1, l_c2", "distance from 𝐨ᵢ₋₁ to the mass centre of body i", "m"),
    ("spherical-rrp", "l_c2", "distance from 𝐨₂ to the mass centre of body 2", "m"),
    ("planar-2r", "𝐃, dᵢⱼ", "inertia matrix, its entries", "kg m²"),
    ("planar-2r", "𝛕", "column of the generalized forces", "N m"),
    ("cartesian-pp", "𝐠, gₖ", "column of the gravity terms, its entries", "N"),
    ("in3140-rp", "𝐪, qᵢ", "column of the coordinates, coordinate i", "rad or m"),
    ("in3140-rp", "Rot, Trans", "rotation about, translation along an axis: 4×4 matrix", ""),
    ("in3140-rp", "𝐑_{z,θ}", "rotation by an angle about an axis: 3×3 matrix", ""),
    ("elbow-3r", "𝐪, qᵢ", "column of the coordinates, coordinate i", "rad"),
    ("cartesian-pp", "𝐉, 𝐉_v, 𝐉_ω, 𝐉ᵢ", JACOBIANS, "1"),
    ("planar-2r", "𝐉, 𝐉_v, 𝐉_ω, 𝐉ᵢ", JACOBIANS, "m or 1"),
    ("in3140-rp", "𝐃, dᵢⱼ", "inertia matrix, its entries", "kg m², kg m or kg"),
    ("cartesian-pp", "𝐃, dᵢⱼ", "inertia matrix, its entries", "kg"),
    ("planar-2r", "Kᵢ, K_vi, K_ωi, Pᵢ",
     "kinetic energy, its part of translation, its part of rotation, potential energy of body i", "J"),
    ("planar-2r", "𝐈ᵢ^b",
     "inertia tensor of body i about its mass centre, along the body's axes (b)", "kg m²"),
    ("elbow-3r", "𝐈ᵢ", "inertia tensor of body i about its mass centre, along the body's axes", "kg m²"),
    ("spherical-rrp", "σ₁", "abbreviation, defined where it first occurs", "kg m²"),
    ("box-cylinder-rod-sphere", "σ₁, σ₂", "abbreviations, defined where they first occur", "kg m²"),
    ("box-cylinder-rod-sphere", "σ₃", "abbreviation, defined where it first occurs", "kg m"),
    ("elbow-3r", "U, V", "any two quantities, in an identity", ""),
    ("in3140-rp", "s₁, c₁", "s₁ = sin θ₁, c₁ = cos θ₁", ""),
    ("in3140-rp", "τᵢ, fᵢ",
     "generalized force i: a torque at a revolute joint, a force (fᵢ) at a prismatic one", "N m or N"),
    ("planar-2r", "τᵢ", "generalized force i, a torque", "N m"),
    ("cartesian-pp", "τᵢ, fᵢ", "generalized force i, a force", "N"),
    ("elbow-3r", "𝐃_points", "inertia matrix of the masses alone, as points", "kg m²"),
    ("in3140-rp", "θ, d, a, α", "columns of the Denavit-Hartenberg table", "rad, m, m, rad"),
    ("inf3480-rrp-drawn", "θ, d, a, α", "columns of the Denavit-Hartenberg table", "rad, m, m, rad"),
    ("elbow-3r", "s₁, c₁, …, s₂₃, c₂₃",
     "s₁ = sin θ₁, c₁ = cos θ₁, s₂₃ = sin(θ₂ + θ₃), c₂₃ = cos(θ₂ + θ₃), and so on", ""),
    ("cartesian-pp", "𝐂", "matrix of the Coriolis and centrifugal terms", "kg/s"),
    ("elbow-3r", "𝐂, Cₖⱼ",
     "matrix of the Coriolis and centrifugal terms, its entries; Spong writes c for the entries", "kg m²/s"),
    ("elbow-3r", "𝐠, gₖ", "column of the gravity terms, its entries", "N m"),
    ("planar-2r-remote", "s₁, c₁, s₂, c₂",
     "s₁ = sin p₁, c₁ = cos p₁, s₂ = sin p₂, c₂ = cos p₂", ""),
    ("box-cylinder-rod-sphere", "r₁, r₄", "radius of body i", "m"),
    ("box-cylinder-rod-sphere", "b", "side of body 2 along its axes x and y", "m"),
    ("numeric-2r", "m", "mass of a uniform shape", "kg"),
    ("box-cylinder-rod-sphere", "m₁, m₂, …, m₄, mᵢ", "mass of body i", "kg"),
    ("numeric-2r", "l", "length of a uniform shape", "m"),
]  # fmt: skip


@pytest.mark.parametrize(("problem", "sign", "meaning", "unit"), MEANINGS)
def test_what_a_sign_means_is_told(problem: str, sign: str, meaning: str, unit: str) -> None:
    assert lines(problem)[sign] == (meaning, unit)


def test_a_letter_that_is_taken_gives_way() -> None:
    """c₂₃ is cos(θ₂ + θ₃): the entry of C is C₂₃; z₁ is a mass centre's coordinate: the axis is bold."""
    elbow = solved("elbow-3r").style
    assert to_unicode(Letter("c", Symbol("2")), elbow) == "c₂"
    assert elbow.letters == {("c", "italic", 2): "C"}
    assert solved("crustcrawler-2r").style.letters == elbow.letters  # c₁₂ would be read as a cosine
    clashing = solved(CLASHING).style
    assert {base for base, _, _ in clashing.letters} == {"c", "d", "g", "P", "K", "f"}


@pytest.mark.parametrize(
    ("problem", "others"),
    [
        (OF_IDENTITIES, {"eta": "chi", "u": "xi", "U": "mu", "V": "H", "n": "N"}),
        (OF_SOLUTIONS, {"psi": "omega", "A": "E", "B": "F", "X": "S", "Y": "T"}),
        (OF_CONSTRAINTS, {"lambda": "nu", "tau": "T", "f": "F", "u": "xi"}),
        (OF_THE_TABLE, {"theta": "beta", "d": "p", "a": "delta"}),
    ],
)
def test_the_letters_of_a_solution_give_way_too(problem: str, others: dict[str, str]) -> None:
    found = {base: other for (base, _, _), other in solved(problem).style.letters.items() if base != "c"}
    assert found == others
    assert "Spong writes ψ" not in str(solved(problem)) and "Spong writes η" not in str(solved(problem))


@pytest.mark.parametrize("problem", [*PROBLEMS, CLASHING])
def test_g_in_a_sentence_is_set_as_a_formula(problem: str) -> None:
    """g is a number and 𝐠 a column: a sentence or a heading that just says g does not tell which."""
    said = [block.text for block in document(problem).blocks if isinstance(block, Heading)]
    for block in unfolded(document(problem).blocks):
        if isinstance(block, (Text, Note)):
            said += [part for part in block.parts if isinstance(part, str)]
    assert [text for text in said if re.search(r"(?<![\w'])g(?!\w)", text)] == []


def unfolded(blocks: Iterable[Block]) -> Iterator[Block]:
    """Every block, and in place of a fold its heading and what is in it."""
    for block in blocks:
        if isinstance(block, Fold):
            yield Text((block.title,))
            yield from unfolded(block.blocks)
        else:
            yield block


@pytest.mark.slow
def test_an_axis_is_not_the_coordinate_of_a_mass_centre() -> None:
    style = solved("puma560").style
    assert to_unicode(Letter("z", Symbol("1"), None, "bold"), style) == "𝐳₁"
    assert to_unicode(Symbol("z1"), style) == "z₁"


def test_no_shorthand_where_its_letter_is_a_coordinate() -> None:
    style = solved(TAKEN).style
    assert "theta1" not in style.shorthand
    page = latex.render(document(TAKEN), style)
    assert r"\sin(\theta_{1})" in page and r"\cos(\theta_{1}+\theta_{2})" in page.replace(" ", "")
    assert "s₁, " not in "".join(lines(TAKEN))


ASKED = """
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
task: [tip.x, tip.y]
reach: [px, py]
find: [inverse, Jr, det]
"""


def test_what_an_exercise_asks_for_besides_has_its_letters_too() -> None:
    told = lines(ASKED)
    assert told["p_x, p_y"][0] == "values of the task that are to be reached"
    assert told["𝐫"][0] == "task"
    assert told["𝐉_r"][0] == "Jacobian of the task; with + its pseudoinverse"
    blocks = document(ASKED).blocks
    known = {
        kind
        for line in notation(solved(ASKED).robot, solved(ASKED).style, blocks).lines
        for kind in line.kinds
    }
    known |= TOLD_IN_WORDS
    assert kinds_in(formulas_in(blocks), solved(ASKED).style) - known == set()


def test_the_letters_of_shapes_are_told_where_there_are_shapes() -> None:
    """The values of a task may be called x, y and z, as the sides of a box are."""
    assert lines("inf3480-rpr")["x, y, z"] == ("values of the task that are to be reached", "")
    assert "of a uniform shape" in lines("numeric-2r")["l"][0]
    assert not any("of a uniform shape" in meaning for meaning, _ in lines("crustcrawler-2r").values())


@pytest.mark.parametrize("problem", ["planar-2r-reach", "in3140-rp"])
def test_what_a_dot_means_is_told_wherever_there_is_one(problem: str) -> None:
    remarks = notation(solved(problem).robot, solved(problem).style, document(problem).blocks).remarks
    assert "A dot is the derivative with respect to the time " in remarks


@pytest.mark.parametrize(
    ("problem", "told"),
    [("in3140-rp", "𝐃, 𝐃_points, 𝐂, 𝐍 and cᵢⱼₖ"), ("planar-2r", ""), ("cartesian-pp", "")],
)
def test_units_of_entries_are_those_for_angles_where_there_are_lengths_too(problem: str, told: str) -> None:
    """d₂₂ = m₂ of the RP arm is in kg m²/m² = kg, c₁₂₁ = m₂ L₂ in kg m²/m."""
    style = solved(problem).style
    remarks = notation(solved(problem).robot, style, document(problem).blocks).remarks
    said = "".join(part if isinstance(part, str) else to_unicode(part, style) for part in remarks)
    rule = f"The units of {told} are listed for angles: divide by the metre for each "
    rule += "index that belongs to a length."
    assert (rule in said) if told else ("listed for angles" not in said)


def test_the_entries_of_the_parameters_are_not_lengths_of_the_table() -> None:
    """With a_i in the table, entry i of the parameters is (a)_i."""
    (step,) = (step for step in solved("rp-parameters").steps if step.id == "a")
    shown = [to_unicode(node, solved("rp-parameters").style) for node in step.lines[-1].formulas]
    assert shown[0] == "m₁ d_c1 + m₂ l₁ = l₁ (𝐚)₂ + (𝐚)₃"


def test_a_shorthand_is_told_once_where_there_are_no_others() -> None:
    robot = solved("planar-2r").robot
    q1, q2 = (Symbol(q.name) for q in robot.coordinates)
    cosines = Formula(Sum((Function("cos", q1), Function("cos", Sum((q1, q2))))))
    style = style_of(robot)
    (line,) = notation(robot, style, [cosines]).lines
    assert isinstance(line.words, Node)
    assert to_unicode(line.words, style) == "c₁ = cos q₁, c₁₂ = cos(q₁ + q₂)"


@pytest.mark.parametrize(
    ("rows", "letter"),
    [
        ("{theta: q1*, alpha: alpha1}, {theta: q2*, d: d, alpha: alpha_2}", "alpha"),
        ("{theta: alpha1*, a: d}, {theta: q2*}", "gamma"),
        ("{theta: q1*, alpha: alpha2}, {theta: q2*, d: d, alpha: alpha_1}", "gamma"),
        ("{theta: alpha1*, a: d}, {theta: gamma2*}", "delta"),
    ],
)
def test_a_column_has_a_letter_that_no_other_thing_has(rows: str, letter: str) -> None:
    """What the file itself calls alpha_1 in row 1 of that column is no other thing."""
    style = report_style(read_problem(f"dh: [{rows}]\n").robot)
    assert style.letters.get(("alpha", "italic", 1), "alpha") == letter
