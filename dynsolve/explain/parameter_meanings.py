"""What each parameter of a problem is, in words: length of link 2, from o_1 to o_2.

It is told where no other parameter is in the value: as the entry a of row 2 it is the distance between
two axes, in the stiffness 2k it is half of that; as a term of that entry it is a length in that row.  In any
other expression, m l²/12, the place says nothing of it, and it is called by its dimension: a length.
Parameters that are alike, each with its own number, are told in one line with i (`told_together`).
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from enum import Enum
from fractions import Fraction
from string import ascii_letters, digits

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.angles import names_of
from dynsolve.algebra.factors import is_positive
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.rationals import rational_sqrt
from dynsolve.algebra.ring import Expr
from dynsolve.algebra.ring_values import value_of
from dynsolve.explain.writing import agreeing, and_joined
from dynsolve.notation.build import split_sign
from dynsolve.notation.characters import split
from dynsolve.notation.tree import Node, Symbol
from dynsolve.notation.tree import names_in as names_in_trees
from dynsolve.notation.unicode import lowered, to_unicode
from dynsolve.quantities import letters
from dynsolve.robot.dimensions import Dimensions
from dynsolve.robot.model import Body, Convention, Joint, JointType, Robot
from dynsolve.robot.shapes import AXES, MASS, Shape
from dynsolve.robot.units import of_parameter


class Meaning(Struct, frozen=True):
    """What a parameter is.

    `words` hold {link}, {body} and {before} where numbers stand, as o{link} where one is an index of 𝐨, 𝐱 or
    𝐳, and {axes} or {coordinates} where some of x, y and z stand.  `share` is what of that it is: half the.
    Without words it is that of what its role says.
    """

    words: str = ""
    link: int = 0
    body: str = ""
    before: int = -1
    axes: tuple[str, ...] = ()
    share: str = ""

    @property
    def number(self) -> str:
        """What may be told as i; empty where the numbers in the words differ from each other."""
        if self.body and self.link and self.body != str(self.link):
            return ""
        if self.before >= 0 and self.before != self.link - 1:
            return ""
        return self.body or str(self.link or "")

    def text(self, counted: bool = False) -> str:
        """The words with the numbers, or with i for them."""
        values = {"link": str(self.link), "body": self.body, "before": str(self.before)}
        if counted:
            values = {"link": "i", "body": "i", "before": "i-1"}
        text = _INDEXED.sub(
            lambda found: _AXIS[found[1]] + lowered(values[found[2]]), self.share + self.words
        )
        several, which = len(self.axes) > 1, and_joined(self.axes)
        axes, coordinates = ("axes", "coordinates") if several else ("axis", "coordinate")
        return text.format(**values, axes=f"{axes} {which}", coordinates=f"{coordinates} {which}")


_AXIS = {"o": "𝐨", "x": "𝐱", "z": "𝐳"}
_INDEXED = re.compile(r"\b([oxz])\{(\w+)\}")


class Role(Enum):
    """A role: its meaning for one and for several parameters, in the order in which they are listed."""

    GRAVITY = "acceleration of gravity"
    LENGTH = "length|lengths in the table"
    ANGLE = "constant angle|angles in the table"
    BASE = "place of frame 0 in the world"
    TURN = "angle|angles by which frame 0 is turned in the world"
    MASS = "mass|masses of a|the body|bodies"
    INERTIA = "given moment|moments of inertia"
    PRODUCT = "given product|products of inertia"
    SHAPE = "dimension|dimensions of a|the body|bodies"
    CENTER = "place of a|the mass centre|centres in its|their link|links"
    POSITION = "length|lengths in the given positions"
    DIRECTION = "angle|angles in the given positions"
    DOWN = "angle|angles in the direction of gravity"
    FORCE = "force|forces from outside"
    MOMENT = "moment|moments from outside"
    EXERTED = "force|forces that the arm exerts"
    EXERTED_MOMENT = "moment|moments that the arm exerts"
    PLACE = "place of a|the point|points in its|their link|links"
    SPEED = "given velocity|velocities of the task"
    ACCELERATION = "given acceleration|accelerations of the task"
    STATE = "value|values of a|the coordinate|coordinates in the given state"
    RATE = "rate|rates of a|the coordinate|coordinates in the given state"
    STEADY = "constant rate|rates of a|the coordinate|coordinates"
    CONSTRAINT = "constant|constants in the constraints"
    OTHER = "parameter|parameters of the problem"

    def of(self, count: int, unit: str) -> str:
        """What so many of them are; what no place tells is called by its unit."""
        called = _BY_UNIT.get(unit, self.value) if self is Role.OTHER else self.value
        return agreeing(called, count)


class Acting(Struct, frozen=True):
    """The role of a parameter of something that acts, as its record says it (`robot.actions.Parameter`)."""

    words: str

    def of(self, count: int, unit: str) -> str:
        """What so many of them are."""
        return agreeing(self.words, count)


AnyRole = Role | Acting


def in_order(robot: Robot) -> Iterator[AnyRole]:
    """The roles in the order in which they are listed: of the model, of what acts (rotors first), others."""
    acting = robot.actions
    acts = (*acting.rotors, *acting.stored, *acting.resisting)
    words = (one.words for act in acts for one in act.parameters(robot))
    for role in Role:
        if role is Role.DOWN:
            yield from map(Acting, dict.fromkeys(filter(None, words)))
        yield role


_BY_UNIT = {
    "m": "length|lengths",
    "kg": "mass|masses",
    "kg m^2": "moment|moments of inertia",
    "N": "force|forces",
    "N m": "torque|torques",
    "m/s": "velocity|velocities",
    "rad": "angle|angles",
}
"""What a parameter is that is no value by itself, but a part of one."""


def roles(robot: Robot) -> dict[str, tuple[AnyRole, str]]:
    """The role and the SI unit of every parameter; the first role counts where one has several."""
    found: dict[str, AnyRole] = {}
    for role, name, _ in _places(robot):
        found.setdefault(name, role)
    dimensions, at_state = _dimensions(robot), units_of_values(robot)
    acting = (one for act in robot.actions.acts for one in act.parameters(robot) if one.unit)
    of_acts = {name: one.unit for one in acting for name in names_in(one.value) if _factor(one.value, name)}
    in_angles = dict(_units_in_angles(robot))

    def unit(name: str, role: AnyRole) -> str:
        own = dimensions.get(name) or at_state.get(name, "")
        if isinstance(role, Acting):
            return of_acts.get(name, own) if name in dimensions else own
        if role is Role.OTHER and not own:
            return in_angles.get(name, "")
        return "rad" if role in (Role.TURN, Role.DOWN, Role.DIRECTION) else own

    def told(name: str) -> AnyRole:
        own = found.get(name, Role.OTHER)
        return own if own is not Role.POSITION or dimensions.get(name) == "m" else Role.OTHER

    return {name: (told(name), unit(name, told(name))) for name in robot.parameters}


def _units_in_angles(robot: Robot) -> Iterator[tuple[str, str]]:
    """Units of the parameters in angles: rad of one by itself, m of ρ in x/ρ."""
    lengths = {q.name for q in robot.coordinates if q.type is JointType.PRISMATIC}
    for atom in (atom for pair in robot.ring.pairs for atom, _ in pair.angle.terms):
        own = [(name, exponent) for name, exponent in atom if name in robot.parameters]
        if len(own) == 1:
            ((name, exponent),) = own
            is_length = sum(power for other, power in atom if other in lengths) == -exponent
            yield name, "rad" if len(atom) == 1 else "m" * is_length


def units_of_values(robot: Robot) -> dict[str, str]:
    """Units of the parameters that are the value of a coordinate or of a rate."""
    base = {q.name: "m" if q.type is JointType.PRISMATIC else "rad" for q in robot.coordinates}
    given = [*robot.questions.state.values, *robot.questions.model.linearize]
    given += [(name, 1, value) for name, value in robot.questions.model.steady]
    given += [(one.coordinate, 0, end) for one in robot.questions.limits for end in (one.low, one.high)]
    per = ("", "/s", "/s^2")
    return {own: base[name] + per[dots] for name, dots, value in given for own in _alone_in_tree(value)}


def meanings(robot: Robot) -> dict[str, tuple[AnyRole, str, Meaning]]:
    """The role, the SI unit and the meaning of every parameter, in their order."""
    places: dict[tuple[AnyRole, str], dict[Meaning, None]] = {}
    for role, name, meaning in _places(robot):
        places.setdefault((role, name), {})[meaning] = None
    told = {(role, name): _as_one(role, tuple(of)) for (role, name), of in places.items()}
    found = {}
    for name, (role, unit) in roles(robot).items():
        own, shape = (told.get((one, name), Meaning()) for one in (role, Role.SHAPE))
        if role is Role.LENGTH and own.words and shape.words:  # height of o_1 above o_0; length of body 1
            own = replace(
                own, words=f"{own.words}; {shape.share}{shape.words}", body=shape.body, axes=shape.axes
            )
        found[name] = role, unit, own
    return found


def _dimensions(robot: Robot) -> dict[str, str]:
    """Units of the parameters as far as known: a torque, or a torsion spring's stiffness, is no energy."""
    known = Dimensions(robot.ring, robot, with_questions=True)
    units: dict[str, str] = {}
    for generator in robot.ring.generators:
        if generator.kind == "symbol" and not generator.dots:
            found = known.of_generator(generator)
            if found is not None:
                units[generator.name] = of_parameter(found)
    return units


_OF_SEVERAL = {
    "its mass centre": "their mass centres",
    "the origin of its frame": "the origins of their frames",
    "its joint": "their joints",
    "its {axes}": "their {axes}",
}
"""What the words of one body are of several."""


def _as_one(role: AnyRole, places: Sequence[Meaning]) -> Meaning:
    """What a parameter is that may stand in several places: in two rows, of two bodies, about two axes."""
    places = [place for place in places if place.words] or places
    places = [place for place in places if not place.share] or places  # the inner radius, not half the outer
    first, *others = places
    if not others:
        return first
    axes = tuple(dict.fromkeys(axis for place in places for axis in place.axes))
    if all(replace(place, axes=first.axes) == first for place in others):
        return replace(first, axes=axes)
    alike = all(place.words == first.words and place.share == first.share for place in others)
    if role is Role.LENGTH:
        if alike and first.words.startswith("length of link "):
            links = [place.text().partition(",")[0].split()[-1] for place in places]
            return Meaning(f"length of links {and_joined(links)}", share=first.share)
        rows = sorted({place.link for place in places})
        return Meaning(f"length|lengths in rows {and_joined([str(row) for row in rows])} of the table")
    if role is Role.SHAPE and len({place.body for place in places}) == 1:
        return Meaning(and_joined([place.text() for place in places]))
    if alike and not first.link and all(place.axes == first.axes for place in others):
        bodies = and_joined([place.body for place in places])
        words = first.words.replace("body {body}", f"bodies {bodies}")
        for one, several in _OF_SEVERAL.items():
            words = words.replace(one, several)
        return Meaning(words, axes=axes, share=first.share)
    return Meaning(share=first.share if alike else _WITHIN if first.share else "")


# -- where parameters stand ------------------------------------------------------------------------


def _places(robot: Robot) -> Iterator[tuple[AnyRole, str, Meaning]]:
    """Where parameters stand, and what they are there; the strongest role first."""
    squared = sum((entry * entry for entry in robot.gravity.entries), start=robot.ring.zero)
    for entry in robot.gravity.entries:
        for name in names_in(entry):
            size = rational_sqrt(_factor(squared, name, 2))
            yield Role.GRAVITY, name, Meaning(share=_of_multiple(size) if size else "")
        yield from _untold(Role.DOWN, angles_in(entry))
    for joint in robot.joints:
        for name in _terms_of(joint.a):
            yield Role.LENGTH, name, _along_x(robot, joint, name)
        for name in _terms_of(joint.d):
            yield Role.LENGTH, name, _along_z(robot, joint, name)
        yield from _untold(Role.ANGLE, names_of(joint.theta), names_of(joint.alpha))
    for name, share, axis in _coordinates(robot.base_position):
        at = "{coordinates} of o{before} in the world"
        yield Role.BASE, name, Meaning(at, before=0, axes=(axis,), share=share)
    yield from _untold(Role.TURN, names_in_trees(*(angle for _, angle in robot.base_turns)))
    for body in robot.bodies:
        yield from _mass(body)
    for body in robot.bodies:
        yield from _inertia(body)
    for body in robot.bodies:
        if robot.has_table:
            yield from _center(robot, body)
        else:
            yield from _untold(Role.POSITION, *map(names_in, body.center.entries))
            yield from _untold(Role.DIRECTION, *map(angles_in, body.center.entries))
    acting = [
        (one.words, name, share)
        for one in (one for act in robot.actions.acts for one in act.parameters(robot) if one.words)
        for name, share in (_shares(one.value) if one.is_whole else ((n, "") for n in names_in(one.value)))
    ]
    users = Counter((words, name) for words, name, _ in acting)
    for words, name, share in acting:
        what, of, whose = words.partition(" of a|the ")
        own = agreeing(what, 1) + of[:4] + agreeing(whose, 2) if users[words, name] > 1 else ""
        yield Acting(words), name, Meaning(own, share=share)
    yield from _asked(robot)


def _untold(role: AnyRole, *names: Iterable[str]) -> Iterator[tuple[AnyRole, str, Meaning]]:
    """Parameters of which a role tells all that there is to say."""
    return ((role, name, Meaning()) for some in names for name in some)


def _asked(robot: Robot) -> Iterator[tuple[AnyRole, str, Meaning]]:
    """Where the parameters of what is asked stand: in forces, points, rates, a state, constraints."""
    questions = robot.questions
    exerted = [load for load in questions.loads if load.by_robot]
    loads = [load for load in questions.loads if not load.by_robot]
    of_exact = (
        (Role.FORCE, [load.force for load in loads]),
        (Role.MOMENT, [load.moment for load in loads]),
        (Role.EXERTED, [load.force for load in exerted]),
        (Role.EXERTED_MOMENT, [load.moment for load in exerted]),
        (Role.SPEED, [questions.velocity]),
        (Role.ACCELERATION, [questions.acceleration]),
    )
    for role, values in of_exact:
        entries = [entry for value in values if value is not None for entry in value.entries]
        yield from _untold(role, *map(_alone, entries))
    places = [(load.link, load.position) for load in questions.loads]
    for link, place in (*places, *((point.link, point.position) for point in questions.points)):
        for position in (place, _from_near_end(robot, link, place)):
            yield from _untold(Role.PLACE, *map(_alone, position.entries if position is not None else ()))
    for _, dots, formula in questions.state.values:
        yield from _untold(Role.RATE if dots else Role.STATE, _alone_in_tree(formula))
    for _, formula in questions.model.steady:
        yield from _untold(Role.STEADY, _alone_in_tree(formula))
    for _, _, formula in questions.model.linearize:
        yield from _untold(Role.STATE, _alone_in_tree(formula))
    for constraint in questions.constraints:
        yield from _untold(Role.CONSTRAINT, names_in_trees(constraint.entry))


# -- the table -------------------------------------------------------------------------------------


def _in_row(joint: Joint) -> Meaning:
    return Meaning("length|lengths in row {link} of the table", joint.index)


def _along_x(robot: Robot, joint: Joint, name: str) -> Meaning:
    """What a is: the length of a link where its d is zero, so that no way along z is added."""
    modified = robot.convention is Convention.MODIFIED
    factor = _factor(joint.a, name)
    if not factor:
        return _in_row(joint)
    children = sum(other.parent == joint.parent for other in robot.joints)
    if joint.d.is_zero and ((joint.parent and children == 1) or not modified):
        words = f"length of link {{{'before' if modified else 'link'}}}, from o{{before}} to o{{link}}"
    else:
        way = "along" if factor > 0 else "against"
        words = f"distance from z{{before}} to z{{link}}, {way} x{{{'before' if modified else 'link'}}}"
    return Meaning(words, joint.index, before=joint.parent, share=_of_multiple(factor))


def _along_z(robot: Robot, joint: Joint, name: str) -> Meaning:
    """What stands in d: alone, or beside a coordinate."""
    axis = "z{before}" if robot.convention is Convention.STANDARD else "z{link}"
    moved = [joint.d.ring.symbol(robot.coordinates[k].name) * rate for k, rate in joint.rates]
    rest = joint.d - sum(moved, joint.d.ring.zero) if joint.variable == "d" else joint.d
    factor = _factor(rest, name)
    share = _of_multiple(factor) if factor else ""
    if joint.variable == "d" and factor and len(rest) == 1:
        return Meaning("constant part of d in row {link} of the table", joint.index, share=share)
    if not factor:
        return _in_row(joint)
    if factor > 0 and joint.parent == 0 and _is_upright(robot):
        return Meaning("height of o{link} above o{before}", joint.index, "", 0, share=share)
    ends = "o{before} to o{link}" if joint.a.is_zero else "x{before} to x{link}"
    way = f"{'along' if factor > 0 else 'against'} {axis}"
    return Meaning(f"distance from {ends}, {way}", joint.index, "", joint.parent, share=share)


def _is_upright(robot: Robot) -> bool:
    """Whether z_0 points up, against gravity."""
    x, y, z = robot.gravity.entries
    return x.is_zero and y.is_zero and is_positive(-z) and not letters.has_base(robot)


# -- the bodies ------------------------------------------------------------------------------------


def _mass(body: Body) -> Iterator[tuple[AnyRole, str, Meaning]]:
    """The mass or the density, and the dimensions of a body with a density."""
    density = body.density
    if density is None:
        is_sum = len(body.mass) > 1
        shares = ((name, "part of the ") for name in _terms_of(body.mass)) if is_sum else _shares(body.mass)
        for name, share in shares:
            yield Role.MASS, name, Meaning("mass of body {body}", body=body.name, share=share)
        return
    yield from _sizes(body, density.shape)
    part = "" if isinstance(density.formula, Symbol) else "parameter of the "
    for name in names_in_trees(density.formula):
        yield Role.MASS, name, Meaning("density of body {body}", body=body.name, share=part)


def _sizes(body: Body, shape: Shape | None) -> Iterator[tuple[AnyRole, str, Meaning]]:
    for key, value in shape.dimensions if shape is not None else ():
        for name in names_in(value):
            yield Role.SHAPE, name, _dimension(body, key, value, name)


def _dimension(body: Body, key: str, value: Expr, name: str) -> Meaning:
    """A dimension of a shape, or its half: l is half the length of a rod that is 2 l long."""
    axes = (key,) if key in AXES else ()
    what = "side of body {body} along its {axes}" if axes else f"{DIMENSIONS[key]} of body {{body}}"
    return Meaning(what, body=body.name, axes=axes, share=dict(_shares(value)).get(name, _WITHIN))


def _inertia(body: Body) -> Iterator[tuple[AnyRole, str, Meaning]]:
    """The dimensions of a shape, or the entries of a given tensor."""
    rows = body.inertia.rows if body.inertia is not None else ()
    if body.shape is not None:
        yield from _sizes(body, body.shape)
        yield from _untold(Role.SHAPE, *(names_in(entry) for row in rows for entry in row))
        return
    point = {"center": "its mass centre", "origin": "the origin of its frame"}.get(body.about, "its joint")
    moment = Meaning(f"moment of inertia of body {{body}} about {{axes}} through {point}", body=body.name)
    product = replace(moment, words="product|products of inertia of body {body}")
    for i, row in enumerate(rows):
        for j, entry in enumerate(row):
            for name, share in _shares(entry):
                if i == j:
                    yield Role.INERTIA, name, replace(moment, axes=(AXES[i],), share=share)
                else:
                    yield Role.PRODUCT, name, replace(product, share=share)


def _center(robot: Robot, body: Body) -> Iterator[tuple[AnyRole, str, Meaning]]:
    """Where a mass centre is: so far from an end of its link, or by coordinates in its frame."""
    near = _from_near_end(robot, body.link, body.center)
    coordinates, of_near = list(_coordinates(body.center)), [] if near is None else list(_coordinates(near))
    at, start = "{coordinates} of the mass centre of body {body}, in frame {link}", -1
    link, before = body.link, robot.joints[body.link - 1].parent
    if body.drawn:
        drawn = Matrix.column(robot.ring, (value_of(robot.ring, entry) for entry in body.drawn.at))
        at, coordinates = "{coordinates} of the mass centre of body {body} as drawn", [*_coordinates(drawn)]
    elif len({name for name, *_ in of_near}) > len({name for name, *_ in coordinates}):
        coordinates, start = of_near, before
        at = "{coordinates} of the mass centre of body {body} from o{before}, in frame {link}"
    for name in dict.fromkeys(name for entry in body.center.entries for name in names_in(entry)):
        words = "distance from o{%s} to the mass centre of body {body}"
        if factor := _far_out(body.center, name):
            share = _of_multiple(factor)
            yield Role.CENTER, name, Meaning(words % "link", link, body.name, share=share)
        elif near is not None and (factor := _far_out(near, name)):
            share = _of_multiple(factor)
            yield Role.CENTER, name, Meaning(words % "before", link, body.name, before, share=share)
        else:
            for of, share, axis in coordinates:
                if of == name:
                    yield Role.CENTER, name, Meaning(at, link, body.name, start, axes=(axis,), share=share)


def _coordinates(place: Matrix) -> Iterator[tuple[str, str, str]]:
    """(parameter, what of its coordinate it is, axis) where a coordinate of a place is a multiple of it."""
    for axis, entry in zip(AXES, place.entries, strict=True):
        for name in names_in(entry):
            if factor := _factor(entry, name):
                yield name, "minus " * (factor < 0) + _of_multiple(factor), axis


def _from_near_end(robot: Robot, link: int, place: Matrix) -> Matrix | None:
    """A place in a link from the near end of this, o_{i-1}, along the axes of its frame.

    None in the modified convention, in which that end is the origin of the frame itself.
    """
    if robot.convention is Convention.MODIFIED:
        return None
    row, ring = robot.joints[link - 1], robot.ring
    across, along = row.d * ring.sin(row.alpha), row.d * ring.cos(row.alpha)
    return place + Matrix.column(ring, (row.a, across, along))


def _far_out(place: Matrix, name: str) -> Fraction:
    """How many times a parameter a place lies out on an axis; 0 where it does not."""
    far = [entry for entry in place.entries if not entry.is_zero]
    return _factor(far[0], name) if len(far) == 1 else Fraction(0)


def _factor(value: Expr, name: str, power: int = 1) -> Fraction:
    """Which multiple of a parameter, or of a power of it, a value is; 0 where it is none."""
    times = value.quotient(value.ring.symbol(name) ** power)
    return times.number if times is not None and times.is_number else Fraction(0)


def _alone(value: Expr) -> list[str]:
    """The parameter that a value is, or is the negative of."""
    return [name for name in names_in(value) if abs(_factor(value, name)) == 1]


def _shares(value: Expr) -> Iterator[tuple[str, str]]:
    """The only parameter of a value, and what of the value it is."""
    names = set(names_in(value))
    if len(names) == 1:
        (name,) = names
        inverse = value * value.ring.symbol(name)
        if factor := _factor(value, name):
            yield name, _of_multiple(factor)
        else:
            yield name, f"{_of_multiple(inverse.number)}inverse of the " if inverse.is_number else _WITHIN


_WITHIN = "in the "
"""What a parameter is of a value with other parameters, or in which it stands in another way."""


def _of_multiple(factor: Fraction) -> str:
    """What a parameter is of a multiple of it: k is half the stiffness 2k.

    >>> [_of_multiple(Fraction(factor)) for factor in ("-1", "2", "1/2", "3", "1/6")]
    ['', 'half the ', 'twice the ', '1/3 of the ', '6 times the ']
    """
    share = 1 / abs(factor)
    known = {Fraction(1): "", Fraction(1, 2): "half the ", Fraction(2): "twice the "}
    return known.get(share, f"{share} {'times' if share > 1 else 'of'} the ")


def _terms_of(value: Expr) -> list[str]:
    """The parameters that are a term of a value by themselves, whatever number stands before them."""
    ring, terms = value.ring, set(value.poly.monoms())
    return [name for name in names_in(value) if terms >= set(ring.symbol(name).poly.monoms())]


def _alone_in_tree(formula: Node) -> list[str]:
    """The same of a formula as it is written."""
    _, inner = split_sign(formula)
    return [inner.name] if isinstance(inner, Symbol) else []


# -- several in one line ---------------------------------------------------------------------------


def told_together(of: Sequence[tuple[str, Meaning]]) -> Iterator[tuple[list[str], str]]:
    """Names that are told by the same words, and these: with i where each name has its own number.

    x_1 and y_2 are not coordinates x and y of the mass centre of body i.
    """
    told: dict[tuple[str, object], list[tuple[str, Meaning]]] = {}
    for name, meaning in of:
        told.setdefault(_key(name, meaning), []).append((name, meaning))
    for (_, counted), alike in told.items():
        of_number: dict[str, dict[str, Meaning]] = {}
        for name, meaning in alike:
            of_number.setdefault(meaning.number, {})[name] = meaning
        axes = {tuple(sorted(one.axes for one in own.values())) for own in of_number.values()}
        is_counted = counted is True and len(of_number) > 1 and len(axes) == 1
        for own in [dict(alike)] if len(axes) == 1 else of_number.values():
            over = sorted({axis for meaning in own.values() for axis in meaning.axes})
            text = replace(next(iter(own.values())), axes=tuple(over)).text(is_counted)
            yield list(own), agreeing(text, 1 if is_counted else len(own))


def _key(name: str, meaning: Meaning) -> tuple[str, object]:
    """What names have in common that are told together."""
    axes = () if not meaning.axes or _names_axis(name, meaning.axes) else meaning.axes
    numbers = {part for group in split(name)[1] for part in (group, group.strip(ascii_letters))}
    if meaning.number and meaning.number in numbers:  # m_1 and l_c1 have 1, m_p has p
        return f"{meaning.share}{meaning.words} {axes}", True
    return f"{meaning.text()} {axes}", (meaning.link, meaning.body)


def _names_axis(name: str, axes: Iterable[str]) -> bool:
    """Whether a name tells its axis itself: x_1, I_1zz."""
    base, groups = split(name)
    known = {base, *(group.strip(digits) for group in groups)}
    return any(axis in known or 2 * axis in known for axis in axes)


# -- what uniform shapes and their dimensions are called in a sentence and in the formulas of their moments

SHAPES = {
    "box": "rectangular solid",
    "cylinder": "solid cylinder",
    "hollow_cylinder": "hollow cylinder",
    "rod": "slender rod",
    "disk": "thin disk",
    "sphere": "solid sphere",
    "shell": "thin spherical shell",
}

DIMENSIONS = {"radius": "radius", "length": "length", "outer": "outer radius", "inner": "inner radius"}
"""Their dimensions, by their keys in a file; those of a box are its sides along the axes."""


def shape_letters(robot: Robot) -> Mapping[str, Symbol]:
    """What each letter of the formulas of this robot's shapes is set as: another one where it is taken.

    It is taken by a name of the problem that looks like it, unless it means that in every formula.
    """
    names = {to_unicode(Symbol(name)): name for name in (*robot.parameters, *robot.ring.names)}
    found: dict[str, Symbol] = {}
    for letter, value in (pair for body in robot.bodies for pair in letters_of(body)):
        own = names.get(to_unicode(Symbol(letter)))
        if own is None or value == robot.ring.symbol(own):
            found.setdefault(letter, Symbol(letter))
        else:
            others = (Symbol(other) for other in (letter[0].upper() + letter[1:], f"{letter}s"))
            found[letter] = next(other for other in others if to_unicode(other) not in names)
    return found


def letters_of(body: Body) -> Iterator[tuple[str, Expr]]:
    """The letters of the formulas of a body's shape, and what they are here; of a point there are none."""
    if body.shape is not None and body.shape.formulas:
        yield MASS, body.mass
        yield from body.shape.letters


def angles_in(expr: Expr) -> Iterator[str]:
    """The symbols in the angles of a value."""
    for generator, degree in zip(expr.ring.generators, expr.poly.degrees(), strict=True):
        if degree > 0 and generator.kind in ("sin", "cos") and generator.angle is not None:
            yield from names_of(generator.angle)


def names_in(expr: Expr) -> Iterator[str]:
    """The symbols of a value."""
    for generator, degree in zip(expr.ring.generators, expr.poly.degrees(), strict=True):
        if degree > 0 and generator.kind == "symbol":
            yield generator.name
        elif degree > 0 and generator.kind == "inverse":
            yield from names_in(Expr(expr.ring, expr.ring.inverses[generator.index]))
