"""D is positive definite: every block of coordinates that are coupled is.

An entry of the diagonal is the sum of what the bodies add to it, none of which is negative, so
that one body that always adds something is enough.  A block of several coordinates is definite
where its minors, from the first entry on or from the last, are positive (Sylvester's criterion).
Where that is not seen, the bodies are gone through: each has a kinetic energy that is not negative,
and if all of these vanish, the rates vanish one by one.
"""

from __future__ import annotations

from collections.abc import Sequence

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.forms import is_numeric
from dynsolve.explain.sanity.sign import is_positive, masses_and_moments
from dynsolve.explain.step import Step
from dynsolve.explain.working.identities import Identity, identities, said
from dynsolve.explain.writing import listed, spong
from dynsolve.notation.build import cost, times
from dynsolve.notation.tree import Negative, Node, Number, Power, Product, Row, Sum, Words, equation
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage

LONGEST = 60
"""The operations of a determinant up to which it is of use to a reader."""


def definite_step(context: Context) -> Step | None:
    """What shows that D is positive definite; None where that is not seen."""
    if context.robot.n < 2:
        return None
    found = _by_entries(context) or _by_bodies(context)
    if found is None:
        return None
    why, result = found
    square = equation(letters.transposed_product(letters.QD, letters.D), Product((Number(2), letters.K)))
    start: Prose = (
        "Since ",
        square,
        ", ",
        letters.D,
        " must be positive definite where masses and moments of inertia ",
    )
    return Step(
        id="definite",
        stage=Stage.VECTORIZED,
        title="Check: the inertia matrix is positive definite",
        why=(*start, "are positive. ", *why),
        source=spong("7.5.1"),
        result=result,
        is_task=False,
    )


def _by_entries(context: Context) -> tuple[Prose, tuple[Node, ...]] | None:
    """By the entries of the diagonal, and by minors where coordinates are coupled."""
    squares: list[Node] = []
    determinants: list[Node] = []
    used: dict[Identity, None] = {}
    for block in blocks(context.values["D"]):
        first = next((k for k in (block[0], block[-1]) if _is_sum_of_squares(context, k)), None)
        if first is None:
            return None
        squares.append(letters.entry("d", first + 1, first + 1))
        if len(block) > 1:
            minors = _minors(context, block if first == block[0] else block[::-1])
            if minors is None:
                return None
            determinants += minors
            used |= dict.fromkeys(_identities(context, block))
    verb = "is a sum" if len(squares) == 1 else "are sums"
    why: Prose = (*listed(squares), f" {verb} of masses and moments times squares, which never all vanish")
    if determinants:
        why += ("; entries between coordinates that are not coupled are zero",) if len(squares) > 1 else ()
        why += ("; and the determinant" + "s" * (len(determinants) > 1), " below ")
        why += ("are" if len(determinants) > 1 else "is", " positive, too (Sylvester's criterion)")
        why += ("; multiplied out, with ", *said(list(used)), ":") if used else (":",)
    else:
        why += (", and the other entries are zero.",)
    return why, tuple(determinants)


def _by_bodies(context: Context) -> tuple[Prose, tuple[Node, ...]] | None:
    """Body by body: its energy vanishes only where one rate more does."""
    robot, resting, lines = context.robot, set[int](), list[Node]()
    for body in sorted(robot.bodies, key=lambda body: body.link):
        D = context.values[f"Dv{body.name}"] + context.values[f"Dw{body.name}"]
        moving = [k for k in range(robot.n) if k not in resting and not D[k, k].is_zero]
        if len(moving) != 1:
            continue
        (k,) = moving
        factor = context.show(D[k, k])
        if _is_positive(context, factor):
            energy = Product((Number(2), letters.of_body("K", body)))
            square = Power(letters.velocity(robot.coordinates[k]), Number(2))
            value = times(1, [(factor, 1), (square, 1)], decimal=is_numeric(robot))
            lines.append(equation(energy, value))
            resting.add(k)
    if len(resting) < robot.n:
        return None
    why: Prose = (
        "No body has a negative kinetic energy, so where ",
        letters.K,
        " is 0, that of each body is. By the lines below the rates are then 0 one after the other; each "
        "line is written with those of the lines before it equal to 0:",
    )
    return why, tuple(lines)


def blocks(D: Matrix) -> list[list[int]]:
    """The coordinates by blocks: coupled ones, through others or at once, are in one."""
    found: list[list[int]] = []
    for i in range(D.shape[0]):
        coupled = [block for block in found if any(not D[i, j].is_zero for j in block)]
        merged = sorted([i, *(j for block in coupled for j in block)])
        found = [block for block in found if block not in coupled] + [merged]
    return sorted(found)


def _is_sum_of_squares(context: Context, k: int) -> bool:
    """Whether a body or the rotors surely add something to d_kk; nothing takes anything away."""
    parts = [f"D{kind}{body.name}" for body in context.robot.bodies for kind in "vw"]
    parts += ["Dm"] if context.robot.actions.motors else []
    return any(_is_positive(context, context.show(context.values[part][k, k])) for part in parts)


def _is_positive(context: Context, form: Node) -> bool:
    constant = frozenset(context.robot.ring.parameters)
    return is_positive(form, masses_and_moments(context.robot), constant)


def _minors(context: Context, block: Sequence[int]) -> list[Node] | None:
    """The determinants of the first two, three, ... coordinates of a block; None where a sign is not seen."""
    D = context.values["D"]
    found: list[Node] = []
    for size in range(2, len(block) + 1):
        places = sorted(block[:size])
        form = context.show(determinant([[D[i, j] for j in places] for i in places]))
        if cost(form) > LONGEST or not _is_positive(context, form):
            return None
        found.append(equation(_written(places), form))
    return found


def _identities(context: Context, block: Sequence[int]) -> tuple[Identity, ...]:
    """Those by which the determinant of two coupled coordinates becomes what is shown."""
    if len(block) != 2:
        return ()
    (a, b), D = block, context.values["D"]
    entries = [[D[i, j] for j in (a, b)] for i in (a, b)]
    product = Product((context.show(D[a, a]), context.show(D[b, b])))
    before = Sum((product, Negative(Power(context.show(D[a, b]), Number(2)))))
    return identities(context.robot.ring, before, context.show(determinant(entries))) or ()


def determinant(rows: Sequence[Sequence[Expr]]) -> Expr:
    """The determinant of a square matrix, by its first row."""
    if len(rows) == 1:
        return rows[0][0]
    total = rows[0][0].ring.zero
    for j, entry in enumerate(rows[0]):
        rest = [[*row[:j], *row[j + 1 :]] for row in rows[1:]]
        total = total + entry * determinant(rest) * (-1) ** j
    return total


def _written(places: Sequence[int]) -> Node:
    """d₁₁ d₂₂ - d₁₂², or det D where the block is more than two coordinates."""
    if len(places) == 2:
        (a, b), d = (i + 1 for i in places), letters.entry
        return Sum((Product((d("d", a, a), d("d", b, b))), Negative(Power(d("d", a, b), Number(2)))))
    return Row((Words("det "), letters.D))
