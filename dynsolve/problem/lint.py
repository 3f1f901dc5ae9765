"""Warnings about a problem file that has no errors but deserves a second look.

A check is a function from a `Reading` to places, each with what is odd there and what to do; adding one is
adding it to `CHECKS`.  Its name is the code of its findings.

Warnings that need the geometry of the robot: a rod beside its link, a moment left out, angles as drawn.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Sequence
from fractions import Fraction

from flint import fmpq_mat

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.factors import is_positive
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.rationals import rational
from dynsolve.algebra.ring import Expr
from dynsolve.algebra.ring_values import value_of
from dynsolve.errors import Finding
from dynsolve.notation.characters import split
from dynsolve.problem.bodies import ParsedTensor
from dynsolve.problem.cells import Cell
from dynsolve.problem.decoder import Record
from dynsolve.problem.reader import Reading, read_file, read_problem, read_whole
from dynsolve.problem.specification import PROBLEM
from dynsolve.problem.variation import FORMULA, TEXT, faulty_alternatives, scalars
from dynsolve.problem.yaml_nodes import MappingNode, Span
from dynsolve.robot.dimensions import Dimensions
from dynsolve.robot.geometry import Links, elementary
from dynsolve.robot.model import AxesKind, Body, Convention, Joint, JointType, Robot
from dynsolve.robot.shapes import AXES, KINDS
from dynsolve.robot.units import INERTIA, LENGTH, MASS, describe

Remark = tuple[Span, str, str]
"""Where something deserves a look, what it is, and what to do."""


# Warnings that need the geometry of the robot


def beside_its_link(reading: Reading) -> Iterator[Remark]:
    """A rod half-way along a link that it is not parallel to, though it is not across it either."""
    robot = reading.problem.robot
    links = _links(robot)
    for body, parsed in zip(robot.bodies, reading.parsed.bodies, strict=False):
        shape = body.density.shape if body.density else body.shape
        if shape is None or not KINDS[shape.kind].along_link or (body.density and body.density.begins):
            continue
        near, far = links.near_end(body.link), links.far_end(body.link)
        if far is None or not (body.center.scale(robot.ring.constant(2)) - near - far).is_zero:
            continue
        way = links.axes_in_link(body.axes, body.link).T @ (far - near)
        along = [axis for axis, entry in zip(AXES, way.entries, strict=True) if not entry.is_zero]
        if len(along) > 1 and shape.axis in along:
            message = (
                f"body {body.name} hangs in the air: link {body.link} leads along {' and '.join(along)} of "
                f"the body, and the {shape.kind} along {shape.axis} alone lies half-way between its ends"
            )
            help = (
                "give its centre where it is, center: {near: [x, y, z]}, one body for each part of the link, "
                "or axes that turn it into the way from joint to joint"
            )
            span = parsed.span_of("center")
            yield span, message, help


def left_out_moment(reading: Reading) -> Iterator[Remark]:
    """A moment that is left out, about an axis that the body turns about, and that is not 0 of any body.

    About an axis that all mass lies on the moment is 0, and those about the two others are equal.
    """
    for body, parsed in _bodies(reading):
        tensor: ParsedTensor | None = parsed["inertia"]
        if tensor is None or tensor.listed or body.inertia is None or body.inertia.is_zero:
            continue
        turning = _turning(reading.problem.robot, body)
        missing = [
            AXES[k]
            for k in range(3)
            if tensor.rows[k][k] is None
            and body.inertia[(k + 1) % 3, (k + 1) % 3] != body.inertia[(k + 2) % 3, (k + 2) % 3]
            and not all(entry.is_zero for entry in turning.rows[k])
        ]
        if missing:
            axes = " and ".join(missing)
            entries = ", ".join(f"{axis}{axis}: I{body.name}{axis}{axis}" for axis in missing)
            message = f"body {body.name} turns about its {axes} axis, too, where its inertia has no moment"
            help = f"add {entries}; a 0 that is meant is written {missing[0]}{missing[0]}: 0"
            yield tensor.span, message, help


def drawn_angles(reading: Reading) -> Iterator[Remark]:
    """A drawing whose joints stand at other angles than 0 of the table, from which they are counted."""
    normals = reading.parsed.normals
    if normals is None or normals.drawing.zero_is_drawn:
        return
    offset = [
        axis.coordinate
        for k, axis in enumerate(normals.drawing.axes)
        if not axis.slides and normals.all[k].x != normals.all[k + 1].x
    ]
    if offset:
        names = " and ".join(offset)
        given = "zero" in reading.fields
        message = (
            f"{names} {'is' if len(offset) == 1 else 'are'} not 0 as drawn: `zero: table` counts from θ = 0"
        )
        help = "write zero: drawn where the drawing is the pose in which all joints are at 0"
        span = reading.fields.span_of("zero") if given else reading.fields.key_span("axes")
        yield span, message, help


def _links(robot: Robot) -> Links:
    return Links(robot.ring, robot.convention, robot.joints)


def _turning(robot: Robot, body: Body) -> Matrix:
    """The angular velocity of a body along its own axes, 3×n: what each rate adds to it."""
    ring = robot.ring
    turning = Matrix.zero(ring, 3, robot.n)
    for turn in body.turns:
        turning = turn.rotation.T @ turning + turn.axis @ turn.rates
    links = _links(robot)
    z = Matrix.column(ring, (ring.zero, ring.zero, ring.one))
    for joint in robot.path(body.link) if body.link else ():
        rates = dict(joint.rates) if joint.variable == "theta" else {}
        rate = Matrix.of(ring, [[ring.constant(rates.get(k, Fraction(0))) for k in range(robot.n)]])
        about_z, about_x = elementary(ring, "z", joint.theta), elementary(ring, "x", joint.alpha)
        if links.modified:
            turning = about_z.T @ about_x.T @ turning + z @ rate
        else:
            turning = about_x.T @ (about_z.T @ turning + z @ rate)
    return turning if body.turns else links.axes_in_link(body.axes, body.link).T @ turning


_YAML_WORDS = ("null", "true", "false", "yes", "no", "on", "off")
_SHORTHAND = re.compile(r"[sc]_?([0-9_]+)")


def lint(path: str | os.PathLike[str]) -> tuple[Finding, ...]:
    """The findings about a file, in its order.

    Raises ProblemError where the file is faulty.
    """
    return lint_text(read_file(path), os.fspath(path))


def lint_text(content: str | bytes, file: str = "") -> tuple[Finding, ...]:
    r"""The findings about the text of a problem file; see `lint`.

    >>> [finding.code for finding in lint_text("dh: [{theta: q1*, a: l1}]\nvalues: {l2: 1}")]
    ['unused-value']
    """
    return remarks(read_whole(content, file))


def remarks(reading: Reading) -> tuple[Finding, ...]:
    """The findings about a file that was read."""
    found = [*reading.problem.warnings]
    for check in CHECKS:
        code = check.__name__.replace("_", "-")
        source = reading.faults.source
        found += [source.finding(*span, message, help, code) for span, message, help in check(reading)]
    if reading.variation is not None:
        found += faulty_alternatives(reading.variation, reading.faults.source, read_problem)
    return tuple(sorted(found, key=lambda finding: (finding.line, finding.column)))


def _symbols(reading: Reading) -> dict[str, Span]:
    """Every parameter with the place where it stands first."""
    coordinates = reading.parsed.table.names
    found: dict[str, Span] = {}
    for cell in sorted(reading.parsed.cells, key=lambda cell: cell.start):
        for name in cell.names:
            if name.name not in coordinates and cell.text:
                found.setdefault(name.name, cell.span_of(name))
    return found


def unused_value(reading: Reading) -> Iterator[Remark]:
    """A value or a unit for a symbol that does not occur."""
    robot = reading.problem.robot
    known = set(robot.parameters)
    for coordinate in robot.coordinates:
        known |= {coordinate.name, coordinate.velocity, coordinate.acceleration}
    known |= {name.name for cell in reading.parsed.questions.targeted for name in cell.names}
    for what in ("values", "units"):
        node = reading.fields.get(what)
        for key, _ in node.entries if isinstance(node, MappingNode) else ():
            if key.decoded not in known and _normal(key.decoded) not in known:
                message = f"{key.decoded} has {'a value' if what == 'values' else 'a unit'} but is not used"
                yield key.span, message, "delete it, or correct its spelling"


def _normal(name: str) -> str:
    from dynsolve.errors import ReadError
    from dynsolve.notation.characters import normalize

    try:
        return normalize(name)
    except ReadError:
        return name


def ambiguous_name(reading: Reading) -> Iterator[Remark]:
    """A parameter that reads as another thing in an answer: c1, s12, dq1, thetadot1."""
    meanings = _meanings(reading)
    subscripts = [split(name)[1] for name in reading.parsed.table.names]
    digits = {"".join(groups) for groups in subscripts if groups and "".join(groups).isdigit()}
    for name, span in _symbols(reading).items():
        meaning = meanings.get(name, "")
        shorthand = _SHORTHAND.fullmatch(name)
        if shorthand and _is_made_of(shorthand[1].replace("_", ""), digits):
            meaning = f"the {'sine' if name[0] == 's' else 'cosine'} of a joint angle"
        if meaning:
            message = f"in an answer {name} could also mean {meaning}"
            yield span, message, "give the parameter another name"


def _meanings(reading: Reading) -> dict[str, str]:
    """How students write the coordinates and their derivatives."""
    meanings: dict[str, str] = {}
    for index, coordinate in enumerate(reading.parsed.table.names, 1):
        base = split(coordinate)[0]
        rest = coordinate[len(base) :]
        for name in {coordinate, f"q{index}"}:
            for velocity in (f"d{name}", f"{name}dot", f"{name}_dot", f"{name}_d"):
                meanings[velocity] = f"the velocity of {coordinate}"
            for acceleration in (f"dd{name}", f"{name}ddot", f"{name}_ddot", f"{name}_dd"):
                meanings[acceleration] = f"the acceleration of {coordinate}"
        meanings[f"q{index}"] = f"the coordinate {coordinate}"
        for letter in {base, "q"}:
            tail = rest if letter == base else str(index)
            meanings[f"{letter}dot{tail}"] = meanings[f"{letter}d{tail}"] = f"the velocity of {coordinate}"
            meanings[f"{letter}ddot{tail}"] = meanings[f"{letter}dd{tail}"] = (
                f"the acceleration of {coordinate}"
            )
    return {name: meaning for name, meaning in meanings.items() if name not in reading.parsed.table.names}


def _is_made_of(digits: str, pieces: set[str]) -> bool:
    """Whether a string is a sequence of the pieces: 12 of 1 and 2."""
    return bool(digits) and any(
        digits == piece or (digits.startswith(piece) and _is_made_of(digits[len(piece) :], pieces))
        for piece in pieces
    )


def similar_names(reading: Reading) -> Iterator[Remark]:
    """Names that differ by an underscore, or of several letters by case alone."""
    first: dict[str, str] = {}
    for name in reading.parsed.table.names:
        first.setdefault(_folded(name), name)
    for name, span in _symbols(reading).items():
        other = first.setdefault(_folded(name), name)
        if other != name:
            message = f"{name} and {other} are hard to tell apart"
            help = "if they are the same, use one spelling; if not, rename one of them"
            yield span, message, help


def _folded(name: str) -> str:
    """Books have m and M, l1 and L1 side by side, but not lc1 and Lc1."""
    folded = name.replace("_", "")
    return folded.lower() if sum(map(str.isalpha, folded)) > 1 else folded


def yaml_word(reading: Reading) -> Iterator[Remark]:
    """A word that YAML knows as a value, which here is a symbol."""
    for name, span in _symbols(reading).items():
        if name.lower() in _YAML_WORDS:
            message = f"{name} is read as the name of a symbol"
            yield span, message, "leave the key out for its default"


def unstarred(reading: Reading) -> Iterator[Remark]:
    """A name in theta or d that looks like a joint variable, without its star."""
    for cell in (row.cells[column] for row in reading.parsed.table.rows for column in ("theta", "d")):
        for name in cell.names:
            if not name.star and split(name.name)[0] in ("theta", "q") and split(name.name)[1]:
                message = f"{name.name} has no star, so it is a constant"
                help = f"a joint variable is written {name.name}*"
                yield cell.span_of(name), message, help


def moves_no_mass(reading: Reading) -> Iterator[Remark]:
    """A coordinate that moves no body, a massless last link; some that move bodies by their sum alone."""
    robot = reading.problem.robot
    if reading.parsed.model is not None:
        yield from _moves_nothing(reading)
    if not robot.bodies or not robot.has_table or robot.actions.rotors:
        return
    moved = _motions(robot)
    idle = [q for q in robot.coordinates if not any(rates[q.index - 1] for rates in moved)]
    shared = [q for q in robot.coordinates if q not in idle and _rank(moved, q.index - 1) == _rank(moved)]
    for several in [*([q] for q in idle), *([shared] if shared else [])]:
        names = " and ".join(q.name for q in several)
        message = f"nothing that has mass moves with {names}: D is singular"
        help = "give a link after this joint a body, or leave the joint out"
        if several is shared:
            message = f"what has mass moves with {names} only together: D is singular"
            help = "give a link between these joints a body, or leave a joint out"
        joint, _ = robot.joints_of(several[0])[0]
        cell = reading.parsed.table.rows[joint.index - 1].cells[joint.variable or "d"]
        yield _span(reading, cell), message, help


def _motions(robot: Robot) -> list[list[Fraction]]:
    """What moves bodies, by the rates of the coordinates: joints, or several about one axis as one."""
    heavy = {body.link for body in robot.bodies if body.inertia or body.density or not body.mass.is_zero}
    carrying = {joint.index for link in heavy for joint in robot.path(link)}
    found: dict[int, list[Fraction]] = {}
    for joint in (joint for joint in robot.joints if joint.index in carrying):
        rates = [Fraction(0)] * robot.n
        if joint.parent not in heavy and _is_like_the_one_before(robot, joint):
            rates = found.pop(joint.parent)
        for k, rate in joint.rates:
            rates[k] += rate
        found[joint.index] = rates
    return list(found.values())


def _is_like_the_one_before(robot: Robot, joint: Joint) -> bool:
    """Whether a joint turns about the same axis as the one before it, or slides along a parallel one."""
    if not joint.parent or len(robot.links_after(joint.parent)) > 1:
        return False
    before = robot.joints[joint.parent - 1]
    between = joint if robot.convention is Convention.MODIFIED else before
    is_parallel = before.type is joint.type is not None and between.alpha == Angle.zero()
    return is_parallel and (between.a.is_zero or joint.type is JointType.PRISMATIC)


def _rank(motions: Sequence[Sequence[Fraction]], without: int = -1) -> int:
    """In how many independent ways bodies move; `without` a coordinate."""
    rows = [[rational(0 if k == without else rate) for k, rate in enumerate(rates)] for rates in motions]
    return int(fmpq_mat(rows).rank()) if rows else 0


def _moves_nothing(reading: Reading) -> Iterator[Remark]:
    """A coordinate of a model that moves no body, or whose rate stands nowhere in what is given."""
    robot, model = reading.problem.robot, reading.parsed.model
    for k, coordinate in enumerate(robot.coordinates):
        if model is not None and not _has_inertia(robot, k):
            message = f"nothing that has mass moves with {coordinate.name}: D is singular"
            help = "give a body a position that holds it, or leave it out"
            yield model.span, message, help


def _has_inertia(robot: Robot, k: int) -> bool:
    """Whether something that has mass moves with a coordinate of a model."""
    given = robot.given
    if given is not None:
        if given.D is not None:
            return not given.D[k, k].is_zero
        energies = [energy for energy in (given.K, given.L) if energy is not None]
        return any(not robot.ring.diff_velocity(energy, k).is_zero for energy in energies)
    heavy = [body for body in robot.bodies if not body.mass.is_zero]
    moved = any(not robot.ring.diff(entry, k).is_zero for body in heavy for entry in body.center.entries)
    turned = (turn for body in robot.bodies if body.inertia is not None for turn in body.turns)
    return moved or any(not turn.rates[0, k].is_zero for turn in turned)


def no_tool_row(reading: Reading) -> Iterator[Remark]:
    """A table in the modified convention that ends with a revolute joint: the last link has no length."""
    robot = reading.problem.robot
    if robot.ends_in_a_joint:
        joint, last = robot.number_of(robot.joints[-1]), len(robot.joints)
        message = (
            f"the table ends at joint {joint}, so H{last} and the Jacobian belong to a point on its axis"
        )
        help = "for the end of the arm, add a fixed row: {theta: 0, d: 0, a: l, alpha: 0} with its length"
        cell = reading.parsed.table.rows[-1].cells["theta"]
        yield _span(reading, cell), message, help


def _span(reading: Reading, cell: Cell) -> Span:
    return cell.span if cell.text else reading.fields.key_span("dh")


def ground_body(reading: Reading) -> Iterator[Remark]:
    """A body on a leading fixed row, which no joint moves."""
    robot = reading.problem.robot
    moving = [joint.index for joint in robot.joints if joint.variable]
    for body, parsed in _bodies(reading):
        if moving and body.link < moving[0]:
            message = f"link {body.link} belongs to the ground: no joint moves body {body.name}"
            yield parsed.span, message, f"the links that move are those from row {moving[0]} on"


def no_effect(reading: Reading) -> Iterator[Remark]:
    """A body with mass 0 and no inertia; a shape beside an inertia that wins over it."""
    for body, parsed in _bodies(reading):
        if body.mass.is_zero and body.inertia is None:
            message = f"body {body.name} has neither mass nor inertia"
            yield parsed.span, message, "delete it: links without a body are massless"
    for parsed in reading.parsed.bodies:
        if parsed["shape"] and parsed["inertia"]:
            message = f"the shape of body {parsed['name']} has no effect: its inertia is given"
            yield parsed.key_span("shape"), message, "delete one of them"


def unphysical(reading: Reading) -> Iterator[Remark]:
    """Moments that no body has: a negative one, or in numbers one larger than the sum of the others."""
    for body, parsed in _bodies(reading):
        if body.inertia is None:
            continue
        moments = [body.inertia[i, i] for i in range(3)]
        numbers = [moment.number for moment in moments if moment.is_number]
        what = ""
        if any(is_positive(-moment) for moment in moments):
            what = "one is negative"
        elif any(is_positive(-moment) for moment in _about_center(body)):
            what = "about the mass centre one is negative"
        elif len(numbers) == 3 and all(numbers) and 2 * max(numbers) > sum(numbers):
            what = "one is larger than the sum of the others"
        if what:
            message = f"body {body.name} cannot have these moments of inertia: {what}"
            yield parsed.span, message, "none may exceed the sum of the other two"


def _about_center(body: Body) -> Iterator[Expr]:
    """I - m d² of each moment that is given about another point, d its distance from the mass centre."""
    if body.about_point is None or body.inertia is None or body.axes.kind is not AxesKind.LINK:
        return
    offset = (body.axes.rotation.T @ (body.center - body.about_point)).entries
    square = sum((one * one for one in offset), start=body.mass.ring.zero)
    for i, along in enumerate(offset):
        if not body.inertia[i, i].is_zero:
            yield body.inertia[i, i] - body.mass * (square - along * along)


def _bodies(reading: Reading) -> Iterator[tuple[Body, Record]]:
    model = reading.parsed.model
    listed: Sequence[Record] = model.bodies if model else reading.parsed.bodies
    return zip(reading.problem.robot.bodies, listed, strict=True)


def unasked(reading: Reading) -> Iterator[Remark]:
    """A key that no answer is asked for which it is given for."""
    asked = {name.rstrip("0123456789") for name in reading.problem.robot.questions.asked}
    for key in PROBLEM.keys:
        if key.serves and key.name in reading.fields and asked.isdisjoint(key.serves):
            message = f"{key.name} is given, and nothing that it is for is asked for"
            help = f"ask for it in find: {', '.join(key.serves[:3])}"
            yield reading.fields.key_span(key.name), message, help


def not_positive(reading: Reading) -> Iterator[Remark]:
    """A length, a mass or a moment of inertia that may vary to 0 or below it."""
    robot = reading.problem.robot
    for part in reading.variation.numbers if reading.variation else ():
        name = _normal(part.path.removeprefix("values."))
        if name not in robot.parameters:
            continue
        dimension = Dimensions(robot.ring, robot).of(robot.ring.symbol(name))
        low = [text for text in part.alternatives if _NUMBER.fullmatch(text) and Fraction(text) <= 0]
        if dimension in (LENGTH, MASS, INERTIA) and low:
            yield part.told, f"{name} is {describe(dimension)}, and may be {low[0]}", "let it vary above 0"


def kept_letter(reading: Reading) -> Iterator[Remark]:
    """A letter that varies, in words that keep it: outside of dollar signs."""
    letters = reading.variation.letters if reading.variation else ()
    names = "|".join(re.escape(name) for name in letters if name not in _ENGLISH)
    words = [reading.fields.get(key) for key in ("title", "remarks", TEXT)] if names else []
    for start, end in (span for node in words if node is not None for span in scalars(node)):
        plain = FORMULA.sub(lambda found: " " * len(found[0]), reading.faults.source.text[start:end])
        for found in re.finditer(rf"(?<!\w)(?:{names})(?!\w)", plain):
            span = (start + found.start(), start + found.end())
            help = f"leave it out; in the formulas of `text`, ${found[0]}$, it is changed"
            yield span, f"{found[0]} varies, and these words keep it", help


def mixed_units(reading: Reading) -> Iterator[Remark]:
    """A length and an angle added as they are, along which a spring or a damper acts: x - theta."""
    robot, acting = reading.problem.robot, reading.parsed.acting
    records = (one for given in acting.given.values() for one in given) if acting else ()
    units = (robot.ring.one, -robot.ring.one)
    for cell in (one["of"] for one in records if isinstance(one, Record) and one["of"]):
        form = value_of(robot.ring, cell.tree)
        alone = [q for k, q in enumerate(robot.coordinates) if robot.ring.diff(form, k) in units]
        one_of_each = {q.type: q.name for q in alone}
        if len(one_of_each) > 1:
            length, angle = (one_of_each[kind] for kind in (JointType.PRISMATIC, JointType.REVOLUTE))
            message = f"{length} is a length and {angle} an angle, and cannot be added"
            yield cell.span, message, f"write r*{angle} for {angle}, with the radius r by which it moves"


_NUMBER = re.compile(r"[-+]?\d+(?:\.\d+|/0*[1-9]\d*)?")
_ENGLISH = ("a", "A", "I")
"""Letters that are words, too."""

CHECKS = (
    not_positive,
    kept_letter,
    unused_value,
    ambiguous_name,
    similar_names,
    yaml_word,
    unstarred,
    moves_no_mass,
    no_tool_row,
    ground_body,
    no_effect,
    unphysical,
    unasked,
    beside_its_link,
    left_out_moment,
    drawn_angles,
    mixed_units,
)
"""Every check, in no particular order."""
