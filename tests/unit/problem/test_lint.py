"""What lint finds, and what it leaves alone."""

from __future__ import annotations

from pathlib import Path

import pytest

from dynsolve.problem.lint import lint, lint_text
from dynsolve.problem.schema import template
from tests.support import LIBRARY, TEXTBOOKS
from tests.unit.problem.marked import PLANAR, places, unmarked

MASS = PLANAR + "masses:\n  - {mass: m2, link: 2}\n"


def body(fields: str) -> str:
    return MASS + f"  - {{{fields}}}\n"


FINDINGS = {
    "unused-value": "values: {l1: 1, «L2»: 3}\n" + MASS,
    "unused-value of a unit": "units: {«q»: m}\n" + MASS,
    "not-positive": "values: {l1: 1}\nvary: {«values.l1»: {from: -0.5, to: 1, step: 0.5}}\n" + MASS,
    "not-positive of a mass": "values: {m2: 1}\nvary: {«values.m2»: [0, 1/2]}\n" + MASS,
    "kept-letter": "title: Find «l1» here\nvary: {letters: {l1: [l1, a1]}}\n" + MASS,
    "kept-letter in a text": "text: Of $l1$ and «l1»\nvary: {letters: {l1: [l1, a1]}}\n" + MASS,
    "gravity-upward": "gravity: «[0, 0, g]»\n" + MASS,
    "gravity-upward in numbers": "gravity: «[0, 0, 9.81]»\n" + MASS,
    "unasked velocity": "«velocity»: [vx, vy]\nfind: [Jr]\n" + PLANAR,
    "unasked state": "«state»: {theta1: 0}\nfind: [Jr, det]\n" + PLANAR,
    "unasked task": "«task»: [tip.x]\n" + PLANAR,
    "constant-task": "task: [tip.x, «phi»]\nfind: [Jr]\n" + PLANAR,
    "ambiguous-name c1": body("mass: «c1», link: 1"),
    "ambiguous-name s12": body("mass: «s12», link: 1"),
    "ambiguous-name c_2": body("mass: «c_2», link: 1"),
    "ambiguous-name dq1": body("mass: «dq1», link: 1"),
    "ambiguous-name dtheta2": body("mass: «dtheta2», link: 1"),
    "ambiguous-name thetadot1": body("mass: «thetadot1», link: 1"),
    "ambiguous-name q2": body("mass: «q2», link: 1"),
    "similar-names": body("mass: lc1, link: 1, center: tip, inertia: {zz: «l_c_1»}"),
    "similar-names by case": body("mass: lc1, link: 1, center: tip, inertia: {zz: «Lc1»}"),
    "yaml-word": body("mass: «null», link: 1"),
    "unstarred slide": "dh:\n  - {theta: q1*}\n  - {d: «q2»}\n",
    "unstarred": "dh:\n  - {theta: q1*}\n  - {theta: «q2»}\n",
    "moves-no-mass": PLANAR.replace("theta2*", "«theta2*»") + "masses: [{mass: m1, link: 1}]",
    "no-tool-row": "convention: modified\ndh: [{theta: q1*}, {theta: «q2*», a: l1}]\n",
    "ground-body": "dh:\n  - {d: h}\n  - {theta: q1*}\nmasses: [«{mass: m1, link: 1}», {mass: m2, link: 2}]",
    "no-effect": MASS + "  - «{mass: 0, link: 1, center: tip}»\n",
    "no-effect of a shape": body(
        "mass: M, link: 1, center: tip, «shape»: {sphere: {radius: r}}, inertia: {zz: I1}"
    ),
    "beside-its-link": "dh: [{theta: q1*, d: h, a: l}]\n"
    "masses: [{mass: m, link: 1, center: «midpoint», shape: {rod: {length: l, axis: x}}}]",
    "beside-its-link with a density": "dh: [{theta: q1*, d: h, a: l}]\n"
    "masses: [{link: 1, center: «midpoint», shape: {cylinder: {radius: r, length: h, axis: z, density: 2}}}]",
    "left-out-moment": "dh: [{theta: q1*, alpha: 90deg}, {theta: q2*, a: l}]\n"
    "masses: [{mass: m, link: 2, center: tip, inertia: «{zz: I}»}]",
    "left-out-moment of a body by its position": "model:\n  coordinates: {a: revolute}\n  bodies:\n"
    "    - {mass: m, at: [0, 0, 0], turn: a, about: [1, 0, 0], inertia: «{zz: I}»}",
    "drawn-angles": "axes: [{turn: q1, about: [0, 0, 1], through: [0, 0, 0]},\n"
    "  {turn: q2, about: [0, -1, 0], through: [0, 0, h]}]\ntip: [0, 0, h + l]\nzero: «table»",
    "drawn-angles without zero": "«axes»: [{turn: q1, about: [0, 0, 1], through: [0, 0, 0]}]\ntip: [0, l, 0]",
    "mixed-units of a spring": "dh: [{d: x*}]\nmasses: [{mass: m, link: 1}]\n"
    "motors: [{turns: thm*, inertia: J}]\nsprings: [{stiffness: k, of: «x - thm»}]",
    "mixed-units of a damper": "dh: [{theta: a*, a: l}, {d: x*}]\nmasses: [{mass: m, link: 2}]\n"
    "springs: [{stiffness: k, of: x - r*a}, {stiffness: k, of: x - 0.2*a}]\n"
    "dampers: [{damping: b, of: «a + x»}]",
    "unphysical and negative": MASS + "  - «{mass: M, link: 1, center: tip, inertia: {zz: -1}}»\n",
    "unphysical": MASS + "  - «{mass: M, link: 1, center: tip, inertia: {xx: 1, yy: 1, zz: 3}}»\n",
    "unphysical about the mass centre": MASS
    + "  - «{mass: M, link: 1, center: midpoint, inertia: {zz: M*l1^2/8}, about: joint}»\n",
}


@pytest.mark.parametrize("name", FINDINGS)
def test_a_finding_has_its_code_and_its_place(name: str) -> None:
    text, expected = unmarked(FINDINGS[name])
    found = lint_text(text, "robot.yaml")
    assert [finding.code for finding in found] == [name.split()[0]]
    assert places(found) == expected
    assert found[0].message
    assert found[0].help


@pytest.mark.parametrize("path", LIBRARY + TEXTBOOKS, ids=lambda path: path.stem)
def test_the_library_and_the_textbooks_are_clean(path: Path) -> None:
    assert lint(path) == ()


@pytest.mark.parametrize(
    "text",
    [
        template(),
        PLANAR,
        body("mass: M2, link: 1"),
        body("mass: C, link: 1"),
        body("mass: s, link: 1, center: [lc1, 0, 0]"),
        body("mass: 0.1, link: 1, center: tip, inertia: {zz: 5}"),
        "convention: modified\ndh: [{theta: q1*}, {theta: q2*, a: l1}, {a: l2}]\n",
        "convention: modified\ndh: [{theta: q1*}, {d: d2*, alpha: 90deg}]\n",
        "values: {theta1: 30deg, theta1_dot: 1, m2: 3}\n" + MASS,
    ],
)
def test_what_is_usual_is_left_alone(text: str) -> None:
    assert lint_text(text) == ()


def test_a_value_that_only_reach_and_limits_use_is_used() -> None:
    text = "values: {a: 1, b: 90deg}\nreach: [a, 1]\nlimits: {theta1: [0, b]}\nfind: [inverse]\n" + PLANAR
    assert not lint_text(text.replace("l1", "1").replace("l2", "1"))
