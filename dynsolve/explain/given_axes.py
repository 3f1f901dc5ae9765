"""Of axes of a body that a problem gives from the base: which frame of the arm they belong to, and how."""

from __future__ import annotations

from collections.abc import Iterator

from dynsolve.algebra.matrix import Matrix
from dynsolve.derivation import inertia
from dynsolve.derivation.kinematics import rotation
from dynsolve.document import Prose
from dynsolve.explain import base_frame
from dynsolve.explain.context import Context
from dynsolve.explain.writing import listed, name_of
from dynsolve.notation.tree import Letter, Node, Product
from dynsolve.quantities import letters
from dynsolve.robot.model import Body


def product(context: Context, body: Body) -> Node | None:
    """The rotation as the problem writes it, behind that of the base where there is one; None of a matrix."""
    robot = context.robot
    base = (letters.R(robot, 0),) if letters.has_base(robot) else ()
    turns = tuple(base_frame.rotation(axis, angle) for axis, angle in body.axes.turns)
    turns = turns or ((context.show(body.axes.rotation),) if base else ())
    factors = (*base, *turns)
    return None if not factors else Product(factors) if len(factors) > 1 else factors[0]


def why(context: Context, body: Body) -> Prose:
    """That the problem gives the axes, and how they lie in the frame of the link."""
    given = f"The problem gives the axes of {name_of(body)} from the base. "
    frame = f"frame {body.link}"
    H = context.values[f"H{body.link}"]
    if not inertia.turns_with_link(context.robot, body, H):
        return (given, f"They do not turn with link {body.link}.")
    relative = rotation(H).T @ inertia.body_rotation(context.robot, body, H)
    if relative == Matrix.identity(relative.ring, 3):
        return (given, f"They are those of {frame}.")
    not_equal: Prose = (letters.of_body("R", body, "bold"), " is not ", letters.R(context.robot, body.link))
    told = list(_parallel(relative, body.link))
    if len(told) < 3:
        return (given, f"They are turned in {frame}, and fixed in the same link: ", *not_equal, ".")
    return (given, f"They are not those of {frame}: ", *listed(told), ", so ", *not_equal, ".")


def _parallel(relative: Matrix, link: int) -> Iterator[Prose]:
    """Of each axis of the frame, the axis of the body that it lies along; none where one is oblique."""
    one = relative.ring.one
    for i, axis in enumerate("xyz"):
        along = [(j, entry) for j, entry in enumerate(relative.rows[i]) if not entry.is_zero]
        if len(along) != 1:
            return
        ((j, entry),) = along
        lies, whose = ("lies along", "the body's") if i == 0 else ("along", "its")
        name = Letter(axis, letters.index_of(str(link)), style="bold")
        yield (name, f" {lies} {whose} {'' if entry == one else '-'}{'xyz'[j]}")
