"""The records of quantities say what the derivation gives, for every robot of the library."""

from __future__ import annotations

from functools import lru_cache

import pytest

import dynsolve
from dynsolve.algebra.matrix import Matrix
from dynsolve.answers.reading.files import FileReader
from dynsolve.derivation.graph import Derivation
from dynsolve.derivation.rules import course_rules, derive
from dynsolve.notation.markup import to_latex
from dynsolve.notation.printing import PLAIN
from dynsolve.notation.unicode import to_unicode
from dynsolve.quantities import families
from dynsolve.quantities.families import FAMILIES
from dynsolve.quantities.family import Kind
from dynsolve.quantities.index import Quantity, quantities
from dynsolve.robot.dimensions import Dimensions
from dynsolve.robot.model import Robot
from tests.support import STEMS

SMALL = sorted(STEMS - {"puma560", "panda-7r", "stanford-6"})


@lru_cache
def robot(stem: str) -> Robot:
    return dynsolve.load(stem).robot


@lru_cache
def values(stem: str) -> Derivation:
    return derive(robot(stem))


@pytest.mark.parametrize("stem", sorted(STEMS))
def test_every_rule_gives_a_quantity_and_in_this_order(stem: str) -> None:
    rules = [rule.name for rule in course_rules(robot(stem))]
    found = [q.rule for q in quantities(robot(stem)).values() if not q.is_read_off]
    assert [rule for rule in found if rule in rules] == rules
    if robot(stem).bodies:
        rotors = {"Dm"} if robot(stem).actions.rotors else set()
        assert set(found) - set(rules) == {"D_direct", "DH"} | rotors


@pytest.mark.parametrize("stem", SMALL)
def test_shapes_are_those_of_the_derivation(stem: str) -> None:
    known = values(stem)
    for quantity in quantities(robot(stem)).values():
        if quantity.rule not in known or quantity.family is families.CHRISTOFFEL:
            continue
        if "any" in (quantity.family.shape or ()):  # it is known when it is computed
            continue
        value = known[quantity.rule]
        if quantity.is_read_off:
            value = value[quantity.entry]
        assert (value.shape if isinstance(value, Matrix) else None) == quantity.shape, quantity.name


@pytest.mark.parametrize("stem", SMALL)
def test_dimensions_are_those_of_the_derivation(stem: str) -> None:
    dimensions = Dimensions(robot(stem).ring, robot(stem))
    for quantity in quantities(robot(stem)).values():
        if quantity.rule not in values(stem) or quantity.family.dimension is None:
            continue
        value = values(stem)[quantity.rule]
        rows = value.rows if isinstance(value, Matrix) else ((value,),)
        for i, row in enumerate(rows):
            for j, entry in enumerate(row):
                wanted = quantities(robot(stem)).dimension(quantity, i, j)
                assert wanted is not None and dimensions.fits(entry, wanted), (quantity.name, i, j)


def test_every_answer_is_called_something() -> None:
    assert [family.name for family in FAMILIES if family.is_answer and not family.called] == []
    assert [family.name for family in FAMILIES if family.called.count("{}") > 1] == []


@pytest.mark.parametrize("stem", SMALL)
def test_every_answer_has_a_letter(stem: str) -> None:
    for quantity in quantities(robot(stem)).answers():
        assert to_unicode(quantity.letter(robot(stem)), PLAIN)


@pytest.mark.parametrize(
    "stem", [*SMALL, "inf3480-painting-rrp", "planar-3r-redundant", "knife-edge", "crane"]
)
def test_what_is_printed_for_an_answer_is_read_as_that_answer(stem: str) -> None:
    """So a student may write what the sheet asks for in its own letters."""
    reader, missed = FileReader(dynsolve.load(stem)), []
    for quantity in quantities(robot(stem)).answers():
        is_of_bodies = quantity.family is families.CQD and not robot(stem).has_dynamics
        if quantity.family.kind is Kind.VALUE and not is_of_bodies:
            text = f"$$ {to_latex(quantity.letter(robot(stem)))} = {_numbers(quantity, robot(stem).n)} $$"
            answers = reader(text, "a.md").answers
            if quantity.name not in {name for one in answers for name in (one.name, *one.alternatives)}:
                missed.append(text)
    assert missed == []


def _numbers(quantity: Quantity, n: int) -> str:
    """A value of the shape of a quantity, in LaTeX."""
    if not quantity.shape:
        return "7771"
    rows, columns = (size if isinstance(size, int) else n for size in quantity.shape)
    row = " & ".join(["7771"] * columns)
    return r"\begin{bmatrix} " + r" \\ ".join([row] * rows) + r" \end{bmatrix}"


SHARED = [
    (families.C, families.CQD),  # C, for the matrix and for the vector
    (families.P, families.CQD),  # V, of the potential energy and of Craig's vector
    (families.H, families.K_BODY),  # T1, a transformation and a kinetic energy
    (families.I_BODY, families.I),  # I1, along the axes of the body and of the base
]
"""Families with spellings that students use for both."""


@pytest.mark.parametrize("stem", sorted(STEMS))
def test_spellings_are_shared_knowingly(stem: str) -> None:
    known = quantities(robot(stem))
    for spelling, names in known.spellings.items():
        places = [known.position(name) for name in names]
        assert places == sorted(places)
        if len(names) > 1:
            assert tuple(known[name].family for name in names) in SHARED, (spelling, names)
        assert len({known[name].index for name in names}) == 1 or names[0][0] == "H"


def test_no_two_families_have_one_name() -> None:
    assert len({family.name for family in FAMILIES}) == len(FAMILIES)
