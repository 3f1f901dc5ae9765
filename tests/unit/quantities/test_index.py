"""The quantities of one robot: by their names, and as parts of wholes."""

from __future__ import annotations

from functools import lru_cache

import pytest

import dynsolve
from dynsolve.quantities import families
from dynsolve.quantities.index import Quantities, quantities
from dynsolve.quantities.owners import Owners
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Coordinate, JointType, Robot
from tests.support import STEMS


@lru_cache
def robot(stem: str) -> Robot:
    return dynsolve.load(stem).robot


@pytest.mark.parametrize("stem", sorted(STEMS))
def test_names_are_their_own_canonical_form(stem: str) -> None:
    known = quantities(robot(stem))
    for name, quantity in known.items():
        assert known.canonical(name) == (name if quantity.family.is_answer else None)
        assert known.stage(name) in Stage
        assert known.of_rule(quantity.rule) is quantity or quantity.is_read_off


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
