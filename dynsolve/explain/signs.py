"""The printed sign of everything in a report, so that none stands for two things.

The names of the problem are kept as they are, and so are the shorthands s_1 and c_12.  A letter of the
textbook that would look like one of them is set otherwise:

- a scalar in another letter, the entry c_12 of C beside c_12 = cos(θ_1 + θ_2) as C_12 (`ALTERNATIVES`);
- a vector or a matrix is bold, on paper always, and in a terminal where it has to be seen: the axis **z**_1
  beside the coordinate z_1 of a mass centre, the term **g** beside the number g.

To give a letter another one, add it to `ALTERNATIVES`.  The choices are told in the list of notation
(`explain.notation_list`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from itertools import chain, combinations, product

from dynsolve.explain.forms import parallel_coordinates
from dynsolve.explain.style import shown_digits, style_of
from dynsolve.notation.printing import Sign, Style, shorthand
from dynsolve.notation.tree import Function, Letter, Node, Number, Sum, Symbol
from dynsolve.notation.unicode import UnicodePrinter
from dynsolve.notation.walk import walk
from dynsolve.quantities import letters
from dynsolve.quantities.robot_stages import stages_of
from dynsolve.quantities.stages import Stage
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


def report_style(robot: Robot, digits: int | None = None) -> Style:
    """The style of a report on a robot, in which every sign has one meaning.

    A model in numbers is shown with `digits` significant digits, or as many as its longest number has.
    """
    style = _with_free_shorthands(robot, style_of(robot))
    taken = frozenset(_own(robot, style))
    found: dict[Sign, str] = {}
    for (base, count), other in ALTERNATIVES.items():
        if not taken.isdisjoint(_printed(_scalars(robot, base, count))):
            found[base, "italic", count] = other
    bold = frozenset(letter.base for letter in _vectors(robot) if not taken.isdisjoint(_printed([letter])))
    decimal = style.decimal or digits is not None
    shown = (digits or shown_digits(robot)) if decimal else 0
    return replace(style, letters=found, bold=bold, decimal=decimal, digits=shown)


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
    names = _names(robot)
    if not robot.gravity.is_zero:
        names.append("g")  # the formula of the potential energy has it, though gravity may be a number here
    for body in robot.bodies:
        if body.shape is not None and body.shape.formulas:
            names += (letter for letter, _ in body.shape.letters)  # those of the formulas of its moments
    names += robot.questions.reached
    if Stage.INVERSE in stages_of(robot):
        names += CONSTANTS_OF_SOLUTIONS
    if Stage.PARAMETERS in stages_of(robot):
        names.append("a")  # a column of the table, beside the column of the parameters
    yield from _printed(map(Symbol, names))
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


def _vectors(robot: Robot) -> Iterator[Letter]:
    """The bold letters of the textbook."""
    yield from (letters.J, letters.Q, letters.D, letters.C, letters.G, letters.GRAVITY, letters.TAU)
    yield from (letters.PARAMETERS, letters.REGRESSOR)
    yield from map(letters.bold, ("A", "N", "E", "U", "r", "v", "omega", "x", "z", "o"))
    numbered: tuple[Callable[[int], Letter], ...] = (letters.A, letters.z, letters.o, _bold("x"), _bold("J"))
    frames = [letter(i) for letter in numbered for i in range(len(robot.joints) + 1)]
    yield from frames
    yield from (letters.bold(base, Number(joint.index)) for joint in robot.joints for base in ("H", "R"))
    for body in robot.bodies:
        yield letters.rc(body)
        yield letters.tensor(robot, body)
        yield from (letters.of_body(base, body, "bold") for base in ("R", "v", "omega"))


def _bold(base: str) -> Callable[[int], Letter]:
    return lambda i: letters.bold(base, Number(i))
