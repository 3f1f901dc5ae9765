"""What acts beside gravity: what becomes of the keys that say it, and every fault with its remedy."""

from __future__ import annotations

import pytest

from dynsolve.algebra.angles import Angle
from dynsolve.problem import read_problem
from tests.unit.problem.marked import errors, places, unmarked

ARM = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]
"""


def robot(text: str):
    return read_problem(ARM + text).robot


def test_a_file_without_them_has_a_robot_on_which_nothing_acts() -> None:
    assert not robot("").actions


def test_a_bare_value_is_viscous_friction() -> None:
    found = robot("friction: {q1: f, q2: {viscous: f, coulomb: c}}")
    first, second = found.actions.acts
    f, c = found.ring.symbol("f"), found.ring.symbol("c")
    assert (first.coordinate, first.viscous, first.coulomb.is_zero) == (0, f, True)
    assert (second.coordinate, second.viscous, second.coulomb) == (1, f, c)


def test_a_spring_is_half_its_stiffness_times_the_square_of_its_stretch() -> None:
    found = robot("springs: [{stiffness: k, of: q2 - q1, rest: delta}, {energy: h*(1 - cos(q1))}]")
    first, second = found.actions.acts
    ring = found.ring
    stretch = ring.symbol("q2") - ring.symbol("q1") - ring.symbol("delta")
    assert first.energy * 2 == ring.symbol("k") * stretch * stretch
    assert second.energy == ring.symbol("h") * (ring.one - ring.cos(Angle.of("q1"))) and second.along is None


def test_a_starred_motor_brings_a_coordinate_after_those_of_the_table() -> None:
    found = robot(
        "motors: [{turns: q3*, inertia: J}, {turns: q1, inertia: I, ratio: n, carrier: 2, axis: x}]"
    )
    assert [(q.name, q.type.value) for q in found.coordinates] == [
        ("q1", "revolute"), ("q2", "revolute"), ("q3", "revolute"),
    ]  # fmt: skip
    elastic, carried = found.actions.acts
    assert (elastic.turns, elastic.carrier, elastic.ratio) == (2, 0, found.ring.one)
    assert (carried.turns, carried.carrier, carried.axis) == (0, 2, 0)


def test_coordinates_orders_those_of_motors_too() -> None:
    found = robot("coordinates: [q3, q1, q2]\nmotors: [{turns: q3*, inertia: J}]\npassive: [q1]")
    assert ([q.name for q in found.coordinates], found.actions.passive) == (["q3", "q1", "q2"], (1,))


def test_a_mechanism_by_positions_has_them_too() -> None:
    text = "model: {coordinates: {x: prismatic}, bodies: [{mass: m, at: [x, 0, 0]}]}\n"
    found = read_problem(text + "friction: {x: f}\nsprings: [{stiffness: k, of: x}]").robot
    assert found.actions.terms == {"friction", "Ps"}


FAULTS = {
    "no mapping": ("friction: «[q1]»", "a mapping from coordinates", "friction: {q1: fv1}"),
    "no coordinate": ("friction: {«q3»: f}", "q3 is no coordinate", "friction: {q1"),
    "an empty friction": ("friction: {q1: «{}»}", "is empty", "viscous"),
    "negative friction": ("friction: {q1: «-1»}", "is negative", "are not"),
    "friction of a coordinate": ("friction: {q1: f*«q2»}", "contains the coordinate q2", "a constant"),
    "an unknown key": ("friction: {q1: {«viscos»: f}}", "unknown key", "viscous"),
    "no stiffness": ("springs:\n  - «{of: q1}»", "no `stiffness`", "a spring is written"),
    "no stretch": ("springs:\n  - «{stiffness: k}»", "no `of`", "a spring is written"),
    "two laws": ("springs: [{«stiffness»: k, of: q1, energy: k*q1}]", "an `energy` and a", "give one"),
    "a stretch that is not linear": ("springs: [{stiffness: k, of: «q1^2»}]", "not linear", "`energy`"),
    "a stretch without coordinates": ("springs: [{stiffness: k, of: «L»}]", "no coordinate", "q2 - q1"),
    "a rest in the stretch": ("springs: [{stiffness: k, of: «q1 - L»}]", "without coordinates", "`rest`"),
    "an energy of nothing": ("springs: [{energy: «k»}]", "no coordinate", "function of them"),
    "a high energy": ("springs: [{energy: «k*q1^9»}]", "of degree 9", "lower degree"),
    "no damping": ("dampers:\n  - «{of: q1}»", "no `damping`", "add damping"),
    "no inertia": ("motors:\n  - «{turns: q1}»", "no `inertia`", "inertia"),
    "no link": ("motors: [{turns: q1, inertia: J, carrier: «3»}]", "there is no link 3", "from 1 to 2"),
    "the ground": ("motors: [{turns: q1, inertia: J, carrier: «0»}]", "link 0 is the ground", "from 1"),
    "an axis of nothing": ("motors: [{turns: q1, inertia: J, «axis»: x}]", "there is none", "carrier: 1"),
    "an odd axis": (
        "motors: [{turns: q1, inertia: J, carrier: 1, axis: «w»}]",
        "one of x, y, z",
        "write one",
    ),
    "no ratio": ("motors: [{turns: q1, inertia: J, ratio: «0»}]", "is not 0", "ratio: kr1"),
    "a motor of nothing": ("motors: [{turns: «q3», inertia: J}]", "q3 is no coordinate", "turns: thm1*"),
    "a motor of a difference": (
        "motors: [{turns: «q2 - q1», inertia: J}]",
        "one coordinate is wanted here, and `q2 - q1` is an expression",
        "turns: thm1*",
    ),
    "a passive name": ("passive: [«q3»]", "q3 is no coordinate", "passive: [q2]"),
    "sgn": ("springs: [{energy: k*«sgn»(q1)}]", "unknown function", ""),
    "friction that is asked for": ("find: [«friction»]", "no answer of this problem", ""),
}


@pytest.mark.parametrize(("marked", "message", "help"), FAULTS.values(), ids=FAULTS)
def test_faults(marked: str, message: str, help: str) -> None:
    text, underlined = unmarked(ARM + marked)
    found = errors(text)
    assert places(found) == underlined
    assert message in found[0].message and help in found[0].help


@pytest.mark.parametrize(
    ("marked", "message"),
    [
        ("dh: [{theta: q1*}]\n«friction»: {q1: f}", "nothing has mass"),
        ("dh: [{theta: q1*}]\nmasses: [{mass: m, name: s, link: 1}]\n«springs»: [{energy: k*q1^2}]", "P_s"),
        (
            "dh: [{theta: q1*}]\nmasses: [{mass: m, name: m, link: 1}]\n«motors»: [{turns: q1, inertia: J}]",
            "K_m",
        ),
    ],
)
def test_what_must_be_there_beside_them(marked: str, message: str) -> None:
    text, underlined = unmarked(marked)
    found = errors(text)
    assert places(found) == underlined
    assert message in found[0].message


def test_of_each_there_are_at_most_twenty() -> None:
    (found,) = errors(ARM + f"dampers: [{', '.join(['{damping: b, of: q1}'] * 21)}]")
    assert "21 dampers; at most 20 are read" in found.message
