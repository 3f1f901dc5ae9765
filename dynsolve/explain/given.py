"""What is given, a line for each symbol with its unit, and what is to be found: the exercise."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from dynsolve.algebra.expr import Expr
from dynsolve.document import Block, Inline, List, Prose, Text
from dynsolve.explain.forms import Forms
from dynsolve.explain.given_questions import (
    joints,
    of_actions,
    of_axes,
    of_base,
    of_forces,
    of_model,
    of_questions,
    of_values,
)
from dynsolve.explain.inertia import has_link_axes, is_moved, stays_with_base
from dynsolve.explain.kinematics import turned
from dynsolve.explain.mass_centers import ends, is_given_by, other_end, part_of_the_way
from dynsolve.explain.notation_list import problem_names
from dynsolve.explain.parameter_meanings import DIMENSIONS, SHAPES
from dynsolve.explain.textbook_letters import Line
from dynsolve.explain.writing import listed, machine, measured, name_of, side_by_side
from dynsolve.notation.tree import Letter, Negative, Node, Number, Row, Symbol, Words
from dynsolve.problem.model import Problem
from dynsolve.quantities import letters
from dynsolve.quantities.index import quantities
from dynsolve.robot.model import AxesKind, Body
from dynsolve.robot.shapes import KINDS, Density, Shape
from dynsolve.robot.units import node as unit_node

MOST_BODIES = 4
"""Up to this number of bodies each is named."""

_COUNTS = {2: "two", 3: "three", 4: "four"}

CALLED = {
    "K": "the kinetic energy",
    "P": "the potential energy",
    "L": "the Lagrangian",
    "tau": "the generalized forces",
    "D": "the inertia matrix",
    "C": "the matrix of Coriolis and centrifugal terms",
    "g": "the gravity terms",
    "Ps": "the potential energy of the springs",
    "Km": "the kinetic energy of the rotors",
    "friction": "the friction",
    "DH": "the Denavit-Hartenberg parameters",
    "J": "the Jacobian",
    "r": "the task vector",
    "Jr": "the Jacobian of the task",
    "det": "the determinant",
    "singular": "the singular configurations",
    "inverse": "the inverse kinematics",
    "qd": "the rates of the coordinates",
    "qdd": "the accelerations of the coordinates",
    "Y": "the regressor",
    "a": "the dynamic parameters",
    "equilibria": "the equilibria",
    "balance": "the conditions for balance",
    "Ac": "the matrix of the constraints",
    "Ac_dot": "its rate",
    "lambda": "the multipliers",
    "reduced": "the equations without multipliers",
    "Lambda": "the inertia matrix of the task",
    "definite": "which of the matrices can be inertia matrices",
}
"""What whole answers are called; others are told by their letters."""


def statement(forms: Forms, problem: Problem, sines: Iterable[Line] = ()) -> Iterator[Block]:
    """Given: the arm or the mechanism, what acts on it, what is asked of it; its symbols; To be found."""
    given = [sentence for sentence in _sentences(forms, problem) if sentence]
    if given:
        yield Text(("Given: ", *sentences(given)))
    names = [*map(_introduced, problem_names(forms.robot)), *((line.words,) for line in sines)]
    if names:
        yield List(tuple(names))
    found = [called for name in problem.find if (called := _called(forms, name)) is not None]
    if found:
        yield Text(("To be found: ", *listed(found), "."))


def sentences(parts: Sequence[Prose]) -> Iterator[Inline]:
    """Sentences with a blank between them."""
    for place, sentence in enumerate(parts):
        *before, last = sentence
        yield from (" ", *before) if place else before
        yield last.rstrip() if isinstance(last, str) else last


def _sentences(forms: Forms, problem: Problem) -> Iterator[Prose]:
    """What is given, sentence by sentence."""
    robot = forms.robot
    if problem.normals is not None:
        yield ("the axes of the arm as they are drawn.",)
        yield from of_axes(problem.normals)
    elif robot.has_table:
        yield (*_given(forms), ".")
    else:
        yield from of_model(forms)
    if robot.has_table and 0 < len(robot.bodies) <= MOST_BODIES:
        yield of_tensors(forms)
    yield of_base(forms)
    if robot.has_dynamics and robot.given is None:
        yield of_forces(forms)
    elif robot.has_dynamics:
        yield from of_actions(forms)
    yield from of_questions(forms)
    yield of_values(robot, problem.written, problem.units)


def _introduced(line: Line) -> Prose:
    """l₁, l₂: length of link i (m)"""
    unit: Prose = (" (", unit_node(line.unit), ")") if line.unit else ()
    return (line.sign, f": {line.meaning}", *unit)


def _given(forms: Forms) -> Prose:
    """The table, and what has mass."""
    robot = forms.robot
    what = f"the table of the {machine(robot)}{joints(robot)}"
    if not robot.bodies:
        return (what,)
    if len(robot.bodies) > MOST_BODIES:
        return (f"{what}, and mass, mass centre and inertia tensor of {len(robot.bodies)} rigid bodies",)
    told = [of_body(forms, body) for body in robot.bodies]
    count = "one rigid body" if len(told) == 1 else f"{_COUNTS[len(told)]} rigid bodies"
    parts: Prose = told[0]
    for each in told[1:]:
        parts += ("; ", *each)
    return (f"{what} and {count}: ", *parts)


def _called(forms: Forms, name: str) -> Prose | None:
    """the inertia matrix D; None for what has neither words nor a letter"""
    words = CALLED.get(name, "")
    letter = None if name == "DH" else _letter(forms, name)
    if not words and letter is None:
        return None
    both: list[Node | str] = [words] if words else []
    if letter is not None:
        both += [" ", letter] if words else [letter]
    return tuple(both)


def _letter(forms: Forms, name: str) -> Node | None:
    try:
        return quantities(forms.robot)[name].letter(forms.robot)
    except LookupError:
        return None


# -- what an exercise says of a body: its mass, the dimensions of its shape, its mass centre, its moments
# It is said before the solution, so that the problem can be solved from it alone.

_XYZ = "xyz"


def of_body(forms: Forms, body: Body) -> Prose:
    """body 2 in link 2, a uniform slender rod of mass m₂ and length l₂ along 𝐱₂, its mass centre at 𝐨₁"""
    told: Prose = (f"{name_of(body)} in link {body.link},",)
    if body.density is not None:
        return (*told, *_with_density(forms, body, body.density))
    if body.is_point:
        return (*told, " a point", *_mass(forms, body), " ", *_center(forms, body))
    if body.shape is not None and body.shape.formulas:
        told += (f" a uniform {SHAPES[body.shape.kind]}", *_sized(forms, body, body.shape))
    else:
        told += _mass(forms, body)
    return (*told, ", its mass centre ", *_center(forms, body), *_from_the_base(body))


def _from_the_base(body: Body) -> Prose:
    """How the axes of a body lie, where the problem gives turns that take those of the base to them."""
    if body.axes.kind is not AxesKind.BASE or not body.axes.turns:
        return ()
    return (", its axes those of the base turned by ", turned(body.axes.turns))


def _with_density(forms: Forms, body: Body, density: Density) -> Prose:
    """a slender rod of mass per length ρ₀ (1 + x/l), x from its near end, and length l along 𝐱₁, ..."""
    assert density.shape is not None
    where: Prose = ("near end at ", letters.o(ends(forms.robot, body)[0]))
    if not density.begins:
        where = ("mass centre ", *_center(forms, body))
    shape = (f" a {SHAPES[density.shape.kind]}", *_sized(forms, body, density.shape))
    return (*shape, ", its ", *where, *_from_the_base(body))


def _mass(forms: Forms, body: Body) -> Prose:
    if body.density is not None and body.density.shape is not None:
        slices = KINDS[body.density.shape.kind].slices
        assert slices is not None
        told: Prose = (f" of mass per {slices.per} ", body.density.formula)
        return (*told, ", ", Symbol("x"), " from its near end,") if body.density.varies else told
    if body.mass.is_zero:
        return (" without mass",)
    return (" of mass ", measured(forms.of(body.mass), "kg"))


# -- shapes ----------------------------------------------------------------------------------------


def _sized(forms: Forms, body: Body, shape: Shape) -> Prose:
    """of mass m₁, radius r₁ and length l₁ along 𝐲₁; of a box: and sides b, b and c along 𝐱₁, 𝐲₁ and 𝐳₁"""
    sizes = {key: measured(forms.of(value), "m") for key, value in shape.dimensions}
    if not set(sizes) <= set(DIMENSIONS):
        along = listed([axis_of(forms, body, axis) for axis in sizes])
        return (*_mass(forms, body), " and sides ", *listed(list(sizes.values())), " along ", *along)
    parts: list[Prose] = [_mass(forms, body), *((f"{DIMENSIONS[key]} ", size) for key, size in sizes.items())]
    if not shape.axis:
        return listed(parts)
    along = axis_of(forms, body, shape.axis)
    return (*listed(parts), " along " if "length" in sizes else ", its axis along ", *along)


def axis_of(forms: Forms, body: Body, name: str) -> Prose:
    """𝐳₁ of a body with the axes of frame 1; 𝐳₀ where it always is this; else its z-axis."""
    if has_link_axes(body):
        return (Letter(name, Number(body.link), style="bold"),)
    if stays_with_base(forms, body, _XYZ.index(name)):
        return (Letter(name, Number(0), style="bold"),)
    return (f"its {name}-axis",)


# -- mass centres ----------------------------------------------------------------------------------


def _center(forms: Forms, body: Body) -> Prose:
    """at 𝐨₂; at l_c1 from 𝐨₀ along 𝐱₁"""
    near, far = ends(forms.robot, body)
    if body.center_written == "tip":
        return ("at ", letters.o(far))
    if body.center.is_zero:
        return ("at ", letters.o(body.link))
    if body.center_written == "midpoint":
        return ("half-way along the link",)
    fraction = part_of_the_way(body) if is_given_by(body, "along") else None
    if fraction is not None:
        return (fraction, " of the way from ", letters.o(near), " to ", letters.o(far))
    start, place = body.link, body.center
    end = other_end(forms.robot, body)
    if end is not None:  # it is given from there
        start, place = end[0], body.center - end[1]
    return _place(forms, place.entries, start, body.link)


def _place(forms: Forms, entries: Sequence[Expr], start: int, frame: int) -> Prose:
    """Where a vector leads from an origin: along an axis of a frame, or by its coordinates there."""
    along = [(axis, entry) for axis, entry in zip(_XYZ, entries, strict=True) if not entry.is_zero]
    if not along:
        return ("at ", letters.o(start))
    if len(along) > 1:
        at = Row((Words("("), side_by_side([forms.of(entry) for entry in entries]), Words(")")))
        return ("at ", at, " from ", letters.o(start), f" along the axes of frame {frame}")
    ((axis, entry),) = along
    unit: Node = Letter(axis, Number(frame), style="bold")
    shown = forms.of(entry)
    if isinstance(shown, Negative):
        shown, unit = shown.argument, Negative(unit)
    return ("at ", measured(shown, "m"), " from ", letters.o(start), " along ", unit)


# -- tensors ---------------------------------------------------------------------------------------


def of_tensors(forms: Forms) -> Prose:
    """Which moments of inertia are given, about which axes; nothing where shapes tell them."""
    given = [
        body
        for body in forms.robot.bodies
        if not (body.is_point or body.density or (body.shape is not None and body.shape.formulas))
    ]
    plain = [body for body in given if _is_diagonal(body) and not is_moved(body)]
    return (*_moments(forms, plain), *(part for b in given if b not in plain for part in _tensor(forms, b)))


def _tensor(forms: Forms, body: Body) -> Prose:
    """Of a tensor with products of inertia, or about another point: that it is given, and about what."""
    point: Inline = letters.o(body.link if body.about == "origin" else ends(forms.robot, body)[0])
    about: Prose = (point,) if is_moved(body) else ("its mass centre",)
    axes = f"the axes of frame {body.link}" if has_link_axes(body) else "its own axes"
    return (f"The inertia tensor of {name_of(body)} about ", *about, f" along {axes} is given, too. ")


def _moments(forms: Forms, bodies: Sequence[Body]) -> Prose:
    """Moments of inertia about axes through the mass centres: of body 1 I₁, about that parallel to 𝐳₁; ..."""
    found = [(body, value, axes) for body in bodies for value, axes in _by_value(forms, body)]
    if not found:
        return ()
    if len(found) == 1 and len(found[0][2]) == 1:
        ((body, value, (axis,)),) = found
        what = f"The moment of inertia of {name_of(body)} about the axis through its mass centre parallel to "
        return (what, *axis, " is ", value, ". ")
    if len(found) == len(bodies) and all(len(axes) == 1 for _, _, axes in found):
        return _one_each([(body, value, axis) for body, value, (axis,) in found])
    told: Prose = ()
    for body in bodies:
        own = [(value, axes) for one, value, axes in found if one is body]
        if own:
            axes = listed([axis for _, several in own for axis in several])
            values = listed([value for value, _ in own])
            that = "that" if sum(len(several) for _, several in own) == 1 else "those"
            told += ("; " if told else "", f"of {name_of(body)} ", *values)
            told += (f", about {that} parallel to ", *axes)
    several = any(len(own) > 1 for own in (_nonzero(body) for body in bodies))
    rest = "; the other entries of the tensors are taken as 0" if several else ""
    return ("Moments of inertia about axes through the mass centres: ", *told, f"{rest}. ")


def _one_each(found: Sequence[tuple[Body, Node, Prose]]) -> Prose:
    """The moment of inertia of body 1 about the axis ... is I₁; that of body 2, ..."""
    (body, value, axis), *others = found
    what = f"The moment of inertia of {name_of(body)} about the axis through its mass centre parallel to "
    told: Prose = (what, *axis, " is ", value)
    for body, value, axis in others:
        told += (f"; that of {name_of(body)}, about such an axis parallel to ", *axis, ", is ", value)
    return (*told, ". ")


def _by_value(forms: Forms, body: Body) -> list[tuple[Node, list[Prose]]]:
    """The moments that are not 0, each with the axes about which it is."""
    axes: dict[Expr, list[Prose]] = {}
    for axis, value in _nonzero(body):
        axes.setdefault(value, []).append(axis_of(forms, body, axis))
    return [(measured(forms.of(value), "kg m^2"), own) for value, own in axes.items()]


def _nonzero(body: Body) -> list[tuple[str, Expr]]:
    assert body.inertia is not None
    return [(axis, body.inertia[i, i]) for i, axis in enumerate(_XYZ) if not body.inertia[i, i].is_zero]


def _is_diagonal(body: Body) -> bool:
    """Whether a tensor has no products of inertia."""
    assert body.inertia is not None
    return all(body.inertia[i, j].is_zero for i in range(3) for j in range(3) if i != j)
