"""What each body adds to D: m J_vᵀ J_v and J_ωᵀ 𝓘 J_ω, with this robot's matrices; the sum."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from msgspec.structs import replace

from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr
from dynsolve.document import Prose, Reference
from dynsolve.document.books import spong
from dynsolve.document.sentences import say
from dynsolve.explain.context import Context
from dynsolve.explain.matrix_factors import factored
from dynsolve.explain.named_steps import ending_of_several
from dynsolve.explain.step import Detail, Line, Step
from dynsolve.explain.working.column_products import of_columns
from dynsolve.explain.working.identities import (
    Identity,
    are_alike,
    by,
    cancelled_in_product,
    said,
    used_in_product,
)
from dynsolve.explain.working.rotational import (
    along_own_axes,
    angular_square,
    base_tensor,
    factor_of_identity,
    turned,
)
from dynsolve.explain.writing import name_of, sum_of
from dynsolve.notation.build import number_in_front
from dynsolve.notation.tree import ZERO, Node, Parenthesized, Product, equation
from dynsolve.quantities import letters
from dynsolve.robot.model import Body

BESIDE = 2
"""Up to this number of coordinates the results of a body stand side by side."""


def part_steps(context: Context, body: Body) -> Iterator[Step]:
    """What one body adds to D; of short arms the products are shown, at the normal detail.

    A product along the body's own axes is a step of its own, after that of the linear part.
    """
    step = _step(context, body)
    if not context.is_short:
        yield replace(step, uses=(), detail=Detail.FULL)
    elif _is_in_two(context, body):
        linear, angular = step.result
        columns = say(
            "Entry $i$, $j$ is the mass times the scalar product of columns $i$ and $j$ of {Jv}.",
            Jv=letters.jv(body),
        )
        yield _worked_out(context, body, _named_part(step, "linear", columns, linear), turns=False)
        own = (f"As for the rotational kinetic energy of {name_of(body)}.",)
        tensor = () if along_own_axes(context, body) else (f"Jv{body.name}#2", f"I{body.name}")
        step = replace(_named_part(step, "rotational", own, angular), id=f"Dw{body.name}", uses=tensor)
        yield _turned(context, body, step)
    else:
        yield _worked_out(context, body, step, turns=_turns(context, body))


def _is_in_two(context: Context, body: Body) -> bool:
    """Whether the rotational part is a step of its own: where it is turned, or the matrices are large."""
    if context.values[f"Jv{body.name}"].is_zero or not _turns(context, body):
        return False
    return along_own_axes(context, body) or context.robot.n > BESIDE


def _step(context: Context, body: Body) -> Step:
    """The contribution of one body, without the way there."""
    b, values = body.name, context.values
    moves, turns = not values[f"Jv{b}"].is_zero, _turns(context, body)
    why = "Its linear and its rotational part."
    if body.is_point:
        why = "Its linear part alone: it is a point."
    elif not moves:
        why = "Its rotational part alone: its mass centre does not move."
    elif not turns:
        why = "Its linear part alone: it does not turn."
    linear = (equation(linear_name(context, body), factored(context, context.named(context.form(f"Dv{b}")))),)
    angular = (
        (equation(angular_name(context, body), factored(context, context.named(context.form(f"Dw{b}")))),)
        if turns
        else ()
    )
    both = turns and not (along_own_axes(context, body) or _is_in_two(context, body))
    return Step(
        id=f"D_direct{b}",
        title=f"What body {b} adds to the inertia matrix",
        why=(why,),
        source=spong("7.2.2"),
        result=(*(linear if moves or body.is_point else ()), *angular),
        together=context.robot.n <= BESIDE,
        # into both products, where the second needs nothing but matrices put in; else into the first
        uses=(f"Jv{b}", f"I{b}") if both else (f"Jv{b}#1",) if moves else (),
        is_task=False,
    )


def _named_part(step: Step, part: str, why: Prose, result: Node) -> Step:
    return replace(step, title=f"{step.title}: the {part} part", why=why, result=(result,), together=False)


def _turns(context: Context, body: Body) -> bool:
    return not (body.is_point or context.values[f"Jw{body.name}"].is_zero)


def _turned(context: Context, body: Body, step: Step) -> Step:
    """The step with the product of the rotational part."""
    concluding = by("Multiplied out", _angular_used(context, body))
    return replace(step, lines=tuple(_angular_lines(context, body)), concluding=concluding)


def _worked_out(context: Context, body: Body, step: Step, turns: bool) -> Step:
    """The step with the products of this robot's matrices: the linear part, then the rotational one."""
    J = context.values[f"Jv{body.name}"]
    if J.is_zero:
        return _turned(context, body, step) if turns else step
    angular = tuple(_angular_lines(context, body)) if turns else ()
    angular_used = _angular_used(context, body) if turns else ()
    shown = Product((context.forms.mass(body), letters.transposed_product(context.show(J))))
    step = replace(step, working=(equation(linear_name(context, body), factored(context, shown)),))
    products = of_columns(context, body)
    if products is None:
        used = dict.fromkeys((*used_in_product(context, J.T, J, J.T @ J), *angular_used))
        cancelled = cancelled_in_product(context, J.T, J)
        return replace(step, lines=angular, concluding=by("Multiplied out", list(used), cancelled))
    words: Prose = ("By ", *said(products.used))
    words += (", and the numbers multiplied",) if _is_multiplied_in(context, body.mass, J.T @ J) else ()
    if turns:
        is_same = bool(angular_used) and set(angular_used) <= set(products.used)
        second = ("multiplied out, with the same:",) if is_same else by("multiplied out", angular_used)
        words += ("; the second product ", *second)
    if products.frame is not None:
        step = replace(step, working=(), uses=(f"H{products.frame}", f"Jv{body.name}#1"))
    return replace(step, lines=(*products.lines, *angular), concluding=words if turns else (*words, ":"))


def _is_multiplied_in(context: Context, mass: Expr, product: Matrix) -> bool:
    """Whether a mass is a number that does not stay in front of an entry: 0.5 l² is 0.5 times l²."""
    pairs = [
        (Product((context.show(mass), context.show(x))), context.show(mass * x)) for x in product.entries
    ]
    return mass.is_number and not all(are_alike(*pair) for pair in pairs)


def sum_step(context: Context) -> Step | None:
    """D as the sum of what the bodies and the rotors add; None where one of them alone adds something."""
    names = [part + body.name for body in context.robot.bodies for part in ("Dv", "Dw")]
    names += ["Dm"] * bool(context.robot.actions.rotors)
    parts = [name for name in names if name in context.values.rules and not context.values[name].is_zero]
    if len(parts) < 2:
        return None
    same = context.values["D"] == context.values["D_direct"]
    motors, bodies = bool(context.robot.actions.rotors), context.robot.bodies
    who = ("body" if len(bodies) == 1 else "bodies") + (" and the rotors" if motors else "")
    added = [f"{part}{b.name}" for b in bodies for part in ("D_direct", *["Dw"] * _is_in_two(context, b))]
    end = ending_of_several(context, "D_sum", tuple(_summed_entries(context, parts)))
    return Step(
        id="D_sum",
        title="The sum of these matrices",
        why=say(
            "Summed up, what the {who} {add} is{no} the $𝐃$ read off above{where}{so}.",
            who=who,
            add="adds" if who == "body" else "add",
            no="" if same else " not",
            where=Reference(("D",), ", "),
            so=", entry by entry" if same else "",
        ),
        source=spong("7.2.2"),
        result=end.result,
        names=end.names,
        listed=True,
        uses=(*added, "Dm"),
        is_task=False,
    )


def _summed_entries(context: Context, parts: Sequence[str]) -> Iterator[Node]:
    """The entries of D as sums of what is added to them, and as they are read off; then those that are 0."""
    D, n = context.matrix("D"), context.robot.n
    forms = [context.matrix(name).rows for name in parts]
    added = {(i, j): [rows[i][j] for rows in forms if rows[i][j] != ZERO] for i in range(n) for j in range(n)}
    for (i, j), entries in added.items():
        if entries and i <= j:
            names = dict.fromkeys(letters.entry("d", r + 1, c + 1) for r, c in ((i, j), (j, i)))
            plain, read_off = sum_of(entries), D.rows[i][j]
            yield equation(*names, plain, *(() if are_alike(plain, read_off) else (read_off,)))
    zero = [letters.entry("d", i + 1, j + 1) for (i, j), entries in added.items() if not entries]
    if zero:
        yield equation(*zero, ZERO)


def linear_name(context: Context, body: Body) -> Node:
    """m J_vᵀ J_v, in letters."""
    return Product((context.forms.mass(body), letters.transposed_product(letters.jv(body))))


def angular_name(context: Context, body: Body) -> Node:
    """J_ωᵀ 𝓘 J_ω, in letters."""
    return angular_square(context, body, letters.jw(body))


def _angular_lines(context: Context, body: Body) -> Iterator[Line]:
    """J_ωᵀ 𝓘 J_ω along the axes that the energy was worked out in: the base's, or the body's own."""
    values, b = context.values, body.name
    J, tensor, given = values[f"Jw{b}"], base_tensor(context, body), values[f"I_body{b}"]
    name = angular_name(context, body)
    if not along_own_axes(context, body):
        factor, shown = factor_of_identity(tensor), context.show(J)
        product = letters.transposed_product(shown, context.show(tensor))
        if factor is not None:
            product = Product((number_in_front(context.show(factor)), letters.transposed_product(shown)))
        yield Line((), (equation(name, factored(context, product)),))
        return
    own = turned(context, body, "Jw", letters.jw(body))
    first, *others = own.lines
    yield replace(first, uses=(f"Jv{b}#2", own.uses))
    yield from others
    in_letters = letters.transposed_product(Parenthesized(own.name), letters.tensor(context.robot, body))
    product = letters.transposed_product(context.show(own.value), context.show(given))
    yield Line(
        ("The tensor along the body's own axes put in:",),
        (equation(name, in_letters, factored(context, context.named(product))),),
        (f"I_body{b}",),
    )


def _angular_used(context: Context, body: Body) -> tuple[Identity, ...]:
    """The identities by which J_ωᵀ 𝓘 J_ω becomes what is printed."""
    values, b = context.values, body.name
    J, tensor = values[f"Jw{b}"], base_tensor(context, body)
    if along_own_axes(context, body):
        J, tensor = values[f"R{b}"].T @ J, values[f"I_body{b}"]
    left = J.T @ tensor
    return tuple(used_in_product(context, left, J, left @ J))
