"""Steps that say once for all links, bodies or coordinates what a short model says one by one.

Of a long model nobody reads the Jacobian of each mass centre or the momentum of each
coordinate: the general formula stands for all of them, and the single steps are
details.  What the model is made of, the matrices of the rows, the last frame, the
tensors that are given, is shown in any case.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from itertools import groupby
from math import prod
from operator import itemgetter

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.rationals import fraction
from dynsolve.derivation.kinematics import origin, rotation
from dynsolve.document import Prose
from dynsolve.explain.actions import gravity_row
from dynsolve.explain.christoffel import SLOPES
from dynsolve.explain.context import Context
from dynsolve.explain.inertia import has_link_axes, is_moved
from dynsolve.explain.jacobian import ZERO, coordinate_column
from dynsolve.explain.kinematics import OUTWARDS
from dynsolve.explain.long_model.inertia_entry import kinetic_step
from dynsolve.explain.long_model.model import Change, LongModel, halves, product
from dynsolve.explain.matrix_factors import matrix_width
from dynsolve.explain.sanity.poses import at, turning_in
from dynsolve.explain.step import Detail, Line, Step
from dynsolve.explain.working.identities import said, used_in_product
from dynsolve.explain.writing import column_of, listed, side_by_side, spong
from dynsolve.notation import tree
from dynsolve.notation.build import cost
from dynsolve.notation.tree import (
    BigSum,
    Cross,
    Letter,
    Negative,
    Node,
    Number,
    Parenthesized,
    Product,
    Relation,
    Row,
    Sum,
    Symbol,
    Transpose,
    Words,
    column,
    equation,
)
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Body, Joint, JointType
from dynsolve.robot.questions import Method

_I, _J, _K = (Symbol(name) for name in "ijk")


@dataclass(frozen=True, slots=True)
class GeneralStep:
    """A step, and the ids of those in whose place it stands: they become its details."""

    step: Step
    details: frozenset[str]


def general_steps(context: Context) -> Iterator[GeneralStep]:
    """What is said once in the account of a long model."""
    robot = context.robot
    bodies = [body.name for body in robot.bodies]
    rows = [joint.index for joint in robot.joints]
    yield GeneralStep(_rows(context), _ids(["A"], rows) | _ids(["H"], rows[:-1]))
    if robot.moves_each_joint_alone:
        yield GeneralStep(_columns(context), _ids(["J"], [q.index for q in robot.coordinates]))
    if bodies and robot.has_table:
        solid = [body for body in robot.bodies if _is_plain(body)]
        yield GeneralStep(_mass_centers(context), _ids(["rc"], bodies))
        if solid:
            names = [body.name for body in solid]
            yield GeneralStep(_tensors(context, solid), _ids(["I_body", "R", "I"], names))
        yield GeneralStep(kinetic_step(context), _ids(["Jv", "v", "Kv", "Kw", "K"], bodies))
    if bodies:
        yield GeneralStep(_potential(context), _ids(["P"], bodies))
    if robot.has_dynamics and robot.questions.method is Method.LAGRANGE:
        coordinates = [q.index for q in robot.coordinates]
        yield GeneralStep(_forces(context), _ids(["dLdqd", "ddt", "dLdq", "tau"], coordinates))


def _ids(stems: Sequence[str], names: Sequence[str | int]) -> frozenset[str]:
    return frozenset(f"{stem}{name}" for stem in stems for name in names)


def _is_plain(body: Body) -> bool:
    """Whether a tensor is given about the mass centre, along the axes of the link's frame."""
    return has_link_axes(body) and not is_moved(body)


# -- kinematics and the Jacobian -------------------------------------------------------------------


def _rows(context: Context) -> Step:
    joints = context.robot.joints
    return Step(
        id="rows",
        stage=Stage.KINEMATICS,
        title="The rows of the table",
        why=("The matrix with the entries of each row.",),
        result=tuple(equation(letters.A(joint.index), context.form(f"A{joint.index}")) for joint in joints),
        together=True,
        detail=Detail.BRIEF,
        uses=(),
    )


def _columns(context: Context) -> Step:
    """J_i = [z × (o_n - o); z] of a revolute joint, [z; 0] of a prismatic one."""
    robot = context.robot
    which = letters.BEFORE if context.standard else _I
    z, o = (letters.bold(letter, which) for letter in "zo")
    arm = Parenthesized(Sum((letters.o(len(robot.joints)), Negative(o))))
    kinds = {
        JointType.REVOLUTE: ("revolute", column(Cross(z, arm), z)),
        JointType.PRISMATIC: ("prismatic", column(z, ZERO)),
    }
    present = [kind for kind in kinds if any(joint.type is kind for joint in robot.joints)]
    name = Letter("J", _I, style="bold")
    words = " The first is that of a revolute joint, the second that of a prismatic one."
    return Step(
        id="columns",
        stage=Stage.JACOBIAN,
        title="The columns of the Jacobian",
        why=(
            f"The velocity and the angular velocity of {context.end} at unit rate of joint i.",
            *((words,) if len(present) > 1 else ()),
        ),
        formula=side_by_side([equation(name, kinds[kind][1]) for kind in present]),
        source=spong("4.6.3"),
        detail=Detail.BRIEF,
        uses=("axes",),
    )


# -- the bodies ------------------------------------------------------------------------------------


def _mass_centers(context: Context) -> Step:
    robot = context.robot
    given = [
        equation(Letter("r", letters.rc(body).sub, Number(body.link), "bold"), context.show(body.center))
        for body in robot.bodies
    ]
    frame = Letter("r", Row((Words("c"), _I)), _I, "bold")
    ground = letters.R(robot, 1).sup
    turned = Product((Letter("R", _I, ground, "bold"), frame))
    center = Letter("r", Row((Words("c"), _I)), style="bold")
    return Step(
        id="rc",
        stage=Stage.INERTIA,
        title="Mass centres",
        why=("Each is given in the frame of its link and transformed to the base.",),
        formula=equation(center, Sum((turned, Letter("o", _I, style="bold")))),
        source=spong("2.6"),
        result=tuple(given),
        together=True,
        detail=Detail.BRIEF,
        uses=(),
    )


def _tensors(context: Context, bodies: Sequence[Body]) -> Step:
    rotation, tensor = Letter("R", _I, style="bold"), Letter("I", _I, style="bold")
    given = []
    for body in bodies:
        assert body.inertia is not None
        given.append(equation(letters.tensor(context.robot, body), context.show(body.inertia)))
    return Step(
        id="tensors",
        stage=Stage.INERTIA,
        title="Inertia tensors",
        why=(
            f"Each is given about the mass centre, along the axes of its link's frame; in {context.ground} "
            "coordinates it turns with the link.",
            *_off_the_diagonal(bodies),
        ),
        formula=side_by_side(
            [
                equation(rotation, Letter("R", _I, letters.R(context.robot, 1).sup, "bold")),
                equation(letters.base_tensor(_I), Product((rotation, tensor, Transpose(rotation)))),
            ]
        ),
        source=spong("7.2.1"),
        result=tuple(given),
        together=True,
        detail=Detail.BRIEF,
        uses=(),
    )


def _off_the_diagonal(bodies: Sequence[Body]) -> Prose:
    """The sign of the products of inertia, where there are any."""
    tensors = [body.inertia for body in bodies if body.inertia]
    if all(tensor[i, j].is_zero for tensor in tensors for i in range(3) for j in range(i)):
        return ()
    return (
        " An entry off the diagonal is minus the integral of the product of two coordinates over the mass.",
    )


# -- the energies and the forces -------------------------------------------------------------------


def _potential(context: Context) -> Step:
    rows = tuple(heights(context))
    center = Letter("r", Row((Words("c"), _I)), style="bold")
    down = Transpose(letters.GRAVITY)
    bodies = context.robot.bodies
    return Step(
        id="potentials",
        stage=Stage.ENERGY,
        title="Potential energy of each body",
        why=(
            "Minus the mass times ",
            Product((down, center)),
            "; ",
            letters.GRAVITY,
            " points down (",
            spong("7.2.3"),
            " writes a plus, for which the vector must point up).",
        ),
        formula=equation(Letter("P", _I), Negative(Product((Letter("m", _I), down, center)))),
        source=spong("7.2.3"),
        further=(equation(letters.GRAVITY, gravity_row(context)),),
        lines=rows,
        concluding=("So, each weight times the height of its mass centre:",) if rows else (),
        result=tuple(equation(letters.of_body("P", body), context.form(f"P{body.name}")) for body in bodies),
        listed=True,
        detail=Detail.BRIEF,
        uses=(),
    )


def _forces(context: Context) -> Step:
    """τ_k from ∂L/∂q̇_k, d/dt of it and ∂L/∂q_k, the products of rates collected; and friction."""
    n = context.robot.n
    coordinate, qk = Letter("q", _K), Letter("q", _K, dots=1)
    momentum = letters.partial_derivative(letters.L, qk)
    by_coordinate = letters.partial_derivative(letters.L, coordinate)
    height = letters.partial_derivative(letters.P, coordinate)
    accelerated = _sum_over(n, _J, Product((_d(_K, _J), Letter("q", _J, dots=2))))
    moving = _sum_over(n, _J, Product((_d(_K, _J, dots=1), Letter("q", _J, dots=1))))
    squares = _over_rates(n, letters.partial_derivative(_d(_I, _J), coordinate))
    coriolis = _over_rates(n, Letter("c", Row((_I, _J, _K))))
    resisted = (Letter("tau", Row((Words("f"), _K))),) if "friction" in context.values.rules else ()
    return Step(
        id="forces",
        stage=Stage.TORQUE,
        title="The generalized forces",
        why=("The same for every coordinate ", coordinate, "."),
        source=spong("7.3"),
        formula=equation(
            Letter("tau", _K),
            Sum((letters.time_derivative(momentum), Negative(by_coordinate), *resisted)),
        ),
        working=(
            equation(momentum, _sum_over(n, _J, Product((_d(_K, _J), Letter("q", _J, dots=1))))),
            equation(letters.time_derivative(momentum), Sum((accelerated, moving))),
            equation(by_coordinate, Sum((Product((letters.HALF, squares)), Negative(height)))),
        ),
        lines=(
            _rates_of_entries(n),
            Line(
                ("In the Christoffel symbols and the gravity terms",),
                (
                    side_by_side(
                        [
                            equation(Letter("c", Row((_I, _J, _K))), Product((letters.HALF, SLOPES))),
                            equation(Letter("g", _K), height),
                        ]
                    ),
                ),
            ),
        ),
        concluding=("the forces are",),
        result=(equation(Letter("tau", _K), Sum((accelerated, coriolis, *resisted, Letter("g", _K)))),),
        detail=Detail.BRIEF,
        uses=("L",),
    )


def _rates_of_entries(n: int) -> Line:
    """Σ_j ḋ_kj q̇_j as a sum over pairs of rates, the two slopes of each pair in one bracket."""
    slopes = [letters.partial_derivative(_d(_K, a), Letter("q", b)) for a, b in ((_J, _I), (_I, _J))]
    moving = _sum_over(n, _J, Product((_d(_K, _J, dots=1), Letter("q", _J, dots=1))))
    by: Prose = (
        "The chain rule gives the rates of ",
        _d(_K, _J),
        ". Each product of two rates then occurs twice in the sum, with ",
        *listed([_I, _J]),
        " exchanged, so each derivative may be replaced by half the sum of the two:",
    )
    both = Product((letters.HALF, _over_rates(n, Parenthesized(Sum(tuple(slopes))))))
    return Line(by, (equation(moving, _over_rates(n, slopes[0]), both),))


def _d(row: Node, col: Node, dots: int = 0) -> Letter:
    return Letter("d", Row((row, col)), dots=dots)


def _over_rates(n: int, factor: Node) -> BigSum:
    """Σ_i Σ_j factor · q̇_i q̇_j"""
    rates = (Letter("q", index, dots=1) for index in (_I, _J))
    return _sum_over(n, _I, _sum_over(n, _J, Product((factor, *rates))))


def _sum_over(n: int, index: Symbol, body: Node) -> BigSum:
    return BigSum(body, index, Number(1), Number(n))


# -- the last frame of a long chain, and the axes of the others ------------------------------------

LONGEST_ENTRY = 40
"""The operations in an entry of the Jacobian up to which three columns stand on a line or two."""


def frame_changes(model: LongModel) -> dict[str, Change]:
    """The changes by the ids of their steps."""
    last = len(model.context.robot.joints)
    return {
        f"H{last}": partial(last_frame, model),
        "axes": partial(axes, model),
        "J": partial(jacobian, model),
    }


def last_frame(model: LongModel, step: Step) -> Step:
    """The last frame by the matrices of the rows: the products of two halves, and the product of these."""
    context = model.context
    robot = context.robot
    assert isinstance(step.formula, Relation)
    inner, outer = halves(robot)
    end, half = outer[-1].index, inner[-1].index
    names = letters.H(robot, half), replace(letters.H(robot, end), sup=Number(half))
    (first, before), (second, after) = product(context, inner), product(context, outer)
    used = list(dict.fromkeys((*before, *after)))
    told = f"the two halves of the product, the second being frame {end} seen from frame {half}:"
    whole = used_in_product(context, first, second, context.values[f"H{end}"])
    return replace(
        step,
        why=step.why if step.why[: len(OUTWARDS)] == OUTWARDS else (*OUTWARDS, " ", *step.why),
        formula=equation(*step.formula.parts, Product(names)),
        working=(),
        lines=(
            Line(
                ("With ", *said(used), f", {told}") if used else (told.capitalize(),),
                (
                    equation(names[0], _rows_of_frame(context, inner), context.show(first)),
                    equation(names[1], _rows_of_frame(context, outer), context.show(second)),
                ),
            ),
        ),
        concluding=("With ", *said(whole), ", their product:") if whole else ("Their product:",),
        notes=(*step.notes, *((check,) if (check := at_zero_angles(context)) else ())),
    )


def _rows_of_frame(context: Context, rows: Sequence[Joint]) -> Node:
    """A_4 A_5 A_6, from the base on with the frame of the base before them."""
    matrices = [letters.A(row.index) for row in rows]
    if rows[0].parent == 0 and letters.has_base(context.robot):
        matrices = [letters.H(context.robot, 0), *matrices]
    return Product(tuple(matrices))


def axes(model: LongModel, step: Step) -> Step:
    """The frames on the way, which are not shown, by their products."""
    robot = model.context.robot
    if robot.is_tree or letters.has_base(robot):
        return step
    i = Symbol("i")
    frame = replace(letters.H(robot, 1), sub=i)
    product = Product((letters.A(1), Words("…"), Letter("A", i, style="bold")))
    before: Prose = ("Frame i is ", equation(frame, product), ". ")
    return replace(step, why=(*before, *step.why))


def jacobian(model: LongModel, step: Step) -> Step:
    """J_v by its columns, equal neighbours in one chain: all side by side are too wide for a page."""
    context = model.context
    J, last = context.matrix("Jv"), len(context.robot.joints)
    names = [coordinate_column(context, k, last, letters.o(last)) for k in range(model.n)]
    if None in names or max(cost(entry) for row in J.rows for entry in row) > LONGEST_ENTRY:
        return step
    columns = [(column_of(J, k), name[0]) for k, name in enumerate(names) if name]
    shown = []
    for value, equal in groupby(columns, itemgetter(0)):
        is_zero = all(row == (tree.ZERO,) for row in value.rows)
        shown.append(equation(*(name for _, name in equal), ZERO if is_zero else value))
    angular = [part for part in step.result if isinstance(part, Relation) and part.parts[0] == letters.JW]
    return replace(
        step,
        concluding=("The columns of ", letters.JV, " from the first to the last, and ", letters.JW, ":"),
        result=(side_by_side(shown), *angular),
    )


# -- a check of the last frame: where the end of the arm is with all joint angles 0, and in numbers


def at_zero_angles(context: Context) -> Prose:
    """To check: with all joint angles 0 the entries of o_6 are a₂ + a₃ = 0.4521, -d₃ = -0.15005 and so on.

    Nothing where an angle has no sine and cosine of its own.
    """
    ring, last = context.robot.ring, len(context.robot.joints)
    end = origin(context.values[f"H{last}"])
    turning = turning_in(context.robot, *end.entries)
    if not turning:
        return ()
    place = [at(ring, entry, dict.fromkeys(turning, 0)) for entry in end.entries]
    lengths = {name: value for name, text in context.lengths.items() if (value := _decimal(text)) is not None}
    known = all(_symbols(entry) <= lengths.keys() for entry in place)
    entries = [
        equation(*dict.fromkeys((context.show(entry), _shown(_value(entry, lengths)))))
        if known
        else context.show(entry)
        for entry in place
    ]
    unit = " (in m)." if known else "."
    return (
        "To check: with all joint angles 0 the entries of ",
        letters.o(last),
        " are ",
        *listed(entries),
        unit,
    )


def _decimal(text: str) -> Fraction | None:
    try:
        return Fraction(text)
    except ValueError:  # an angle in degrees, or a formula
        return None


def _symbols(expr: Expr) -> set[str]:
    """The names in a value without sines and cosines."""
    generators = expr.ring.generators
    return {generators[i].name for i, degree in enumerate(expr.poly.degrees()) if degree > 0}


def _value(expr: Expr, values: Mapping[str, Fraction]) -> Fraction:
    """The number that a value is."""
    names = [generator.name for generator in expr.ring.generators]
    total = Fraction(0)
    for powers, factor in expr.poly.to_dict().items():
        used = zip(names, map(int, powers), strict=True)
        total += fraction(factor) * prod(values[name] ** power for name, power in used if power)
    return total


def _shown(value: Fraction) -> Node:
    """A number with a decimal point."""
    size = Number(abs(value.numerator), value.denominator, decimal=value.denominator > 1)
    return Negative(size) if value < 0 else size


# -- the rows of rotations that give the heights of the mass centres of far links, where each fits a line

WIDEST = 80
"""The characters of a row up to which the rows are shown; wider ones would be a page of entries."""


def heights(context: Context) -> Iterator[Line]:
    """z₀ᵀ R of the links between the two frames that are shown, where gravity is along z₀."""
    robot = context.robot
    if robot.is_tree or not robot.has_table or letters.has_base(robot) or not _is_along_z0(robot.gravity):
        return
    inner, outer = halves(robot)
    shown = (1, inner[-1].index, outer[-1].index)  # the first row is its own frame
    between = [body for body in robot.bodies if body.link not in shown]
    rows = {body.link: _row(context, body) for body in between if _is_tilted(context, body)}
    if rows and all(matrix_width(context, row) <= WIDEST for row in rows.values()):
        named = tuple(equation(_name(context, link), row) for link, row in rows.items())
        yield Line(("The third rows of the rotations that give heights, where they were not shown:",), named)


def _is_along_z0(gravity: Matrix) -> bool:
    across = gravity.entries[0].is_zero and gravity.entries[1].is_zero
    return across and not gravity.entries[2].is_zero


def _is_tilted(context: Context, body: Body) -> bool:
    """Whether the height of a body off the origin of its frame changes as the frame turns."""
    ring, row = context.robot.ring, rotation(context.values[f"H{body.link}"]).rows[2]
    turned = any(not ring.diff(entry, k).is_zero for entry in row for k in range(context.robot.n))
    return turned and not body.center.is_zero


def _row(context: Context, body: Body) -> tree.Matrix:
    shown = context.show(Matrix.of(context.robot.ring, [rotation(context.values[f"H{body.link}"]).rows[2]]))
    assert isinstance(shown, tree.Matrix)
    return shown


def _name(context: Context, link: int) -> Node:
    """z₀ᵀ R"""
    return Product((Transpose(letters.z(0)), letters.R(context.robot, link)))
