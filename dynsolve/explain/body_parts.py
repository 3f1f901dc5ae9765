"""What each body adds to D: m J_vᵀ J_v and J_ωᵀ 𝓘 J_ω, with this robot's matrices, multiplied out."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from dynsolve.algebra.matrix import Matrix
from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.step import Detail, Step
from dynsolve.explain.working.identities import Identity, said
from dynsolve.explain.working.kinetic import terms_needed
from dynsolve.explain.working.products import used_in_product
from dynsolve.explain.working.proved import MOST_JOINTS
from dynsolve.explain.writing import spong
from dynsolve.notation.tree import Node, Product, Transpose, equation
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


def _why(context: Context, body: Body) -> Prose:
    if body.is_point:
        return ("Its linear part, and none of rotation: it is a point.",)
    if context.values[f"Jv{body.name}"].is_zero:
        return ("Its rotational part alone: its mass centre does not move.",)
    return ("Its linear part and its rotational part.",)


def linear_name(context: Context, body: Body) -> Node:
    """m J_vᵀ J_v, in letters."""
    return Product((context.mass(body), letters.transposed_product(letters.jv(body))))


def angular_name(body: Body) -> Node:
    """J_ωᵀ 𝓘 J_ω, in letters."""
    return letters.transposed_product(letters.jw(body), letters.of_body("I", body, "script"))


def _results(context: Context, body: Body) -> Iterator[Node]:
    yield equation(linear_name(context, body), context.form(f"Dv{body.name}"))
    if not body.is_point:
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
    """J_ωᵀ 𝓘 J_ω along the axes in which it is shorter: those of the base, or of the body itself."""
    values, b = context.values, body.name
    J, R, tensor, given = values[f"Jw{b}"], values[f"R{b}"], values[f"I{b}"], values[f"I_body{b}"]
    own = R.T @ J
    if _is_constant(context, tensor) and terms_needed(J, tensor) <= terms_needed(own, given):
        return _Product(
            (_rotational(context, body, J, tensor),), _used(context, J, tensor), (f"Jv{b}", f"I{b}")
        )
    turned = Product((Transpose(letters.of_body("R", body, "bold")), letters.jw(body)))
    multiplied = Product((Transpose(context.form(f"R{b}")), context.form(f"Jw{b}")))
    used = used_in_product(context, R.T, J, own)
    why: Prose = (
        " In the axes of the body, with its own tensor, the rotational part is shorter: ",
        letters.jw(body),
        " is there ",
        turned,
        *((" (with ", *said(used), ")") if used else ()),
        ".",
    )
    working = (equation(turned, multiplied, context.show(own)), _rotational(context, body, own, given))
    return _Product(working, _used(context, own, given), (f"Jv{b}", f"R{b}", f"I_body{b}"), why)


def _is_constant(context: Context, tensor: Matrix) -> bool:
    """Whether a tensor is the same in every configuration."""
    ring, count = context.robot.ring, context.robot.n
    return all(ring.diff(entry, k).is_zero for entry in tensor.entries for k in range(count))


def _rotational(context: Context, body: Body, J: Matrix, tensor: Matrix) -> Node:
    return equation(angular_name(body), letters.transposed_product(context.show(J), context.show(tensor)))


def _used(context: Context, J: Matrix, tensor: Matrix) -> tuple[Identity, ...]:
    left = J.T @ tensor
    return tuple(used_in_product(context, left, J, left @ J))
