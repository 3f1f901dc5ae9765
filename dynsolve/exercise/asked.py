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
from dynsolve.explain.given import in_words
from dynsolve.notation.text import read
from dynsolve.problem.model import Problem
from dynsolve.quantities.index import quantities


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
            yield Part(("Find ", *in_words(problem.robot, [known[name] for name in own]), "."), own, points)


def worded(text: str) -> Prose:
    """An author's words, formulas between dollar signs.

    >>> worded("Show that $m1*g$ is a weight.")[::2]
    ('Show that ', ' is a weight.')
    """
    pieces: list[Inline] = [read(piece).tree if k % 2 else piece for k, piece in enumerate(text.split("$"))]
    return tuple(piece for piece in pieces if piece != "")
