"""The records of quantities say what the derivation gives, for every robot of the library."""

from __future__ import annotations

from functools import lru_cache

import pytest

import dynsolve
from dynsolve.algebra.matrix import Matrix
from dynsolve.derivation.graph import Derivation
from dynsolve.derivation.rules import course_rules, derive
from dynsolve.notation.printing import PLAIN
from dynsolve.notation.unicode import to_unicode
from dynsolve.quantities import families
from dynsolve.quantities.families import FAMILIES
from dynsolve.quantities.index import Owners, Quantities, quantities
from dynsolve.quantities.stages import Stage
from dynsolve.robot.dimensions import Dimensions
from dynsolve.robot.model import Coordinate, JointType, Robot
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
        rotors = {"Dm"} if robot(stem).actions.motors else set()
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


@pytest.mark.parametrize("stem", sorted(STEMS))
def test_names_are_their_own_canonical_form(stem: str) -> None:
    known = quantities(robot(stem))
    for name, quantity in known.items():
        assert known.canonical(name) == (name if quantity.family.is_answer else None)
        assert known.stage(name) in Stage
        assert known.of_rule(quantity.rule) is quantity or quantity.is_read_off


@pytest.mark.parametrize("stem", SMALL)
def test_every_answer_has_a_letter(stem: str) -> None:
    for quantity in quantities(robot(stem)).answers():
        assert to_unicode(quantity.letter(robot(stem)), PLAIN)


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


@pytest.mark.parametrize("stem", sorted(STEMS))
def test_parts_and_wholes(stem: str) -> None:
    known, n = quantities(robot(stem)), robot(stem).n
    points = {body.name for body in robot(stem).bodies if body.is_point}
    for name, quantity in known.items():
        for part in known.parts(name):
            assert known[part].whole == name
        if quantity.whole and quantity.family.is_answer:
            family, owner = quantity.family, quantity.index[:1]
            is_empty = family.needs_rotation and robot(stem).bodies[owner[0] - 1].name in points
            assert is_empty or family is families.C_SYMBOL or name in known.parts(quantity.whole)
    assert len(known.parts("D")) == len(known.parts("C")) == n * n
    assert known.parts("J") == ("Jv", "Jw") and len(known.parts("tau")) == len(known.parts("g")) == n


def _named(*bodies: str, points: str = "") -> Quantities:
    theta, d = Coordinate("theta1", JointType.REVOLUTE, 1), Coordinate("L2", JointType.PRISMATIC, 2)
    return Quantities(Owners(3, (theta, d), bodies, frozenset(points.split())))


@pytest.mark.parametrize(
    ("asked", "name"),
    [("M", "D"), ("B", "D"), ("G", "g"), ("c", "Cqd"), ("V", "Cqd"), ("tau2", "f2"), ("f1", "tau1"),
     ("phi2", "g2"), ("m12", "d12"), ("B21", "d21"), ("c12", "C12"), ("C121", "c121"), (" D ", "D"),
     ("tau3", None), ("A4", None), ("d13", None), ("R1", None), ("christoffel", None), ("T1", None)],
)  # fmt: skip
def test_what_find_and_marks_may_call_an_answer(asked: str, name: str | None) -> None:
    assert _named("1").canonical(asked) == name


def test_a_body_may_have_any_name() -> None:
    known = _named("p", "d1", "2", points="p")
    assert known.stage("Kp") is known.stage("Pd1") is known.stage("Kv2") is Stage.ENERGY
    assert known["Kvd1"].family is families.KV and known["Kd1"].index == (2,)
    assert known.parts("Kp") == ("Kvp",) and known.parts("K2") == ("Kv2", "Kw2")
    assert known.spellings["Tp"] == ("Kp",) and known.open_spellings["Kd#"] == ("Kd1",)


def test_entries_have_a_place_in_their_whole() -> None:
    known = _named("1")
    assert known.entry_of("d21") == ("D", (1, 0)) and known.entry_of("g2") == ("g", (1, 0))
    assert known.entry_of("f2") == ("tau", (1, 0)) and known.entry_of("K1") == ("", ())
    assert known["c211"].entry == (0, 1, 0)  # the symbols are kept for i ≤ j
    assert known.mirrored("d21") == "d12" and known.mirrored("C21") == "C21"


def test_a_coordinate_is_called_by_its_subscript_where_that_is_free() -> None:
    known = Quantities(Owners(1, (Coordinate("theta2", JointType.REVOLUTE, 1),), ()))
    assert known.spellings["tau2"] == known.spellings["f2"] == ("tau1",)
    assert known.spellings["tautheta2"] == ("tau1",) and known.spellings["dLdtheta2dot"] == ("dLdqd1",)


def test_no_two_families_have_one_name() -> None:
    assert len({family.name for family in FAMILIES}) == len(FAMILIES)
