"""What each body adds to D: m J_vᵀ J_v and J_ωᵀ 𝓘 J_ω, with this robot's matrices; the sum."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from dynsolve.algebra.matrix import Matrix
from dynsolve.document import Prose
from dynsolve.explain.closing import WIDEST, matrix_width
from dynsolve.explain.context import Context
from dynsolve.explain.step import Detail, Step
from dynsolve.explain.working.derivatives import are_alike
from dynsolve.explain.working.identities import Identity, said
from dynsolve.explain.working.products import used_in_product
from dynsolve.explain.working.proved import MOST_JOINTS
from dynsolve.explain.working.rotational import along_own_axes, turned
from dynsolve.explain.writing import spong, sum_of
from dynsolve.notation.tree import ZERO, Node, Parenthesized, Product, equation
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Body

BESIDE = 2
"""Up to this number of coordinates the results of a body stand side by side."""


@dataclass(frozen=True, slots=True)
class _Product:
    """A product with this robot's matrices put in, and the identities by which it becomes what is shown."""

    working: tuple[Node, ...]
    used: tuple[Identity, ...]
    uses: tuple[str, ...]
    why: Prose = ()


def part_step(context: Context, body: Body) -> Step:
    """The contribution of one body to D; of short arms the products are shown, at the normal detail."""
    is_short = context.robot.n <= MOST_JOINTS
    products = tuple(_products(context, body)) if is_short else ()
    used = dict.fromkeys(identity for product in products for identity in product.used)
    concluding: Prose = ("Multiplied out, with ", *said(list(used)), ":") if used else ("Multiplied out:",)
    return Step(
        id=f"D_direct{body.name}",
        stage=Stage.VECTORIZED,
        title=f"What body {body.name} adds to the inertia matrix",
        why=(*_why(context, body), *(part for product in products for part in product.why)),
        source=spong("7.2.2"),
        working=tuple(node for product in products for node in product.working),
        concluding=concluding if products else (),
        result=tuple(_results(context, body)),
        together=context.robot.n <= BESIDE,
        uses=tuple(name for product in products for name in product.uses),
        detail=Detail.NORMAL if is_short else Detail.FULL,
        is_task=False,
    )


def sum_step(context: Context) -> Step | None:
    """D as the sum of what the bodies and the rotors add; None where one of them alone adds something."""
    parts = _summands(context)
    if len(parts) < 2:
        return None
    forms = [context.matrix(name) for name in parts]
    fits = sum(matrix_width(context, form) for form in forms) <= WIDEST
    same = context.values["D"] == context.values["D_direct"]
    who = "body" if len(context.robot.bodies) == 1 else "bodies"
    who += " and the rotors" if context.robot.actions.motors else ""
    adds = "adds" if who == "body" else "add"
    verdict = " is the " if same else " is not the "
    return Step(
        id="D_sum",
        stage=Stage.VECTORIZED,
        title="The sum of these matrices",
        why=(
            f"Summed up, what the {who} {adds}{verdict}",
            letters.D,
            f" read off above{', entry by entry' * same}.",
        ),
        source=spong("7.2.2"),
        result=(equation(letters.D, sum_of(forms)),) if fits else tuple(_summed_entries(context, parts)),
        listed=not fits,
        uses=(*(f"D_direct{body.name}" for body in context.robot.bodies), "Dm"),
        is_task=False,
    )


def _summands(context: Context) -> list[str]:
    """The quantities that D is the sum of, without those that are zero."""
    names = [part + body.name for body in context.robot.bodies for part in ("Dv", "Dw")]
    names += ["Dm"] * bool(context.robot.actions.motors)
    return [name for name in names if name in context.values.rules and not context.values[name].is_zero]


def _summed_entries(context: Context, parts: Sequence[str]) -> Iterator[Node]:
    """The entries of D to which several add: as a sum, and as they are read off."""
    D = context.matrix("D")
    for i in range(context.robot.n):
        for j in range(i, context.robot.n):
            entries = [context.matrix(name).rows[i][j] for name in parts]
            added = [entry for entry in entries if entry != ZERO]
            if len(added) > 1:
                names = dict.fromkeys(letters.entry("d", r + 1, c + 1) for r, c in ((i, j), (j, i)))
                plain, read_off = sum_of(added), D.rows[i][j]
                yield equation(*names, plain, *(() if are_alike(plain, read_off) else (read_off,)))


def _why(context: Context, body: Body) -> Prose:
    if body.is_point:
        return ("Its linear part, and none of rotation: it is a point.",)
    if context.values[f"Jv{body.name}"].is_zero:
        return ("Its rotational part alone: its mass centre does not move.",)
    if context.values[f"Jw{body.name}"].is_zero:
        return ("Its linear part alone: it does not turn.",)
    return ("Its linear part and its rotational part.",)


def linear_name(context: Context, body: Body) -> Node:
    """m J_vᵀ J_v, in letters."""
    return Product((context.mass(body), letters.transposed_product(letters.jv(body))))


def angular_name(body: Body) -> Node:
    """J_ωᵀ 𝓘 J_ω, in letters."""
    return letters.transposed_product(letters.jw(body), letters.base_tensor(letters.index_of(body.name)))


def _results(context: Context, body: Body) -> Iterator[Node]:
    values = context.values
    if body.is_point or not values[f"Jv{body.name}"].is_zero:
        yield equation(linear_name(context, body), context.form(f"Dv{body.name}"))
    if not (body.is_point or values[f"Jw{body.name}"].is_zero):
        yield equation(angular_name(body), context.form(f"Dw{body.name}"))


def _products(context: Context, body: Body) -> Iterator[_Product]:
    """The products that are more than a product with zeros."""
    if not context.values[f"Jv{body.name}"].is_zero:
        yield _linear(context, body)
    if not (body.is_point or context.values[f"Jw{body.name}"].is_zero):
        yield _angular(context, body)


def _linear(context: Context, body: Body) -> _Product:
    J = context.values[f"Jv{body.name}"]
    shown = context.show(J)
    product = Product((context.mass(body), letters.transposed_product(shown)))
    used = tuple(used_in_product(context, J.T, J, J.T @ J))
    return _Product((equation(linear_name(context, body), product),), used, (f"Jv{body.name}",))


def _angular(context: Context, body: Body) -> _Product:
    """J_ωᵀ 𝓘 J_ω along the axes that the energy was worked out in: the base's, or the body's own."""
    values, b = context.values, body.name
    J, tensor, given = values[f"Jw{b}"], values[f"I{b}"], values[f"I_body{b}"]
    if not along_own_axes(context, body):
        working = (_rotational(context, body, J, tensor),)
        return _Product(working, _used(context, J, tensor), (f"Jv{b}", f"I{b}"))
    own = turned(context, body, "Jw", letters.jw(body))
    why: Prose = (
        " Along the body's own axes the tensor is ",
        letters.tensor(context.robot, body),
        ", and ",
        letters.jw(body),
        *((" stays the same: the rotation is about its axis.",) if own.is_same else (" becomes ", own.name)),
        *own.why,
        *(() if own.is_same else (".",)),
    )
    in_letters = letters.transposed_product(Parenthesized(own.name), letters.tensor(context.robot, body))
    product = letters.transposed_product(context.show(own.value), context.show(given))
    lines = (own.working, equation(angular_name(body), in_letters, product))
    return _Product(lines, _used(context, own.value, given), (f"Jv{b}", f"R{b}", f"I_body{b}"), why)


def _rotational(context: Context, body: Body, J: Matrix, tensor: Matrix) -> Node:
    return equation(angular_name(body), letters.transposed_product(context.show(J), context.show(tensor)))


def _used(context: Context, J: Matrix, tensor: Matrix) -> tuple[Identity, ...]:
    left = J.T @ tensor
    return tuple(used_in_product(context, left, J, left @ J))
