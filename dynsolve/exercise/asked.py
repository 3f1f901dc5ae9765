"""What an exercise asks for, part by part: words, letters and points.

A part is an answer with marks, or the members of one family together: (b) the matrices 𝐀₁ and 𝐀₂ of the
rows of the table (3 points).
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from itertools import groupby

from msgspec import Struct

from dynsolve.document import Inline, Prose
from dynsolve.explain.given import CALLED
from dynsolve.explain.writing import agreeing, listed
from dynsolve.notation.text import read
from dynsolve.notation.tree import Node
from dynsolve.problem.model import Problem
from dynsolve.quantities.family import Kind
from dynsolve.quantities.index import Quantity, quantities

MEMBERS = {
    "A": "the matrix|matrices {} of the row|rows of the table",
    "H": "the matrix|matrices {} of the forward kinematics, seen from the base",
    "Jv": "the linear part {} of the Jacobian|Jacobians",
    "Jw": "the angular part {} of the Jacobian|Jacobians",
    "p": "the position|positions {} of the named point|points",
    "v": "the velocity|velocities {}",
    "w": "the angular velocity|velocities {}",
    "Jv_dot": "the time derivative {} of the linear part of the Jacobian",
    "Jw_dot": "the time derivative {} of the angular part of the Jacobian",
    "J_dot": "the time derivative {} of the Jacobian",
    "Jr_dot": "the time derivative {} of the Jacobian of the task",
    "nullspace": "the null space {} of the Jacobian",
    "rangespace": "the range space {} of the Jacobian",
    "lost": "the directions {} that are lost",
    "rc": "the position|positions {} of the mass centre|centres",
    "I_body": "the inertia tensor|tensors {} along the axes of the body|bodies",
    "I": "the inertia tensor|tensors {} along the axes of the base",
    "P": "the potential energy|energies {}",
    "K": "the kinetic energy|energies {}",
    "Kv": "the kinetic energy|energies {} of translation",
    "Kw": "the kinetic energy|energies {} of rotation",
    "dLdqd": "the derivative|derivatives {} of the Lagrangian",
    "ddt": "the derivative|derivatives {} with respect to time",
    "dLdq": "the derivative|derivatives {} of the Lagrangian",
    "": "the generalized force|forces {}",
    "d": "the entry|entries {} of the inertia matrix",
    "c": "the Christoffel symbol|symbols {}",
    "C": "the entry|entries {} of the matrix of Coriolis and centrifugal terms",
    "g": "the entry|entries {} of the gravity terms",
    "friction": "the entry|entries {} of the friction",
    "Cqd": "the vector {} of Coriolis and centrifugal terms",
    "wl": "the angular velocity|velocities {} of the link|links",
    "wdl": "the angular acceleration|accelerations {} of the link|links",
    "al": "the acceleration|accelerations {} of the origin|origins of the frame|frames",
    "acl": "the acceleration|accelerations {} of the mass centre|centres",
    "fl": "the force|forces {} of the recursion",
    "nl": "the moment|moments {} of the recursion",
    "aM": "the parameters {} of the inertia terms",
    "YM": "the regressor {} of the inertia terms",
    "ag": "the parameters {} of the gravity terms",
    "Yg": "the regressor {} of the gravity terms",
    "Yr": "the regressor {} with reference rates and accelerations",
    "linear_A": "the matrix {} of the state, near the equilibrium",
    "linear_B": "the matrix {} of the inputs, near the equilibrium",
    "qdd_forward": "the accelerations {} as functions of the forces",
    "Q": "the generalized forces {} of what acts from outside",
    "tau_static": "the forces and torques {} that hold the arm at rest",
    "lambda": "the multiplier|multipliers {}",
    "r": "the component|components {} of the task",
}
"""What answers are called that `CALLED` does not name, or that are members of a family."""


class Part(Struct, frozen=True):
    """One thing that is asked for: its words, the answers that give it, and its points."""

    words: Prose
    names: tuple[str, ...]
    points: Fraction


def parts(problem: Problem, marks: dict[str, Fraction]) -> Iterator[Part]:
    """What a problem asks for, with these marks: first what `find` names, in its order, then what marks add.

    >>> from dynsolve.solution.solution import load
    >>> problem = load("planar-2r")
    >>> [(part.words[1], part.names) for part in parts(problem, {})][:2]
    [('the inertia matrix ', ('D',)), ('the matrix of Coriolis and centrifugal terms ', ('C',))]
    """
    known = quantities(problem.robot)
    names = [*dict.fromkeys((*problem.find, *marks))]
    own_words = problem.text.asked if problem.text else {}

    def alike(name: str) -> str:
        return name if name in own_words else known[name].family.name

    for _, members in groupby(names, alike):
        own = tuple(members)
        points = sum((marks.get(name, Fraction(0)) for name in own), Fraction(0))
        if own[0] in own_words:
            yield Part(worded(own_words[own[0]]), own, points)
        else:
            yield Part(("Find ", *_words(problem, [known[name] for name in own]), "."), own, points)


def worded(text: str) -> Prose:
    """An author's words, formulas between dollar signs.

    >>> worded("Show that $m1*g$ is a weight.")[::2]
    ('Show that ', ' is a weight.')
    """
    pieces: list[Inline] = [read(piece).tree if k % 2 else piece for k, piece in enumerate(text.split("$"))]
    return tuple(piece for piece in pieces if piece != "")


def _words(problem: Problem, own: list[Quantity]) -> Prose:
    """the matrices 𝐀₁ and 𝐀₂ of the rows of the table"""
    first = own[0]
    if first.family.kind is Kind.VERDICTS:
        return ("which of the matrices can be inertia matrices",)
    letters = [quantity.letter(problem.robot) for quantity in own if quantity.family.has_letter]
    if not first.index and first.name in CALLED:
        has_letter = letters and first.name != "DH"
        return (f"{CALLED[first.name]} ", letters[0]) if has_letter else (CALLED[first.name],)
    return _filled(agreeing(MEMBERS[first.family.stem], len(own)), letters)


def _filled(text: str, letters: list[Node]) -> Prose:
    before, _, after = text.partition("{}")
    return (before, *listed(letters), after) if letters else (" ".join(f"{before}{after}".split()),)
