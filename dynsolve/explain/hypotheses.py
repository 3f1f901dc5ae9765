"""What an exercise takes for granted and its solution rests on: its joints, gravity, friction, values.

A drawing or the text of an exercise says it; here it is said in the words of the problem file.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import chain

from dynsolve.document import Prose
from dynsolve.explain.forms import Forms
from dynsolve.explain.given_actions import of_actions
from dynsolve.explain.potential import leads_with_minus
from dynsolve.explain.roles import roles
from dynsolve.explain.writing import listed, measured
from dynsolve.notation.tree import Letter, Negative, Node, Number, Symbol, Words, equation
from dynsolve.quantities import letters
from dynsolve.robot import units
from dynsolve.robot.model import JointType, Robot

_KINDS = {JointType.REVOLUTE: "revolute", JointType.PRISMATIC: "prismatic"}

# -- the joints ------------------------------------------------------------------------------------


def joints(robot: Robot) -> str:
    """with revolute joints; with a revolute and a prismatic joint; nothing of a table without joints."""
    types = [joint.type for joint in robot.joints if joint.type]
    found = [word for kind, word in _KINDS.items() if kind in types]
    if len(types) == len(found):
        return f" with {' and '.join(f'a {word}' for word in found)} joint" if found else ""
    return f" with {' and '.join(found)} joints"


# -- the base --------------------------------------------------------------------------------------


def of_base(forms: Forms) -> Prose:
    """Frame 0 is moved by h₀ along 𝐳_w and turned by 30° about 𝐱_w; nothing where it is the world."""
    robot = forms.robot
    if not letters.has_base(robot):
        return ()
    moves = zip("xyz", robot.base_position.entries, strict=True)
    told: list[tuple[str, Prose]] = [
        ("moved ", ("by ", measured(forms.of(far), "m"), " along ", _of_world(axis)))
        for axis, far in moves
        if not far.is_zero
    ]
    told += [("turned ", ("by ", angle, " about ", _of_world(axis))) for axis, angle in robot.base_turns]
    turned = robot.base_rotation != robot.base_rotation.identity(robot.ring, 3)
    if len(told) > 2 or (turned and not robot.base_turns):
        return ("How frame 0 is placed in the world is given (1.2). ",)
    (first, how), *others = told
    rest: Prose = ()
    for verb, by in others:
        rest += (" and ", *((verb,) if verb != first else ()), *by)
    return ("Frame 0 is ", first, *how, *rest, " in the world w. ")


def _of_world(axis: str) -> Node:
    """𝐳_w"""
    return letters.bold(axis, Words("w"))


# -- what acts -------------------------------------------------------------------------------------


def of_forces(forms: Forms) -> Prose:
    """Gravity g acts along -𝐲₀, and there is no friction; what else the problem gives."""
    told = _gravity(forms)
    if "friction" not in forms.robot.actions.kinds:
        told += (" and no friction." if forms.robot.gravity.is_zero else "; there is no friction.",)
    else:
        told += (".",)
    return tuple(chain(told, *((" ", *each) for each in of_actions(forms))))


def _gravity(forms: Forms) -> Prose:
    robot = forms.robot
    entries = zip("xyz", robot.gravity.entries, strict=True)
    along = [(axis, entry) for axis, entry in entries if not entry.is_zero]
    if not along:
        return ("There is no gravity",)
    if len(along) > 1:
        return (letters.GRAVITY, ", the acceleration of gravity, is along no axis of ", _ground(robot))
    ((axis, entry),) = along
    opposite = leads_with_minus(entry)
    size = -entry if opposite else entry
    unit = _of_world(axis) if letters.has_base(robot) else Letter(axis, Number(0), style="bold")
    named: Prose = (", ", measured(forms.of(size), "m/s²"), ",") if size.is_number else (" ", forms.of(size))
    return ("Gravity", *named, " acts along ", Negative(unit) if opposite else unit)


def _ground(robot: Robot) -> str:
    return "the world" if letters.has_base(robot) else "frame 0"


# -- numbers ---------------------------------------------------------------------------------------


def of_values(robot: Robot, written: Mapping[str, str], own_units: Mapping[str, str]) -> Prose:
    """In numbers: a₂ = 0.4318 m; nothing where the problem has no values."""
    known = {name: unit for name, (_, unit) in roles(robot).items()}
    given: list[Prose] = []
    for name, text in written.items():
        unit = own_units.get(name, known.get(name, ""))
        value = text.replace(" deg", "°").replace("deg", "°")
        measured = (" ", units.node(unit)) if unit and not value.endswith("°") else ()
        given.append((equation(Symbol(name), Words(value)), *measured))
    return (" In numbers: ", *listed(given), ".") if given else ()
