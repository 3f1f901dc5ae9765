"""What is given, a line for each symbol with its unit, and what is to be found: the exercise.

It is said before the solution, in the words of the problem file, so that the problem can be solved from it
alone: the table or the bodies, what acts on them, what is asked, and what the solution takes for granted.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import groupby
from typing import TYPE_CHECKING

from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.inequality import Bound
from dynsolve.algebra.linear_systems import is_diagonal
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.rationals import rational_value
from dynsolve.algebra.ring import Expr
from dynsolve.derivation.reached import angle_rows
from dynsolve.document import Block, Formula, Inline, List, Prose, Text
from dynsolve.document.sentences import opened, say
from dynsolve.explain.actions import leads_with_minus
from dynsolve.explain.forms import Forms
from dynsolve.explain.inequalities import Inequalities
from dynsolve.explain.inertia import has_link_axes, is_moved, lies_as_drawn, stays_with_base
from dynsolve.explain.kinematics import turned
from dynsolve.explain.mass_centers import Place, ends, in_formulas, other_end, part_of_the_way
from dynsolve.explain.notation_list import problem_names
from dynsolve.explain.parameter_meanings import DIMENSIONS, SHAPES, roles, units_of_values
from dynsolve.explain.textbook_letters import Line
from dynsolve.explain.writing import (
    agreeing,
    and_joined,
    flat,
    listed,
    machine,
    measured,
    name_of,
    side_by_side,
)
from dynsolve.notation import tree
from dynsolve.notation.characters import split
from dynsolve.notation.printing import decimal_text
from dynsolve.notation.text import read
from dynsolve.notation.tree import (
    ZERO,
    Degrees,
    Negative,
    Node,
    Number,
    Relation,
    Row,
    Symbol,
    Words,
    equation,
    mapped,
    number,
    walk,
)
from dynsolve.problem.model import Problem
from dynsolve.quantities import letters
from dynsolve.quantities.families import DH
from dynsolve.quantities.index import Quantity, quantities
from dynsolve.quantities.owners import asked_stages, derived_stages
from dynsolve.quantities.stages import ASKED_FOR, Stage
from dynsolve.robot import actions, units
from dynsolve.robot.model import AxesKind, Body, JointType, Robot
from dynsolve.robot.shapes import AXES, KINDS, Shape

if TYPE_CHECKING:
    from dynsolve.robot.drawing.normals import Normals

MOST_BODIES = 4
"""Up to this number of bodies each is named."""

_PROPERTIES = "mass, mass centre and inertia tensor"

_COUNTS = {1: "one rigid body", 2: "two rigid bodies", 3: "three rigid bodies", 4: "four rigid bodies"}


def statement(
    forms: Forms, problem: Problem, sines: Iterable[Line] = (), *, frames: bool = True
) -> Iterator[Block]:
    """Given: the arm or the mechanism, what acts on it; its symbols, without `frames` by no frame."""
    given = [sentence for sentence in _sentences(forms, problem) if sentence]
    if given:
        yield from displayed(("Given: ", *sentences(given)))
    names: list[Prose] = []
    for line in problem_names(forms.robot, frames=frames):  # l₁, l₂: length of link i (m)
        unit: Prose = (" (", units.node(line.unit), ")") if line.unit else ()
        names.append((line.sign, f": {line.meaning}", *unit))
    names += [(line.words,) for line in sines]
    if names:
        yield List(tuple(names))


def to_be_found(forms: Forms, problem: Problem) -> Iterator[Text]:
    """What is asked, in a sentence."""
    robot = forms.robot
    known, stages = quantities(robot), derived_stages(robot)
    there = [known[name] for name in problem.find if known[name].family.stage in stages]
    found = [
        in_words(robot, tuple(members)) for _, members in groupby(there, key=lambda quantity: quantity.family)
    ]
    if not found and robot.has_table:
        found = [(letters.H(robot, len(robot.joints)),), in_words(robot, (known["J"],))]
    if found:
        yield Text(("To be found: ", *listed(found), "."))


def displayed(prose: Prose) -> Iterator[Text | Formula]:
    """A paragraph, in which what has a matrix of several rows stands in a display of its own.

    >>> matrix = tree.Matrix(((ZERO,), (ZERO,)))
    >>> [type(block).__name__ for block in displayed(("To be reached: ", matrix, ". Then."))]
    ['Text', 'Formula', 'Text']
    """
    words: list[Inline] = []
    for part in prose:
        if isinstance(part, Node) and any(isinstance(n, tree.Matrix) and len(n.rows) > 1 for n in walk(part)):
            yield from _paragraph(words)
            yield Formula(part)
            words = []
        else:
            words.append(part)
    yield from _paragraph(words)


def _paragraph(words: list[Inline]) -> Iterator[Text]:
    """The words, without the stop of a display before them."""
    match words:
        case [str(first), *rest]:
            words = [first.removeprefix(".").lstrip(), *rest]
    while words and words[0] in ("", " "):
        words = words[1:]
    if words:
        *before, last = words
        yield Text((*before, last.rstrip() if isinstance(last, str) else last))


def sentences(parts: Sequence[Prose]) -> Iterator[Inline]:
    """Sentences with a blank between them."""
    for place, sentence in enumerate(parts):
        *before, last = sentence
        yield from (" ", *before) if place else before
        yield last.rstrip() if isinstance(last, str) else last


def _sentences(forms: Forms, problem: Problem) -> Iterator[Prose]:
    robot = forms.robot
    if problem.normals is not None:
        yield ("the axes of the arm as they are drawn, in world coordinates.",)
        yield from _axes(problem.normals)
        yield _drawn_bodies(forms)
    elif robot.has_table:
        yield (*_table(forms), ".")
        yield _angles(robot)
    else:
        yield from _model(forms)
    if robot.has_table and 0 < len(robot.bodies) <= MOST_BODIES:
        yield _tensors(forms)
    if problem.normals is None:
        yield _base(forms)
    if robot.has_dynamics and robot.given is None:
        yield _gravity(forms)
    if robot.has_dynamics:
        yield from _actions(forms)
        yield _indices(robot)
    yield from _questions(forms)
    yield _values(robot, problem.written, problem.units)


MOST_NAMED = 9
"""Of more quantities, if they are all of a family, the first two are named, and the last."""


def in_words(robot: Robot, members: Sequence[Quantity]) -> Prose:
    """Quantities of one family in words: the inertia matrix 𝐃; the matrices 𝐀₁ and 𝐀₂ of the rows.

    >>> from dynsolve.solution.solution import load
    >>> robot = load("planar-2r").robot
    >>> in_words(robot, [quantities(robot)[name] for name in ("A1", "A2")])[::2]
    ('the matrices ', ' and ', ' of the rows of the table')
    """
    family = members[0].family
    before, filled, after = agreeing(family.called_of(robot), len(members)).partition("{}")
    if not family.has_letter or family is DH:
        return (f"{before.rstrip()}{after}",)
    own = listed([(quantity.letter(robot),) for quantity in members])
    whole = quantities(robot).of_family(family)
    if len(members) > MOST_NAMED and {*map(_place_in_whole, members)} == {*map(_place_in_whole, whole)}:
        first, second, *_, last = (quantity.letter(robot) for quantity in members)
        own = (first, ", ", second, ", …, ", last)
    return (before if filled else f"{before} ", *own, after)


def _place_in_whole(quantity: Quantity) -> tuple[int, ...]:
    """c_211 has that of c_121."""
    return quantity.entry or quantity.index


# -- the table, the axes of a drawing, the energies ------------------------------------------------


def _table(forms: Forms) -> Prose:
    robot = forms.robot
    what = f"the table of the {machine(robot)}{_joints(robot)}"
    count = len(robot.bodies)
    if not count:
        return (what,)
    if count > MOST_BODIES:
        return (f"{what}, and {_PROPERTIES} of {count} rigid bodies", *_masses(forms))
    return (f"{what} and {_COUNTS[count]}: ", *_bodies(forms))


def _bodies(forms: Forms) -> Prose:
    told = tuple(part for body in forms.robot.bodies for part in ("; ", *_body(forms, body)))
    return told[1:]


def _drawn_bodies(forms: Forms) -> Prose:
    """The bodies of a drawing; nothing where there are none."""
    count = len(forms.robot.bodies)
    if count > MOST_BODIES:
        return (f"{opened(_PROPERTIES)} of {count} rigid bodies are given, too", *_masses(forms), ".")
    told = _bodies(forms)
    return (f"{opened(_COUNTS[count])}: ", *told, ".") if told else ()


def _angles(robot: Robot) -> Prose:
    """In the table θ of row 2 is θ₂ + 30°; nothing of right angles."""
    told: list[Prose] = []
    for joint in robot.joints:
        theta, _, _, alpha = letters.columns(robot, Number(joint.index))
        first, *_, last = joint.written
        for letter, angle, written in ((theta, joint.theta, first), (alpha, joint.alpha, last)):
            if angle.degrees % 90:
                bare = mapped(written, lambda node: Symbol(node.name) if isinstance(node, Symbol) else node)
                told.append((letter, f" of row {joint.index} is ", bare))
    return ("In the table ", *listed(told), ".") if told else ()


def _joints(robot: Robot) -> str:
    """with revolute joints; with a revolute and a prismatic joint; nothing of a table without joints."""
    types = [joint.type for joint in robot.joints if joint.type]
    words = {JointType.REVOLUTE: "revolute", JointType.PRISMATIC: "prismatic"}
    found = [word for kind, word in words.items() if kind in types]
    if len(types) == len(found):
        return f" with {' and '.join(f'a {word}' for word in found)} joint" if found else ""
    return f" with {' and '.join(found)} joints"


def _axes(normals: Normals) -> Iterator[Prose]:
    drawing = normals.drawing

    def flat_row(vector: Matrix) -> Node:
        return flat(map(Compactor(drawing.ring).form, vector.entries))

    for i, axis in enumerate(drawing.axes, 1):
        told: Prose = (f"Joint {i}, with the variable ", Symbol(axis.coordinate))
        told += (", slides along " if axis.slides else ", turns about ", flat_row(axis.line.direction))
        told += (" through ", flat_row(axis.line.point)) if axis.is_placed else ()
        yield (*told, ".")
    yield ("In this pose the hand is at ", flat_row(drawing.hand.at), ".")


def vector(forms: Forms, entries: Sequence[Expr], unit: str) -> Node:
    """(v_x, v_y), with its unit where all entries are numbers."""
    row = flat(map(forms.of, entries))
    if all(entry.is_number for entry in entries):
        return Row((row, Words(" "), units.node(unit)))
    return row


def _model(forms: Forms) -> Iterator[Prose]:
    """The bodies by their positions, or the energies, the Lagrangian or the inertia matrix."""
    given = forms.robot.given
    if given is not None:
        if given.D is not None:
            yield (equation(letters.D, forms.of(given.D)), ".")
        energies = {"K": letters.K, "P": letters.P, "L": letters.L}
        yield from ((equation(energies[name], typed), ".") for name, typed in given.typed)
        return
    yield from (_position(forms, body) for body in forms.robot.bodies)
    for candidate in forms.robot.questions.candidates:
        own = forms.in_ring(candidate.matrix.ring)
        yield (equation(Symbol(candidate.name), own.of(candidate.matrix)), ".")


def _position(forms: Forms, body: Body) -> Prose:
    """Body 2, a point of mass m, is at (x + l sin θ, l cos θ, 0)."""
    from dynsolve.explain.placed_bodies import turned as turning

    point = "a point " if body.is_point else ""
    told: Prose = (f"{opened(name_of(body))}, {point}", *_mass(forms, body))
    told += (", is at ", flat(map(forms.of, body.center.entries)), ".")
    if body.inertia is None:
        return told
    told += (" ", *turning(body))
    for value, alike in _alike(_nonzero(body)).items():
        axes = f"axis {alike[0]}" if len(alike) == 1 else f"axes {and_joined(alike)}"
        told += (f" Its moment of inertia about {axes} through its mass centre is ",)
        told += (measured(forms.of(value), "kg m^2"), ".")
    return told


# -- a body: its mass, the dimensions of its shape, its mass centre, its moments of inertia --------


def _body(forms: Forms, body: Body) -> Prose:
    """body 2 in link 2, a uniform slender rod of mass m₂ and length l₂ along 𝐱₂, its mass centre at 𝐨₁"""
    density, shape = body.density, body.shape
    center = ("mass centre ", *_place(forms, body))
    if body.is_point and density is None:
        what: Prose = (" a point ", *_mass(forms, body), " ", *center[1:])
    elif density is not None:
        assert density.shape is not None
        if density.begins:
            center = ("near end at ", letters.o(ends(forms.robot, body)[0]))
        what = (f" a {SHAPES[density.shape.kind]}", *_sized(forms, body, density.shape), ", its ", *center)
    elif shape is not None and shape.formulas:
        what = (f" a uniform {SHAPES[shape.kind]}", *_sized(forms, body, shape), ", its ", *center)
    else:
        what = (" ", *_mass(forms, body), *(() if body.mass.is_zero else (", its ", *center)))
    axes = () if body.is_point and density is None else _own_axes(forms, body)
    return (f"{name_of(body)} in link {body.link},", *what, *axes)


def _own_axes(forms: Forms, body: Body) -> Prose:
    """How the axes of a body lie, where they are not those of its link."""
    is_drawn = forms.robot.questions.is_drawn
    axes, from_base = body.axes, body.axes.kind is AxesKind.BASE
    if axes.kind is AxesKind.REST:
        return say(", its axes those of the base at $𝐪 = 𝟎$")
    if lies_as_drawn(body):
        return (", its axes in this pose those of the world",)
    ground = "the world" if is_drawn else "the base"
    seen_from = ground if from_base else f"frame {body.link}"
    if axes.turns:
        return (f", its axes those of {seen_from} turned by ", turned(axes.turns))
    rotation = forms.robot.base_rotation @ axes.rotation if from_base and is_drawn else axes.rotation
    columns = [flat(map(forms.of, column)) for column in rotation.T.rows]
    return (f", its axes, seen from {seen_from}, along ", *listed(columns)) if axes.written else ()


def _mass(forms: Forms, body: Body) -> Prose:
    if body.density is not None and body.density.shape is not None:
        slices = KINDS[body.density.shape.kind].slices
        assert slices is not None
        place = say(" at the distance $x$ from its near end") if body.density.varies else ()
        return (f"of mass per {slices.per} ", body.density.formula, *place)
    return ("of mass ", _named_mass(forms, body))


def _masses(forms: Forms) -> Prose:
    """What is behind the letters of masses that are none, of many bodies."""
    told = [mass for body in forms.robot.bodies if isinstance(mass := _named_mass(forms, body), Relation)]
    return (", ", *listed(told)) if told else ()


def _named_mass(forms: Forms, body: Body) -> Node:
    """m; or m₁ = 2.5 kg, where that is what formulas call it."""
    name, value = forms.mass(body), forms.of(body.mass)
    return name if name == value else equation(name, measured(value, "kg"))


def _sized(forms: Forms, body: Body, shape: Shape) -> Prose:
    """of mass m₁, radius r₁ and length l₁ along 𝐲₁; of a box: and sides b, b and c along 𝐱₁, 𝐲₁ and 𝐳₁"""
    sizes = {key: measured(forms.of(value), "m") for key, value in shape.dimensions}
    mass = (" ", *_mass(forms, body))
    if not set(sizes) <= set(DIMENSIONS):
        along = listed([_axis(forms, body, axis) for axis in sizes])
        return say(
            "{mass} and sides {sizes} along {along}", mass=mass, sizes=listed([*sizes.values()]), along=along
        )
    parts = listed([mass, *((f"{DIMENSIONS[key]} ", size) for key, size in sizes.items())])
    if not shape.axis:
        return parts
    how = " along " if "length" in sizes else ", its axis along "
    return (*parts, how, *_axis(forms, body, shape.axis))


def _axis(forms: Forms, body: Body, name: str) -> Prose:
    """𝐳₁ of a body with the axes of frame 1; 𝐳₀ where it always is this; else its z-axis."""
    if has_link_axes(body):
        return (letters.bold(name, Number(body.link)),)
    if stays_with_base(forms, body, AXES.index(name)):
        return (letters.bold(name, Number(0)),)
    return (f"its {name}-axis",)


def _place(forms: Forms, body: Body | Place) -> Prose:
    """A point of a link: at 𝐨₂; at l_c1 from 𝐨₀ along 𝐱₁; at (x, y, 0) from 𝐨₁ along the axes of frame 1"""
    if isinstance(body, Body) and body.drawn:
        return ("at ", flat(in_formulas(forms, body.drawn.at)), " in this pose")
    near, far = ends(forms.robot, body)
    if body.center_written == "tip":
        return ("at ", letters.o(far))
    if body.center.is_zero:
        return ("at ", letters.o(body.link))
    fraction = part_of_the_way(body)
    if fraction == letters.HALF:
        return ("half-way along the link",)
    if fraction is not None:
        return (fraction, " of the way from ", letters.o(near), " to ", letters.o(far))
    end = other_end(forms.robot, body)  # it is given from there, if from an end
    start, place = (body.link, body.center) if end is None else (end[0], body.center - end[1])
    along = [(axis, entry) for axis, entry in zip(AXES, place.entries, strict=True) if not entry.is_zero]
    if not along:
        return ("at ", letters.o(start))
    if len(along) > 1:
        at = flat(map(forms.of, place.entries))
        return ("at ", at, " from ", letters.o(start), f" along the axes of frame {body.link}")
    ((axis, entry),) = along
    unit: Node = letters.bold(axis, Number(body.link))
    shown = forms.of(entry)
    if isinstance(shown, Negative):
        shown, unit = shown.argument, Negative(unit)
    return ("at ", measured(shown, "m"), " from ", letters.o(start), " along ", unit)


def _tensors(forms: Forms) -> Prose:
    """Which moments of inertia are given, about which axes; nothing where shapes tell them."""
    given = [
        body
        for body in forms.robot.bodies
        if not (body.is_point or body.density or (body.shape is not None and body.shape.formulas))
    ]
    plain = [body for body in given if body.inertia and is_diagonal(body.inertia) and not is_moved(body)]
    told = _moments(forms, plain)
    for body in (body for body in given if body not in plain):
        point: Inline = letters.o(body.link if body.about == "origin" else ends(forms.robot, body)[0])
        assert body.inertia is not None
        if is_diagonal(body.inertia) and len(own := _nonzero(body)) == 1:
            ((axis, value),) = own
            told += say(
                "The moment of inertia of {body} about the axis through {point} parallel to {axis} is "
                "{value}. ",
                body=name_of(body),
                point=point,
                axis=_axis(forms, body, axis),
                value=measured(forms.of(value), "kg m^2"),
            )
            continue
        told += say(
            "The inertia tensor of {body} about {point} along {axes}{rest} is {tensor}. ",
            body=name_of(body),
            point=point if is_moved(body) else "its mass centre",
            axes=f"the axes of frame {body.link}" if has_link_axes(body) else "its own axes",
            tensor=forms.of(body.inertia),
            rest=", with 0 for the moments that are not given," if len(_nonzero(body)) < 3 else "",
        )
    return told


def _moments(forms: Forms, bodies: Sequence[Body]) -> Prose:
    """Moments of inertia about axes through the mass centres: body 1 has I₁ about that parallel to 𝐳₁; ..."""
    found = [(body, _alike(_nonzero(body))) for body in bodies if _nonzero(body)]
    told: Prose = ()
    is_one_each = len(found) in (1, len(bodies))
    if found and is_one_each and all(len(own) == 1 and len(*own.values()) == 1 for _, own in found):
        about = (
            "The moment of inertia of {body} about the axis through its mass centre parallel to {axis} is "
        )
        for body, own in found:
            (value, (axis,)) = next(iter(own.items()))
            told += say(about, body=name_of(body), axis=_axis(forms, body, axis))
            told += (measured(forms.of(value), "kg m^2"),)
            about = "; that of {body}, about such an axis parallel to {axis}, is "
        return (*told, ". ")
    for body, own in found:
        told += ("; " if told else "", f"{name_of(body)} has ")
        one_each = all(len(alike) == 1 for alike in own.values())
        groups = [([value], alike) for value, alike in own.items()]
        if one_each:
            groups = [(list(own), [axis for (axis,) in own.values()])]
        told += listed([_about_axes(forms, body, *group) for group in groups])
    if not told:
        return ()
    several = any(len(_nonzero(body)) > 1 for body, _ in found)
    centers, these = ("centre", "this tensor") if len(found) == 1 else ("centres", "these tensors")
    rest = f"; the other entries of {these} are taken as 0" * several
    return (f"Moments of inertia about axes through the mass {centers}: ", *told, f"{rest}. ")


def _about_axes(forms: Forms, body: Body, values: Sequence[Expr], axes: Sequence[str]) -> Prose:
    """I_x and I_y about those parallel to 𝐱₁ and 𝐲₁; one value about all of these axes."""
    those = "that" if len(axes) == 1 else "those"
    shown = listed([measured(forms.of(value), "kg m^2") for value in values])
    return (*shown, f" about {those} parallel to ", *listed([_axis(forms, body, axis) for axis in axes]))


def _nonzero(body: Body) -> list[tuple[str, Expr]]:
    assert body.inertia is not None
    return [(axis, body.inertia[i, i]) for i, axis in enumerate(AXES) if not body.inertia[i, i].is_zero]


def _alike(moments: Iterable[tuple[str, Expr]]) -> dict[Expr, list[str]]:
    """The values of moments, each with its axes."""
    axes: dict[Expr, list[str]] = {}
    for axis, value in moments:
        axes.setdefault(value, []).append(axis)
    return axes


# -- the base, and what acts -----------------------------------------------------------------------


def _base(forms: Forms) -> Prose:
    """Frame 0 is moved by h₀ along 𝐳_w and turned by 30° about 𝐱_w; nothing where it is the world.

    A second turn is about an axis that the first one has turned.
    """
    robot = forms.robot
    if not letters.has_base(robot):
        return ()
    moves = zip(AXES, map(forms.of, robot.base_position.entries), strict=True)
    told = [("moved ", measured(far, "m"), axis) for axis, far in moves if far != ZERO]
    told += [("turned ", angle, axis) for axis, angle in robot.base_turns]
    is_turned = robot.base_rotation != robot.base_rotation.identity(robot.ring, 3)
    if len(told) > 2 or (is_turned and not robot.base_turns):
        return ("Frame 0, seen from the world w, is ", equation(letters.H(robot, 0), forms("H0")), ". ")
    how: Prose = ("Frame 0 is ",)
    for place, (verb, size, axis) in enumerate(told):
        by = verb if not place or verb != told[place - 1][0] else ""
        how += (" and " * bool(place) + by + "by ", size, " along " if verb == "moved " else " about ")
        is_second = place > 0 and verb == told[place - 1][0] == "turned "
        how += (f"its own {axis}-axis",) if is_second else (letters.bold(axis, Words("w")),)
    return (*how, " in the world w. ")


def _gravity(forms: Forms) -> Prose:
    """Gravity g acts along -𝐲₀; there is no friction."""
    robot = forms.robot
    entries = robot.gravity.entries
    in_world = letters.has_base(robot)
    along = [(axis, entry) for axis, entry in zip(AXES, entries, strict=True) if not entry.is_zero]
    told: Prose = ("There is no gravity",)
    if len(along) == 1:
        ((axis, entry),) = along
        opposite = leads_with_minus(entry)
        size = -entry if opposite else entry
        told = (", ", measured(forms.of(size), "m/s²"), ",") if size.is_number else (" ", forms.of(size))
        told = ("Gravity", *told, " acts ")
        if robot.has_table:
            unit = letters.bold(axis, Words("w") if in_world else Number(0))
            told += ("along ", Negative(unit) if opposite else unit)
        else:
            told += (f"{'against' if opposite else 'along'} the axis {axis}",)
    elif along:
        written = vector(forms, entries, "m/s^2")
        ground = "the world" if in_world or not robot.has_table else "frame 0"
        told = ("The acceleration of gravity is ", equation(letters.GRAVITY, written))
        told += (f" along the axes of {ground}",)
    if robot.actions.resisting:
        return (*told, ".")
    if robot.questions.constraints or robot.given is not None or robot.rolls:
        return (*told, "; " if along else ", and ", "no friction is given.")
    return (*told, "; there is no friction." if along else " and no friction.")


def _actions(forms: Forms) -> Iterator[Prose]:
    """A sentence for each thing that acts beside gravity."""
    acting = forms.robot.actions
    for act in (*acting.stored, *acting.resisting, *acting.rotors):
        yield actions.part(act.kind, "explain").given(forms, act)
    if acting.passive:
        names = [Symbol(forms.robot.coordinates[k].name) for k in acting.passive]
        yield ("No motor drives ", *listed(names, "or"), ".")


def _indices(robot: Robot) -> Prose:
    """Index 3 stands for q₄: where the number of a coordinate is not its place."""
    others = [q for q in robot.coordinates if (own := split(q.name)[1]) and own[0] != str(q.index)]
    if not others or not all(split(q.name)[1][0].isdigit() for q in others):
        return ()
    index, stand = ("Indices", "stand") if len(others) > 1 else ("Index", "stands")
    return (
        f"{index} {and_joined([str(q.index) for q in others])} {stand} for ",
        *listed([Symbol(q.name) for q in others]),
        *(": ", letters.force(others[0]), " belongs to ", Symbol(others[0].name), "."),
    )


# -- what is asked, and in which state; numbers ----------------------------------------------------


def _in_letters(entry: Node) -> Node:
    """What a file writes as tip.x or P.y, in the letters of the points."""
    with_letters = Stage.TASK.part("explain").with_letters

    return mapped(entry, with_letters)


def holds_at_state(robot: Robot, name: str) -> bool:
    """Whether a result holds at the given state alone."""
    quantity = quantities(robot).get(name)
    return quantity is not None and quantity.family.at_state and bool(robot.questions.state.values)


def at_the_state(robot: Robot, asked: Iterable[str]) -> Text:
    """At q₁ = 30°, q₂ = 60°:, with the rates where accelerations, which depend on them, are `asked`."""
    with_rates = "qdd" in asked
    values = [one for one in robot.questions.state.values if with_rates or not one[1]]
    given = side_by_side([equation(Symbol(name, dots), value) for name, dots, value in values])
    return Text(say("At {given}:", given=given))


def _questions(forms: Forms) -> Iterator[Prose]:
    """What questions share (points, task, target, limits, state, what is assumed), and what each is given."""
    robot, questions = forms.robot, forms.robot.questions
    for point in questions.points:
        place = _place(forms, Place(point.link, point.position, point.written))
        yield (f"Point {point.name} of link {point.link} is ", *place, ".")
    task = questions.task
    if task is not None and task.entries and not task.is_default:
        yield ("The task is ", equation(letters.TASK, flat(map(_in_letters, task.entries))), ".")
    if questions.target is not None:
        yield ("To be reached: ", _reached(forms, questions.target.values), ".")
    elif "inverse" in questions.asked:
        yield ("To be reached: ", _reached(forms, [*map(Symbol, questions.reached)]), ".")
    ranges = [
        Relation((one.low, Symbol(name), _measured(one.high, _unit(robot, name))), ("≤", "≤"))
        for one in questions.limits
        for name in (one.coordinate,)
    ]
    if ranges:
        yield ("Limits: ", *listed(ranges), ".")
    stages = asked_stages(questions)
    for stage in (stage for stage in ASKED_FOR if stage in stages):
        given = getattr(stage.part("explain"), "given", None)
        yield from given(forms) if given else ()
    if questions.state_is_reached:
        within = " within these limits" if questions.limits else ""
        yield (f"The state is the configuration{within} that reaches it.",)
    elif questions.state.values and any(holds_at_state(robot, name) for name in questions.asked):
        yield ("The state: ", in_units(robot, questions.state.values), ".")
    said: list[tuple[Prose, Sequence[Bound]]] = [((), questions.model.assumed)]
    if questions.candidates and forms.robot.given is None:  # each has its own
        said = [((" of ", Symbol(one.name)), one.assumed) for one in questions.candidates]
    written = Inequalities(forms.robot)
    for of, assumed in said:
        if assumed:
            yield ("Assumed", *of, ": ", *listed([written.inequality(bound) for bound in assumed]), ".")


def _unit(robot: Robot, name: str, dots: int = 0) -> str:
    """What a coordinate or a rate is measured in."""
    (kind,) = (q.type for q in robot.coordinates if q.name == name)
    return ("m" if kind is JointType.PRISMATIC else "rad") + ("", "/s", "/s^2")[dots]


def in_units(robot: Robot, values: Iterable[tuple[str, int, Node]]) -> Node:
    """q₂ = 0.1 m, q̇₁ = 2 rad/s"""
    measures = ((Symbol(name, dots), value, _unit(robot, name, dots)) for name, dots, value in values)
    return side_by_side([equation(sign, _measured(value, unit)) for sign, value, unit in measures])


def _measured(value: Node, unit: str) -> Node:
    """A value as the problem writes it with its unit, if it is a number."""
    exact = rational_value(value)
    return measured(value if exact is None else number(exact), unit)


def _reached(forms: Forms, values: Sequence[Node]) -> Node:
    """The task, or the frame, and what it is to be."""
    robot, task = forms.robot, forms.robot.questions.task
    if task is None or not task.is_pose:
        left = flat(map(_in_letters, task.entries)) if task and task.is_default else letters.TASK
        return equation(left, of_task(forms, values))
    values = tuple(map(_in_decimals, values))
    rows = [(*values[3 * k + 3 : 3 * k + 6], values[k]) for k in range(3)]
    pose = tree.Matrix((*rows, (ZERO, ZERO, ZERO, Number(1))))
    return equation(letters.H(robot, len(robot.joints)), pose)


def of_task(forms: Forms, values: Iterable[Node], dots: int = 0) -> Node:
    """(0.3, 0.2) m: what the task, or its rate, is to be; (0.3 m, 60°) where it has angles."""
    written, task = list(values), forms.robot.questions.task
    if task is not None and task.is_twist:
        return flat(map(_in_decimals, written))
    per = ("", "/s", "/s^2")[dots]
    kinds = [f"{'rad' if is_angle else 'm'}{per}" for is_angle in angle_rows(forms.values["r"])]
    if len(set(kinds)) == 1 and all(rational_value(value) is not None for value in written):
        return Row((flat(map(_in_decimals, written)), Words(" "), units.node(kinds[0])))
    return flat(
        Row((_in_decimals(value), Words(" "), units.node(unit))) if rational_value(value) else value
        for value, unit in zip(written, kinds, strict=True)
    )


def _in_decimals(value: Node) -> Node:
    """A number with a decimal point, where that comes to an end; anything else as it is."""
    exact = rational_value(value)
    text = None if exact is None else decimal_text(abs(exact.numerator), exact.denominator)
    if exact is None or text is None:
        return value
    return Negative(Words(text)) if exact < 0 else Words(text)


_AS_WRITTEN = re.compile(r"[-+0-9./eE]*")
"""A number that is told as the file has it: 0.4318, 1/4."""


def _values(robot: Robot, written: Mapping[str, str], own_units: Mapping[str, str]) -> Prose:
    """In numbers: a₂ = 0.4318 m; nothing where the problem has no values."""
    known = units_of_values(robot) | {name: unit for name, (_, unit) in roles(robot).items()}
    given: list[Prose] = []
    for name, text in written.items():
        unit = own_units.get(name, known.get(name, ""))
        value = Words(text) if _AS_WRITTEN.fullmatch(text) else read(text).tree
        with_unit = (" ", units.node(unit)) if unit and not isinstance(value, Degrees) else ()
        given.append((equation(Symbol(name), value), *with_unit))
    return (" In numbers: ", *listed(given), ".") if given else ()
