"""What YAML makes of a file, and what is said where it makes nothing of it."""

from __future__ import annotations

import pytest

from dynsolve.problem import read_problem
from tests.unit.problem.marked import PLANAR, errors, places, unmarked

SYNTAX = {
    "a tab": ("dh:\n«\t»- {theta: q1*}\n", "a tab cannot indent"),
    "a brace that stays open": ("dh:\n  - «{»theta: q1*, d: 0\n", "never closed"),
    "a bracket that stays open": ("gravity: «[»0, 0, -g\n", "never closed"),
    "the wrong bracket": ("gravity: [0, 0, -g«}»\n", "does not close the `[`"),
    "a missing comma": ("dh:\n  - {theta: q1* d«:» 0}\n", "a comma is missing"),
    "LaTeX between braces": ("dh:\n  - {theta: q1*, alpha: «\\»frac{pi}{2}}\n", "is LaTeX"),
    "a bracket too many": ("find: [tau]«]»\n", "closes nothing"),
    "a comma too many": ("gravity: [0,«,» -g]\n", "a value is missing"),
    "two colons": ("title: RP«:» a manipulator\n", "this `:` cannot stand here"),
    "an open quote": ("title: «'»RP\n", "this quote is never closed"),
    "a minus with a blank": ("dh:\n  - {theta: q1*, d: «-» h}\n", "begins an item of a list"),
    "a reserved character": ("title: «@»home\n", "cannot begin with `@`"),
    "a word alone": ("dh:\n  - {theta: q1*}\n«m»asses\n", "a `:` is missing"),
    "lines that do not fit": ("dh:\n  - {theta: q1*}\n «-» {theta: q2*}\n", "does not fit"),
    "an unknown escape": ('title: "«\\»gamma"\n', "an escape that YAML does not know"),
    "a star before its name": ("dh:\n  - {theta: «*theta1»}\n", "is a YAML alias"),
    "a star alone": ("dh:\n  - {theta: «*» theta1}\n", "cannot begin with `*`"),
    "an anchor": ("title: «&x» y\n" + PLANAR, "is a YAML anchor"),
    "a tag": ("title: «!!str» y\n" + PLANAR, "YAML tag"),
    "a key twice": ("title: a\n«title»: b\n" + PLANAR, "`title` is given twice, first in line 1"),
    "a column twice": ("dh:\n  - {theta: q1*, d: 0, «theta»: q2*}\n", "`theta` is given twice"),
    "a list as a key": ("? «[a]»\n: 1\n" + PLANAR, "a key is a word"),
    "a second document": (PLANAR + "«---»\ntitle: x\n", "a second document"),
}


@pytest.mark.parametrize("name", SYNTAX)
def test_a_fault_of_syntax_has_its_place(name: str) -> None:
    marked, message = SYNTAX[name]
    text, expected = unmarked(marked)
    found = errors(text)
    assert places(found)[: len(expected)] == expected
    assert message in found[0].message
    assert found[0].help


def mass(text: str):
    robot = read_problem(f"{PLANAR}masses:\n  - {{mass: {text}, link: 1}}\n").robot
    return robot, robot.bodies[0].mass


@pytest.mark.parametrize(
    ("text", "value"),
    [("1e-3", "1/1000"), ("010", "10"), ("1_000", None), ("0x1F", None), ("1:30", None), (".5", "1/2")],
)
def test_numbers_are_what_they_look_like(text: str, value: str | None) -> None:
    if value is None:
        assert errors(f"{PLANAR}masses:\n  - {{mass: {text}, link: 1}}\n")
    else:
        assert str(mass(text)[1].number) == value


@pytest.mark.parametrize("word", ["no", "on", "yes", "null", "true", "E", "N", "e1"])
def test_words_that_yaml_knows_are_symbols(word: str) -> None:
    robot, value = mass(word)
    assert value == robot.ring.symbol(word)


def test_a_backslash_in_double_quotes_is_no_tab() -> None:
    found = errors(f'{PLANAR}masses:\n  - {{mass: "\\theta", link: 1}}\n')
    assert "`\\` has no meaning here" in found[0].message
    assert places(found) == [(6, 13, 1)]


def test_quotes_and_folded_lines_in_prose() -> None:
    problem = read_problem("title: 'the RP''s arm: \"first\"'\nsource: >\n  a book\n  of 2006\n" + PLANAR)
    assert problem.title == 'the RP\'s arm: "first"'
    assert problem.source == "a book of 2006"
