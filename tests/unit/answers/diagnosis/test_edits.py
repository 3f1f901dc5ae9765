"""Right formulas with one or two mistakes, numbers for letters, one letter for another, more in the model.

What is told of them, put into them, gives what is right, or claims no more than what differs.
"""

from __future__ import annotations

import random
import re

import pytest

from dynsolve.notation import tree
from dynsolve.notation.printing import PLAIN
from dynsolve.notation.tree import Node, Number, Symbol, walk, with_children
from dynsolve.notation.unicode import to_unicode
from tests.unit.answers.diagnosis.mistakes import mended, mistakes, near, value
from tests.unit.answers.diagnosis.test_mistakes import NAMES_A_STEP, SEEDS, judged, read
from tests.unit.answers.hands import checker, problem, submission
from tests.unit.answers.test_generated import forms

STEMS = ["in3140-rp", "planar-2r", "rp-vertical", "spherical-rrp"]
QUANTITIES = ["P2", "K", "dLdqd1", "ddt1", "tau1", "D", "g", "C"]
ONLY_SAYS_WHAT_DIFFERS = {"terms_differ", "terms_missing", "trig_part", "constant_term", "zero"}
CASES = [(stem, name) for stem in STEMS for name in QUANTITIES]


def put(node: Node, old: Node, new: Node) -> Node:
    return new if node == old else with_children(node, lambda part: put(part, old, new))


def entry_of(stem: str, name: str, draw: random.Random) -> tuple[list[list[Node]], int, int] | None:
    """The rows of the right answer, and the place of one entry that is not 0."""
    right = forms(stem)(name)
    rows = [list(row) for row in right.rows] if isinstance(right, tree.Matrix) else [[right]]
    places = [(i, j) for i, row in enumerate(rows) for j, entry in enumerate(row) if entry != Number(0)]
    return (rows, *draw.choice(places)) if places else None


def names_of(stem: str) -> list[str]:
    robot = problem(stem).robot
    return [*robot.ring.parameters, *robot.ring.names]


def told(stem: str, name: str, rows: list[list[Node]], right: Node, wrong: Node) -> list[tuple[str, str]]:
    """What is said of an answer; nothing of one that is right all the same."""
    written = tree.Matrix(tuple(map(tuple, rows))) if len(rows) * len(rows[0]) > 1 else rows[0][0]
    found = judged(stem, name, written)
    if all(near(value(wrong, seed), value(right, seed)) for seed in SEEDS):
        assert found.verdict == "correct"
        return []
    if found.verdict == "correct":
        assert name == "P2"  # another zero of height
        return []
    assert found.diagnosis
    return [(d.code, d.message) for d in found.diagnosis if d.code != "dimensions"]


def is_true(stem: str, wrong: Node, right: Node, said: list[tuple[str, str]]) -> bool:
    """Whether all that is said mends the answer."""
    for seed in SEEDS:
        mine = value(wrong, seed)
        after = [mine]
        for _, message in said:
            bare = re.sub(r"^Entry \(\d, \d\) of C: ", "", message)
            bare = re.sub(r"^Entry \(\d, \d\) of C (has|is)", r"Your answer \1", bare)
            claims = mended(bare, mine, seed, lambda text: read(stem, text))
            assert claims is not None, message
            after = [one + claim - mine for one in after for claim in claims]
        if not any(near(one, value(right, seed)) for one in after):
            return False
    return True


@pytest.mark.parametrize(("stem", "name"), CASES)
def test_one_or_two_mistakes(stem: str, name: str) -> None:
    for number in (1, 2):
        draw = random.Random(f"{stem} {name} {number} edits")
        found = entry_of(stem, name, draw)
        if found is None:
            continue
        rows, i, j = found
        right = wrong = rows[i][j]
        for _ in range(number):
            made = list(mistakes(wrong, names_of(stem)))
            wrong = draw.choice(made)[1] if made else wrong
        rows[i][j] = wrong
        said = told(stem, name, rows, right, wrong)
        if name == "C" and any("Row" in message for _, message in said):
            continue
        if not {code for code, _ in said} & (ONLY_SAYS_WHAT_DIFFERS | NAMES_A_STEP | {"symbol_throughout"}):
            assert not said or is_true(stem, wrong, right, said), said
        if name == "C":
            assert all(message.startswith(f"Entry ({i + 1}, {j + 1}) of C") for _, message in said), said


@pytest.mark.parametrize(("stem", "name"), CASES)
def test_a_number_or_another_letter_throughout(stem: str, name: str) -> None:
    draw = random.Random(f"{stem} {name} letters")
    found = entry_of(stem, name, draw)
    if found is None:
        return
    rows, i, j = found
    right, robot = rows[i][j], problem(stem).robot
    letters = sorted({p.name for p in walk(right) if isinstance(p, Symbol)} & set(robot.ring.parameters))
    if not letters:
        return
    letter = draw.choice(letters)
    shown = to_unicode(Symbol(letter), PLAIN)
    rows[i][j] = wrong = put(right, Symbol(letter), Number(981, 100))
    for code, message in told(stem, name, rows, right, wrong):
        assert code in ("number_for_letter", "numbers_for_letters"), message
        assert shown in message.rpartition(" for ")[2]
    other = draw.choice([n for n in robot.ring.parameters if n != letter])
    rows[i][j] = wrong = put(right, Symbol(letter), Symbol(other))
    said = told(stem, name, rows, right, wrong)
    if {code for code, _ in said} == {"symbol_throughout"}:
        (message,) = (message for _, message in said)
        assert f"{to_unicode(Symbol(other), PLAIN)} stands wherever {shown} belongs" in message
    elif not {code for code, _ in said} & (ONLY_SAYS_WHAT_DIFFERS | NAMES_A_STEP):
        assert not said or is_true(stem, wrong, right, said), said


LOAD = {
    "P": "m1*g*lc1*sin(q1) + m2*g*(l1*sin(q1) + lc2*sin(q1+q2)) + mL*g*(l1*sin(q1) + l2*sin(q1+q2))",
    "d22": "m2*lc2^2 + I2 + mL*l2^2",
    "g": [["((m1*lc1 + m2*l1)*cos(q1) + m2*lc2*cos(q1+q2) + mL*(l1*cos(q1) + l2*cos(q1+q2)))*g"],
          ["(m2*lc2 + mL*l2)*g*cos(q1+q2)"]],
}  # fmt: skip


@pytest.mark.parametrize("name", LOAD)
def test_a_load_that_the_problem_does_not_have_is_another_model(name: str) -> None:
    (found,) = (a for a in checker("planar-2r")(submission({name: LOAD[name]})).answers if a.name == name)
    assert {d.code for d in found.diagnosis} == {"another_model"}
    assert "m_L" in found.diagnosis[0].message
    more = {"d22": f"{LOAD['d22']} + m1*l1^2"}
    (found,) = (a for a in checker("planar-2r")(submission(more)).answers if a.name == "d22")
    assert "another_model" not in {d.code for d in found.diagnosis}
