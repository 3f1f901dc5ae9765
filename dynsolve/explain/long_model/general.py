"""Steps that say once for all links, bodies or coordinates what a short model says one by one.

Of a long model nobody reads the Jacobian of each mass centre or the momentum of each
coordinate: the general formula stands for all of them, and the single steps are
details.  What the model is made of, the matrices of the rows, the last frame, the
tensors that are given, is shown in any case.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from dynsolve.document import Prose
from dynsolve.explain.christoffel import SLOPES
from dynsolve.explain.context import Context
from dynsolve.explain.inertia import has_link_axes, is_moved
from dynsolve.explain.jacobian_columns import ZERO
from dynsolve.explain.long_model.body_jacobians import kinetic_step
from dynsolve.explain.long_model.heights import heights
from dynsolve.explain.potential import gravity_row
from dynsolve.explain.step import Detail, Line, Step
from dynsolve.explain.writing import listed, side_by_side, spong
from dynsolve.notation.tree import (
    BigSum,
    Cross,
    Letter,
    Negative,
    Node,
    Number,
    Parenthesized,
    Product,
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
from dynsolve.robot.model import Body, JointType
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
