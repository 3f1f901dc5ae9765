"""The printed sign of everything in a report, so that none stands for two things.

The names of the problem are kept as they are, and so are the shorthands s_1 and c_12.  A letter of the
textbook that would look like one of them is set otherwise:

- a scalar in another letter, the energy P_1 beside a length P_1 as U_1 (`ALTERNATIVES`), and the entry
  c_12 of C as C_12 wherever c_1 is a cosine: it would be read as cos(θ_1 + θ_2);
- a vector or a matrix is bold, on paper and in a terminal: the axis **z**_1 beside the coordinate z_1 of a
  mass centre, the term **g** beside the number g.

To give a letter another one, add it to `ALTERNATIVES`.  The choices are told in the list of notation
(`explain.notation_list`).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from itertools import chain, combinations, product

from dynsolve.explain.forms import parallel_coordinates
from dynsolve.explain.style import shown_digits, style_of
from dynsolve.notation.printing import Sign, Style, shorthand
from dynsolve.notation.tree import Function, Node, Sum, Symbol
from dynsolve.notation.unicode import UnicodePrinter
from dynsolve.notation.walk import walk
from dynsolve.quantities import letters
from dynsolve.robot.model import Robot

ALTERNATIVES: dict[tuple[str, int], str] = {
    ("c", 2): "C",
    ("c", 3): "Gamma",
    ("d", 2): "D",
    ("g", 1): "phi",
    ("P", 1): "U",
    ("K", 1): "T",
    ("tau", 1): "u",
    ("f", 1): "F",
}
"""Base and number of lower indices of a scalar of the textbook -> the letter that stands in for it."""


CONSTANTS_OF_SOLUTIONS = "ABDXY"
"""What a solution of inverse kinematics calls what stands beside its sines and cosines."""


MORE_DIGITS = 2
"""So many digits more than the longest number of the problem are shown: sums of what is printed add up."""


def report_style(robot: Robot, digits: int | None = None) -> Style:
    """The style of a report on a robot, in which every sign has one meaning.

    A model in numbers is shown with `digits` significant digits; without these, with a few more than the
    longest number of the problem has, so that a reader can follow each line from the one before it.
    """
    style = _with_free_shorthands(robot, style_of(robot))
    taken = frozenset(_own(robot, style))
    found: dict[Sign, str] = {}
    for (base, count), other in ALTERNATIVES.items():
        read_as_cosine = (base, count) == ("c", 2) and style.shorthand
        if read_as_cosine or not taken.isdisjoint(_printed(_scalars(robot, base, count))):
            found[base, "italic", count] = other
    decimal = style.decimal or digits is not None
    shown = (digits or shown_digits(robot) + MORE_DIGITS) if decimal else 0
    return replace(style, letters=found, bold=True, decimal=decimal, digits=shown)


def _printed(nodes: Iterable[Node]) -> Iterator[str]:
    return map(UnicodePrinter().text, nodes)


# -- what keeps its sign ---------------------------------------------------------------------------


def _with_free_shorthands(robot: Robot, style: Style) -> Style:
    """The style without the shorthands that look like a name of the problem: c_12 where that is a length."""
    names = set(_printed(map(Symbol, _names(robot))))
    write = UnicodePrinter(style).text
    clashing = [node for node in shorthands(robot, style) if write(node) in names]
    given_up = {part.name for node in clashing for part in walk(node) if isinstance(part, Symbol)}
    kept = {name: index for name, index in style.shorthand.items() if name not in given_up}
    return replace(style, shorthand=kept)


def _names(robot: Robot) -> list[str]:
    return [*robot.parameters, *(q.name for q in robot.coordinates)]


def _own(robot: Robot, style: Style) -> Iterator[str]:
    """The names of the problem and the shorthands, as a terminal prints them."""
    yield from _printed(map(Symbol, (*_names(robot), *robot.questions.reached)))
    yield from map(UnicodePrinter(style).text, shorthands(robot, style))


def shorthands(robot: Robot, style: Style) -> Iterator[Function]:
    """What the style writes as s_1 and c_12: sines and cosines of angles, and of sums in parallel joints."""
    for group in parallel_coordinates(robot):
        members = [Symbol(q.name) for q in robot.coordinates if q.name in group]
        sizes = range(1, len(members) + 1)
        for chosen in chain.from_iterable(combinations(members, size) for size in sizes):
            angle: Node = chosen[0] if len(chosen) == 1 else Sum(chosen)
            for name in ("sin", "cos"):
                if shorthand(node := Function(name, angle), style):
                    yield node


# -- what may give way -----------------------------------------------------------------------------


def _scalars(robot: Robot, base: str, count: int) -> Iterator[Node]:
    """The scalars of the textbook with a letter: energies of the bodies, entries by coordinates."""
    if base in ("P", "K"):
        yield from (letters.of_body(base, body) for body in robot.bodies)
        return
    places = range(1, robot.n + 1)
    for indices in product(places, repeat=count):
        yield letters.entry(base, *indices)
