"""What an exercise asks for, part by part: words, letters and points.

A part is an answer with marks, or the members of one family together: (b) the matrices 𝐀₁ and 𝐀₂ of the
rows of the table (3 points).  What a sign or an order is counted by is told, where books differ in it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from fractions import Fraction
from functools import partial
from itertools import groupby

from msgspec import Struct

from dynsolve.document import Inline, Prose
from dynsolve.explain.given import in_words
from dynsolve.notation.text import read
from dynsolve.notation.tree import Node, Product, Sum, Symbol, Transpose
from dynsolve.problem.model import Problem
from dynsolve.quantities import letters
from dynsolve.quantities.family import Family
from dynsolve.quantities.index import quantities
from dynsolve.questions.constraints import MULTIPLIERS
from dynsolve.questions.equilibria import LINEAR_A, LINEAR_B
from dynsolve.questions.rates import QD, QDD
from dynsolve.robot.model import Robot


class Part(Struct, frozen=True):
    """One thing that is asked for: its words, the answers that give it, and its points.

    `convention` is a sentence on what its answer is counted by, empty where there is no choice.
    """

    words: Prose
    names: tuple[str, ...]
    points: Fraction
    convention: Prose = ()


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
            asked = [known[name] for name in own]
            convention = CONVENTIONS.get(asked[0].family)
            told = convention(problem.robot) if convention else ()
            yield Part(("Find ", *in_words(problem.robot, asked), "."), own, points, told)


def worded(text: str) -> Prose:
    """An author's words, formulas between dollar signs.

    >>> worded("Show that $m1*g$ is a weight.")[::2]
    ('Show that ', ' is a weight.')
    """
    pieces: list[Inline] = [read(piece).tree if k % 2 else piece for k, piece in enumerate(text.split("$"))]
    return tuple(piece for piece in pieces if piece != "")


# -- conventions, told behind what is asked --------------------------------------------------------


def _multipliers(robot: Robot) -> Prose:
    """D q̈ + C q̇ + g = τ + A_cᵀ λ"""
    moved = Sum((Product((letters.D, letters.QDD)), Product((letters.C, letters.QD)), letters.G))
    held = Sum((letters.TAU, Product((Transpose(letters.A_C), letters.LAMBDA))))
    return ("Their sign is such that ", moved, " equals ", held, ".")


def _state(robot: Robot) -> Prose:
    """(q, q̇), as A and B have it."""
    states = [Symbol(q.name, dots) for dots in (0, 1) for q in robot.coordinates]
    listed = [part for state in states for part in (", ", state)][1:]
    return ("The state is in the order (", *listed, ").")


def _least(x: Node, robot: Robot) -> Prose:
    """Of many solutions the one with the least xᵀ W x, where weights are given."""
    weighted = robot.questions.weights is not None or robot.questions.weighs_by_inertia
    W = letters.D if robot.questions.weighs_by_inertia else letters.WEIGHTS
    return ("Of many, take those with the least ", letters.transposed_product(x, W), ".") if weighted else ()


CONVENTIONS: Mapping[Family, Callable[[Robot], Prose]] = {
    **dict.fromkeys(MULTIPLIERS, _multipliers),
    **dict.fromkeys((LINEAR_A, LINEAR_B), _state),
    QD: partial(_least, letters.QD),
    QDD: partial(_least, letters.QDD),
}
"""What is told of a family, by the robot."""
