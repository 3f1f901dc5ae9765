"""Every fault of a problem file: its place to the character, what is said, and the remedy.

In the texts «...» marks what is underlined.  The texts begin with a line break so
that they can be indented here.
"""

from __future__ import annotations

import pytest

from tests.unit.problem.marked import PLANAR, RP, errors, places, unmarked


def row(columns: str) -> str:
    return f"dh:\n  - {columns}\n"


def body(fields: str, table: str = PLANAR) -> str:
    return f"{table}masses:\n  - {fields}\n"


TABLE = {
    "the file is empty": ("", "empty", "dynsolve new"),
    "a list": ("«- a»", "is a list", "dynsolve new"),
    "no table": ("title: x", "no `dh` table", "{theta: theta1*"),
    "an empty table": ("«dh»: []", "no rows", "{theta: theta1*"),
    "no star": ("«dh»:\n  - {theta: theta1, d: L1}", "no joint variable", "theta1*"),
    "unknown key": ("«mass»: []\n" + PLANAR, "unknown key `mass`", "did you mean `masses`?"),
    "what others call a key": ("«bodies»: []\n" + PLANAR, "unknown key `bodies`", "did you mean `masses`?"),
    "unknown column": (row("{theta: q1*, «alfa»: 90deg}"), "unknown key `alfa`", "did you mean `alpha`?"),
    "no blank after the colon": (row("{theta: q1*, «d:L1»}"), "a blank is missing", "`d: L1`"),
    "a row as a word": (row("«q1*»"), "not a mapping but `q1*`", "{theta: theta1*"),
    "a bare number": (row("{theta: theta1* + «90», d: L1}"), "bare number 90", "did you mean 90deg?"),
    "a bare number in radians": (row("{theta: q1* - «1.5708»}"), "bare number", "did you mean 90deg?"),
    "a bare number in alpha": (row("{theta: q1*, alpha: -«90»}"), "bare number", "90deg"),
    "both starred": (
        row("«{theta: q1*, d: q2*, a: l, alpha: 90deg}»"),
        "a cylindrical joint takes two rows",
        "- {theta: q1*, d: 0, a: 0, alpha: 0} and - {theta: 0, d: q2*, a: l, alpha: 90deg}",
    ),
    "both starred, modified": (
        "convention: modified\n" + row("«{theta: q1*, d: q2*, a: l, alpha: 90deg}»"),
        "a cylindrical joint takes two rows",
        "- {theta: q1*, d: 0, a: l, alpha: 90deg} and - {theta: 0, d: q2*, a: 0, alpha: 0}",
    ),
    "two names that are printed alike": (
        row("{theta: q1*, a: l1}\n  - {theta: q2*, a: «l_1»}"),
        "l_1 is printed as l1 is",
        "another name",
    ),
    "theta and th": (
        row("{theta: theta1*, a: l}\n  - {theta: «th1»*, a: l}"),
        "th1 is printed as",
        "another",
    ),
    "a star in a": (row("{theta: q1*, a: «l*»}"), "a of row 1 is constant", "theta (revolute) and d"),
    "a star in alpha": (row("{theta: q1*, alpha: «beta*»}"), "alpha of row 1 is constant", "beta"),
    "an angle and a length": (
        row("{theta: q1*}\n  - {d: «q1»*}"),
        "q1 stands in d here and in theta of row 1",
        "coordinates of their own",
    ),
    "without its star": (row("{theta: p1*}\n  - {theta: p2* - «p1»}"), "without its star", "write p1*"),
    "a coordinate in a": (row("{theta: p1*}\n  - {theta: p2*, a: «p1»}"), "a of row 2", "another name"),
    "a coordinate in alpha": (row("{theta: p1*, alpha: «p1»}"), "alpha of row 1", "another name"),
    "a power": (row("{theta: «p1*^2»}"), "stands in a power", "a sum of coordinates times rational"),
    "a function": (row("{theta: «sin(p1*)»}"), "stands in sin(...)", "a sum of coordinates"),
    "a symbolic coefficient": (row("{d: «k*x*»}"), "coefficient of x is not a rational", "a sum"),
    "an irrational coefficient": (row("{d: «sqrt(2)*x*»}"), "coefficient of x is not a rational", "a sum"),
    "a denominator": (row("{d: «1/x*»}"), "stands in a denominator", "a sum"),
    "a product": (row("{d: «(x* + 1)*(y* + 1)»}"), "a product of coordinates", "a sum"),
    "cancelling": (row("{d: x*}\n  - {d: «y* - y*»}"), "cancels", "signs"),
    "divided by zero": (row("{d: «x*/0»}"), "zero", "a sum"),
    "a missing operator": (row("{d: x*, a: m1« »g}"), "a `*` is missing", "m1*g"),
    "a far larger angle": (
        row("{theta: q1*}\n  - {theta: «1000*q1*»}"),
        "1000 times",
        "angles of one size",
    ),
    "edition": ("edition: «3»\n" + PLANAR, "one of 1, 2", "write edition: 1 or edition: 2"),
    "convention": ("convention: «dh»\n" + PLANAR, "one of standard, modified", "that of Craig"),
    "a Greek column": (row("{«θ»: q1*}"), "unknown key `θ`", "did you mean `theta`?"),
    "a column that is no name": (row("{theta: q1*, «0²»: 1}"), "unknown key `0²`", "known are"),
    "a unit": (row("{theta: q1*, a: 0.5« »m}"), "a `*` is missing", "if `m` is the unit, leave it out"),
    "an unknown coordinate": (
        "«coordinates»: [theta2, «theta3»]\n" + PLANAR,
        "leaves out theta1",
        "[theta1, theta2]",
    ),
    "a coordinate twice": ("coordinates: [theta2, theta1, «theta1»]\n" + PLANAR, "listed twice", ""),
    "coordinates as a word": ("coordinates: «theta1»\n" + PLANAR, "must be a list", "[theta1, theta2]"),
}

BODIES = {
    "masses as a word": (PLANAR + "masses: «m1»", "must be a list", "{mass: m1, link: 1"),
    "a body as a word": (body("«m1»"), "not a mapping but `m1`", "{mass: m1, link: 1"),
    "no mass": (body("«{link: 1}»"), "has no `mass`", "mass: m1"),
    "a misspelled mass": (body("{«mas»: m1, link: 1}"), "unknown key `mas`", "did you mean `mass`?"),
    "a look-alike": (body("{«m\u0430ss»: m1, link: 1}"), "unknown key", "U+0430 (cyrillic small letter a)"),
    "a look-alike in a name": (body("{mass: m«\u0430», link: 1}"), "CYRILLIC", "Latin letter `a`"),
    "no link": (body("«{mass: m1}»"), "has no `link`", "link: 1"),
    "a link too far": (body("{mass: m1, link: «3»}"), "there is no link 3", "from 1 to 2"),
    "the ground": (body("{mass: m1, link: «0»}"), "link 0 is the ground", "from 1 to 2"),
    "a link in words": (body("{mass: m1, link: «one»}"), "a whole number", "from 1 to 2"),
    "a negative mass": (body("{mass: «-2», link: 1}"), "negative", "not negative"),
    "a negative mass in letters": (body("{mass: «-m2», link: 1}"), "negative", "not negative"),
    "a moving mass": (body("{mass: m1*«theta1», link: 1}"), "contains the coordinate theta1", "constant"),
    "a starred mass": (body("{mass: «m1*», link: 1}"), "the mass of body 1 is constant", "write m1"),
    "a moving centre": (body("{mass: m, link: 1, center: [«theta2», 0, 0]}"), "the coordinate theta2", ""),
    "a centre of two": (body("{mass: m, link: 1, center: «[1, 2]»}"), "2 components, not 3", "[x, y, z]"),
    "an unknown centre": (body("{mass: m, link: 1, center: «mid»}"), "tip, origin, midpoint", "midpoint"),
    "two ways to a centre": (body("{mass: m, link: 1, center: «{along: 1, near: [0, 0, 0]}»}"), "one of", ""),
    "a centre along one axis": (body("{mass: m, link: 1, center: «l1/2»}"), "one of tip", "[x, y, z]"),
    "a tensor as three moments": (
        body("{mass: m, link: 1, center: tip, inertia: «[0, 0, I]»}"),
        "a tensor, not a list of three",
        "write {xx: 0, yy: 0, zz: I}",
    ),
    "no centre": (body("«{mass: m, link: 1, inertia: {zz: I}}»"), "has no `center`", "midpoint"),
    "a bad name": (body("{mass: m, link: 1, name: «v1»}"), "cannot be `v1`", "not v or w"),
    "a name twice": (body("{mass: m, link: 1}\n  - {mass: m, link: 2, name: «1»}"), "has already", "own"),
    "zero below": (body("{mass: m, link: 1, center: {along: «l1/(l2 - l2)»}}"), "denominator is zero", ""),
    "a root of -1": (body("{mass: «sqrt(-1)», link: 1}"), "root of a negative number", "real"),
    "a tower of powers": (body("{mass: 9«**»9**9, link: 1}"), "exponent", ""),
    "sin of a number": (body("{mass: «m*sin(3)», link: 1}"), "bare number 3", "3deg"),
    "a shape without dimensions": (body("{mass: m, link: 1, shape: «rod»}"), "needs its", "{length: ...}"),
    "an unknown shape": (
        body("{mass: m, link: 1, shape: «rood»}"),
        "cannot be `rood`",
        "did you mean `rod`?",
    ),
    "an unknown shape with dimensions": (
        body("{mass: m, link: 1, center: tip, shape: {«ball»: {radius: r}}}"),
        "`ball` is no shape",
        "shapes are point, box",
    ),
    "an axis beside a shape": (
        body("{mass: m, link: 1, center: tip, shape: «{rod: {length: l}, axis: x}»}"),
        "one shape with its dimensions",
        "write axis among its dimensions: {rod: {..., axis: z}}",
    ),
    "a missing dimension": (
        body("{mass: m, link: 1, center: tip, shape: {cylinder: «{radius: r}»}}"),
        "lacks length",
        "radius, length",
    ),
    "a superfluous dimension": (
        body("{mass: m, link: 1, center: tip, shape: {sphere: {radius: r, «axis»: z}}}"),
        "an axis, along which nothing varies",
        "density",
    ),
    "a fourth axis": (
        body("{mass: m, link: 1, center: tip, shape: {rod: {length: l, axis: «w»}}}"),
        "one of x, y, z",
        "",
    ),
    "a negative dimension": (
        body("{mass: m, link: 1, center: tip, shape: {sphere: {radius: «-1»}}}"),
        "negative",
        "",
    ),
    "an inertia that is no tensor": (
        body("{mass: m, link: 1, center: tip, inertia: «I1»}"),
        "is a tensor, not `I1`",
        "{zz: I1}",
    ),
    "an unknown moment": (
        body("{mass: m, link: 1, center: tip, inertia: {«zx»: I1}}"),
        "unknown key `zx`",
        "did you mean `xz`?",
    ),
    "an asymmetric tensor": (
        body("{mass: m, link: 1, center: tip, inertia: [[1, 2, 3], [2, 4, 5], [3, «6», 7]]}"),
        "I_zy = 6 is not I_yz = 5",
        "symmetric",
    ),
    "a short row": (
        body("{mass: m, link: 1, center: tip, inertia: [[1, 2, 3], «[2, 4]», [3, 6, 7]]}"),
        "three entries",
        "",
    ),
    "about without inertia": (body("{mass: m, link: 1, «about»: joint}"), "no `inertia`", "delete it"),
    "midpoint of a prismatic link": (
        body("{mass: m, link: 2, center: «midpoint»}", RP),
        "would not be fixed in link 2",
        "center: [0, 0, -lc2]",
    ),
    "near the end of a prismatic link": (
        body("{mass: m, link: 2, center: «{near: [0, 0, lc]}»}", RP),
        "would not be fixed in link 2",
        "center: [0, 0, -lc2]",
    ),
    "about the joint of a prismatic link": (
        body("{mass: m, link: 2, center: tip, inertia: {zz: I}, about: «joint»}", RP),
        "no fixed point of link 2",
        "origin",
    ),
    "the tip of the last modified link": (
        "convention: modified\n" + body("«{mass: m, link: 2}»"),
        "no far end",
        "add a fixed row",
    ),
    "half-way along a link that branches": (
        "convention: modified\ndh: [{theta: q1*}, {theta: q2*, a: l}, {theta: q3*, a: l, from: 1}]\n"
        "masses: [{mass: m, link: 1, center: «midpoint»}]",
        "link 1 has several far ends: rows 2 and 3 come after it",
        "give the centre in frame 1, [x, y, z]",
    ),
    "the tip before a prismatic joint": (
        "convention: modified\n" + body("{mass: m, link: 1, center: «tip»}", RP),
        "its far end moves with the prismatic joint 2",
        "fixed row",
    ),
    "a rod across": (
        body("{mass: m, link: 1, center: tip, shape: «{rod: {length: l}}»}", row("{theta: q1*, d: h, a: l}")),
        "lies along none of the body-attached axes",
        "axis: x",
    ),
    "a rod without a link": (
        body("{mass: m, link: 1, center: tip, shape: «{rod: {length: l}}»}", row("{theta: q1*}")),
        "has no length",
        "axis: x",
    ),
    "a rod turned askew": (
        body("{mass: m, link: 1, center: tip, axes: Rz(30deg), shape: «{rod: {length: l}}»}"),
        "none of the body-attached axes",
        "axis: x",
    ),
    "a reflection": (
        body("{mass: m, link: 1, axes: «[[1, 0, 0], [0, 1, 0], [0, 0, -1]]»}"),
        "the determinant is -1",
        "right-handed",
    ),
    "rounded axes": (
        body("{mass: m, link: 1, axes: «[[1, 0, 0], [0, 0.5, 0.866], [0, -0.866, 0.5]]»}"),
        "R Rᵀ is not the identity",
        "sqrt(3)/2",
    ),
    "axes in bare numbers": (body("{mass: m, link: 1, axes: Rx(«30»)}"), "bare number 30", "30deg"),
    "axes that are none": (body("{mass: m, link: 1, axes: Rx(30deg) «rz(3)»}"), "no rotation", "Rz(90deg)"),
    "axes that end": (body("{mass: m, link: 1, axes: «Rx(»30deg}"), "never closed", ")"),
    "axes that move": (body("{mass: m, link: 1, axes: Rz(«theta1»)}"), "contains the coordinate", ""),
    "axes of a product": (
        body("{mass: m, link: 1, axes: {base: Rz(«theta1*theta2»)}}"),
        "not linear",
        "a sum",
    ),
    "axes turned by a length": (body("{mass: m, link: 1, axes: {base: Rz(«L2»)}}", RP), "the length L2", ""),
    "axes of another base": (body("{mass: m, link: 1, axes: {«bse»: Rz(30deg)}}"), "key `bse`", "`base`"),
}

REST = {
    "gravity as a word": ("gravity: «down»\n" + PLANAR, "gravity is a vector", "[0, 0, -g]"),
    "gravity of two": ("gravity: «[0, -g]»\n" + PLANAR, "2 components", ""),
    "moving gravity": ("gravity: [0, 0, «theta1»]\n" + PLANAR, "the coordinate theta1", ""),
    "a moving base": ("base: Rz(«theta1»)\n" + PLANAR, "the coordinate theta1", "does not move"),
    "a base of an unknown key": ("base: {rotate: Rz(90deg), «mov»: [0, 0, h]}\n" + PLANAR, "`mov`", "`move`"),
    "a value that is none": ("values: {l1: «x»}\n" + PLANAR, "not a number", "0.4"),
    "a value with its unit": ("values: {m: 3« »kg}\n" + PLANAR, "a `*` is missing", ""),
    "a unit that is none": ("units: {l1: «[m]»}\n" + PLANAR, "cannot be a list", "kg"),
    "marks for nothing": ("marks: {«K9»: 3}\n" + PLANAR, "no answer of this problem", ""),
    "a remark on nothing": ("remarks: {«K9»: x}\n" + PLANAR, "no result of this problem", ""),
    "two remarks": ("remarks: {M: x, «D»: y}\n" + PLANAR, "a remark already", "list"),
    "an empty remark": ("remarks: {D: «''»}\n" + PLANAR, "is words, not nothing", "Kv2"),
    "a remark that is a mapping": ("remarks: {D: «{a: b}»}\n" + PLANAR, "is words, not a mapping", "Kv2"),
    "remarks without names": ("remarks: «hello»\n" + PLANAR, "is a mapping, not `hello`", "Kv2"),
    "negative marks": ("marks: {P: «-1»}\n" + PLANAR, "negative", ""),
    "marks twice": ("marks: {M: 1, «D»: 2}\n" + PLANAR, "marks already", ""),
    "an unknown answer": ("find: [tau, «foo»]\n" + PLANAR, "no answer of this problem", "tau, D, C, g"),
    "an answer twice": ("find: [D, «M»]\n" + PLANAR, "asked for twice", ""),
    "a mass that is a length": (body("{mass: «l1», link: 1}"), "a mass here and a length in line 3", "own"),
    "an angle that is a length": (row("{theta: q1* + beta, a: «beta»}"), "a length here and an angle", "own"),
    "the letter of gravity": (row("{theta: q1*, a: «g»}"), "the default gravity", "another letter"),
    "gravity's letter for a joint": ("«dh»:\n  - {theta: g*}\n", "g is a coordinate", "gravity: none"),
    "a velocity's name": (body("{mass: «theta1_dot», link: 1}"), "the velocity of theta1", "another name"),
    "an acceleration's name": (body("{mass: «theta2_ddot», link: 1}"), "the acceleration of theta2", ""),
}

ALL = TABLE | BODIES | REST


@pytest.mark.parametrize("name", ALL)
def test_a_fault_is_found_where_it_stands(name: str) -> None:
    marked, message, remedy = ALL[name]
    text, expected = unmarked(marked)
    found = errors(text)
    assert found, "no error was found"
    if expected:
        assert places(found) == expected
    assert any(message in finding.message for finding in found), found
    assert any(remedy in finding.help for finding in found), found


def test_all_faults_of_a_file_come_at_once_in_its_order() -> None:
    text, expected = unmarked(
        """
        convention: «craig»
        gravity: «9.81»
        dh:
          - {theta: theta1* + «90», «dd»: L1}
          - {theta: theta2*, d: 0, a: «l2*», alpha: 0}
        masses:
          - {mass: m1« »g, link: «5»}
          - {mass: «-1», link: 1, inertia: [[1, 0, 0], [«2», 1, 0], [0, 0, 1]], center: «middle»}
        values: {l2: «long»}
        """
    )
    assert places(errors(text)) == expected


def test_an_error_reads_as_a_person_needs_it() -> None:
    text = "dh:\n  - {theta: theta1* + 90, d: L1}\n"
    assert str(errors(text)[0]).splitlines() == [
        "robot.yaml:2:23: the bare number 90 stands as an angle",
        "    - {theta: theta1* + 90, d: L1}",
        "                        ^^",
        "help: did you mean 90deg? Angles are written in degrees (90deg) or with pi (pi/2)",
    ]


@pytest.mark.parametrize(
    "marked",
    [
        """
        dh:
          - {theta: "theta1* + «90»", d: 'L1«+»'}
        """,
        """
        dh:
          - theta: |
              theta1* +
              «90»
            d: >-
              L1 «+»
        """,
        """
        dh:
          - {theta: theta1*
             + «90», d: L1 «+»}
        """,
    ],
)
def test_places_hold_in_quotes_blocks_and_over_lines(marked: str) -> None:
    text, expected = unmarked(marked)
    assert places(errors(text)) == expected
