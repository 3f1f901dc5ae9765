"""D is positive definite: every block of coordinates that are coupled is; or D has no inverse in any pose.

An entry of the diagonal is the sum of what the bodies add to it, none of which is negative, so
that one body that always adds something is enough.  A block of several coordinates is definite
where its minors, from the first entry on or from the last, are positive (Sylvester's criterion).
Where that is not seen, the bodies are gone through: each has a kinetic energy that is not negative,
and if all of these vanish, the rates vanish one by one.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import combinations

from dynsolve.algebra import matrix
from dynsolve.algebra.inequality import Bound
from dynsolve.algebra.linear_systems import blocks, part
from dynsolve.algebra.ring import Expr
from dynsolve.derivation.singular.inertia import (
    Place,
    is_of_a_body,
    is_of_no_body,
    of_parameters,
    some_without_inverse,
    without_inverse,
)
from dynsolve.document import Prose, Reference
from dynsolve.document.books import spong
from dynsolve.document.sentences import say
from dynsolve.explain.context import Context
from dynsolve.explain.inequalities import Inequalities
from dynsolve.explain.named_steps import looked_at
from dynsolve.explain.sanity.determinant import (
    MULTIPLIED_OUT,
    Determinant,
    determinant_of_two,
    is_positive,
    masses_and_moments,
    said_of,
    sure_terms,
)
from dynsolve.explain.step import Line, Step
from dynsolve.explain.working.squares import without_signs
from dynsolve.explain.writing import as_row, listed, side_by_side, sum_of
from dynsolve.notation.build import cost, times
from dynsolve.notation.tree import (
    ZERO,
    Function,
    Negative,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Relation,
    Sum,
    Symbol,
    equation,
    names_in,
    number,
)
from dynsolve.quantities import letters

LONGEST = 60
"""The operations of a determinant up to which it is of use to a reader."""

LONGEST_ENTRY = 8
"""The operations of an entry of the diagonal up to which it is written again."""


def is_definite(context: Context) -> bool:
    """Whether D is that of bodies, or of a given model and seen to be positive definite."""
    return context.robot.given is None or _by_entries(context) is not None


def definite_step(context: Context) -> Step | None:
    """What shows that D is positive definite, or always singular; None where neither is seen."""
    if any(is_of_no_body(context.values, body) for body in context.robot.bodies):
        return None
    is_matrix = context.robot.n > 1
    if is_matrix and (shown := _by_entries(context)) is not None:
        return shown
    seen = without_inverse(context.robot, context.values)
    return (_by_energies(context, seen) if is_matrix else None) or _singular(context, seen)


def _singular(context: Context, seen: list[Place] | None) -> Step | None:
    """That det D = 0 in every pose, or where it is seen to be 0, and what that means; None of any other."""
    rows = context.values["D"].rows
    value = matrix.determinant(context.values["D"])
    zero = next((i for i, row in enumerate(rows, 1) if all(entry.is_zero for entry in row)), 0)
    equal = next(((i, j) for (i, a), (j, b) in combinations(enumerate(rows, 1), 2) if a == b), (0, 0))
    moving, is_all = some_without_inverse(context.robot, value) if seen is None else (seen, True)
    places = [] if value.is_zero else [*_vanishing(context, value, moving)]
    if not (value.is_zero or places):
        return None
    reason, det = "In every pose {det}", _determinant(context, value)
    if places:
        follows = isinstance(det, Relation) and all(len(zeros) == 1 for zeros, _ in seen or ())
        reason = f"{'{det}, so ' * follows}$𝐃$ has no inverse{' at least' * (not is_all)} where {{places}}"
    elif zero:
        reason = "In every pose row {zero} of $𝐃$ is 0, so {det}"
    elif any(equal):
        reason = "In every pose rows {i} and {j} of $𝐃$ are equal, so {det}"
    is_sure = context.robot.given is None or (
        len(rows) == 2 and _is_positive(context, context.show(rows[0][0]))
    )
    is_else = is_sure and bool(seen) and all(bounds for _, bounds in seen or ())
    told = say(
        f"{reason}: some rates that are not 0 have no kinetic energy, and the forces do not determine all "
        f"accelerations.{' For other parameters $𝐃$ is positive definite.' * is_else}",
        det=det,
        zero=zero,
        i=equal[0],
        j=equal[1],
        places=listed(places, "or where"),
    )
    in_poses = names_in(as_row(listed(places))) & {*context.robot.ring.names}
    where = (" in some poses" if in_poses else " for some parameters") if places else ""
    return Step(
        id="definite",
        title=f"Check: the inertia matrix has no inverse{where}",
        why=told,
        source=spong("7.5.1"),
        outcome=told,
        is_task=False,
    )


def _vanishing(context: Context, value: Expr, moving: list[Place]) -> Iterator[Prose]:
    """Where D has no inverse: in some poses, or where R = r, of parameters that may be alike."""
    compare = Inequalities(context.robot).inequality
    for zeros, bounds in sorted(moving, key=lambda place: len(place[1])):
        equations = [equation(without_signs(context.show(zero)), ZERO) for zero in zeros]
        possible = say(", which is possible if {bounds}", bounds=listed([*map(compare, bounds)]))
        yield (*listed(equations), *(possible if bounds else ()))
    for factor in of_parameters(context.robot, value):
        yield (equation(*compare(Bound(factor)).parts),)


def _step(
    context: Context,
    why: Prose,
    lines: tuple[Line, ...] = (),
    concluding: Prose = (),
    *,
    by_energies: bool = False,
) -> Step:
    """The step; `by_energies` says that it rests on that no body's kinetic energy is negative."""
    robot, assumed = context.robot, context.robot.questions.model.assumed
    is_of_bodies = all(is_of_a_body(context.values, body) for body in robot.bodies if by_energies)
    bounds = side_by_side([*map(Inequalities(robot).inequality, assumed)])
    has_parameters = not names_in(context.form("D")).isdisjoint(robot.parameters)
    given, holds = (tensors * (not is_of_bodies) for tensors in _TENSORS)
    given = f"Let all parameters be positive{given}{', and {bounds}' * bool(assumed)}. "
    holds = f" for positive parameters{holds}{' with {bounds}' * bool(assumed)}"
    return Step(
        id="definite",
        title="Check: the inertia matrix is positive definite",
        why=say(f"{given * has_parameters}{{why}}", bounds=bounds, why=why),
        source=spong("7.5.1"),
        lines=lines,
        concluding=concluding,
        outcome=say(f"$𝐃$ is positive definite{holds * has_parameters}.", bounds=bounds),
        is_task=False,
    )


_TENSORS = ", and the tensors those of bodies", " and tensors of bodies"

_APART = " $𝐃$ consists of {parts}, not coupled with each other: each counts by itself."


def _by_entries(context: Context) -> Step | None:
    """By the entries of the diagonal, and by minors where coordinates are coupled."""
    firsts: list[int] = []
    determinants: list[Determinant] = []
    all_blocks = sorted(blocks(context.values["D"]))
    for block in all_blocks:
        first = _first(context, block)
        if first is None:
            return None
        firsts.append(first)
        if len(block) > 1:
            found = _minors(context, block if first == block[0] else block[::-1])
            if found is None:
                return None
            determinants += found
    why = _diagonal(context, firsts)
    by_energies = not all(_is_positive(context, context.show(context.values["D"][k, k])) for k in firsts)
    if not determinants:
        why = say("{why} All other entries are zero, so $𝐃$ is positive definite.", why=why)
        return _step(context, why, by_energies=by_energies)
    parts = listed([_block(context, block) for block in all_blocks])
    from_the_end = any(first != block[0] for first, block in zip(firsts, all_blocks, strict=True))
    several = len(determinants) > 1
    why = say(
        "{why}{apart} By Sylvester's criterion{where} it remains to show that {what} positive.",
        why=why,
        apart=say(_APART, parts=parts) if len(firsts) > 1 else "",
        where=", which may start from either end of the diagonal," if from_the_end else "",
        what="the determinants below are" if several else "the determinant below is",
    )
    lines = [each.differences for each in determinants if each.differences is not None]
    by = said_of(determinants)
    by = ("With these, ", *by) if lines else (f"{str(by[0])[0].upper()}{str(by[0])[1:]}", *by[1:])
    lines.append(Line((*by, ":"), tuple(each.line for each in determinants)))
    concluding = say(
        "In {last} no term is negative, and {least}. So $𝐃$ is positive definite.",
        last="the last expression of each" if several else "the last expression",
        least=listed([_never_zero(context, each.form) for each in determinants]),
    )
    return _step(context, why, tuple(lines), concluding, by_energies=by_energies)


def _first(context: Context, block: Sequence[int]) -> int | None:
    """The end of a block from which the minors go: one that is seen to be positive, if there is one."""
    ends = (block[0], block[-1])
    seen = (k for k in ends if _is_positive(context, context.show(context.values["D"][k, k])))
    return next(seen, next((k for k in ends if _own_part(context, k) is not None), None))


def _never_zero(context: Context, form: Node) -> Node:
    """I₁ I₂ > 0, a term of a sum that is positive in every pose; M + m s² ≥ M > 0, a factor of a product."""
    if isinstance(form, Sum):
        return Relation((_surest(context, _sure(context, form)), ZERO), (">",))
    factors = form.factors if isinstance(form, Product) else (form,)
    for factor in (each.argument if isinstance(each, Parenthesized) else each for each in factors):
        sure = _sure(context, factor)
        if isinstance(factor, Sum) and len(sure) < len(factor.terms):
            return Relation((factor, _surest(context, sure), ZERO), ("≥", ">"))
    return Relation((form, ZERO), (">",))


def _sure(context: Context, form: Node) -> list[Node]:
    """The terms of a sum that are positive in every pose, or two that are not 0 at once."""
    known = masses_and_moments(context.robot), frozenset(context.robot.ring.parameters)
    return sure_terms(form, *known) if isinstance(form, Sum) else []


def _surest(context: Context, sure: Sequence[Node]) -> Node:
    """The shortest of the terms that are positive; two that are not 0 at once together."""
    return min(sure, key=cost) if _is_positive(context, sure[0]) else sum_of(sure)


def _diagonal(context: Context, places: Sequence[int]) -> Prose:
    """Why entries of the diagonal are positive: seen from them, or from what one body adds to them."""
    is_seen = {k: _is_positive(context, context.show(context.values["D"][k, k])) for k in places}
    seen = listed([_least(context, k) for k in places if is_seen[k]])
    by_body = {k: _own_part(context, k) for k in places if not is_seen[k]}
    names = {k: letters.entry("d", k + 1, k + 1) for k in by_body}
    where = Reference(looked_at(context, "D", [context.result("D")]), " in ")
    why = say("On the diagonal of $𝐃${where}, {seen}.", where=where, seen=seen) if seen else ()
    if not by_body:
        return why
    return say(
        "{why}{space}No body adds anything negative to $d_ii$, which is $2 𝒦$ where $q̇_i = 1$ and the other "
        "rates are 0. {names}{where} {are} positive: {adding}.",
        why=why,
        space=" " if seen else "",
        names=listed([*names.values()]),
        where="" if seen else where,
        are="is" if len(by_body) == 1 else "are",
        adding=listed([(*part, " to ", names[k]) for k, part in by_body.items() if part is not None]),
    )


def _least(context: Context, k: int) -> Node:
    """d_kk ≥ I > 0, where other terms may be 0; d_kk = m l² + I > 0, where none may and it is short."""
    name, form = letters.entry("d", k + 1, k + 1), context.show(context.values["D"][k, k])
    sure = _sure(context, form)
    if isinstance(form, Sum) and 0 < len(sure) < len(form.terms):
        return Relation((name, sum_of(sure), ZERO), ("≥", ">"))
    if cost(form) <= LONGEST_ENTRY:
        return Relation((name, form, ZERO), ("=", ">"))
    if sure:
        return Relation((name, _surest(context, sure), ZERO), (">", ">"))
    return Relation((name, ZERO), (">",))


def _block(context: Context, block: Sequence[int]) -> Prose:
    """d₁₁, or the 2×2 block of θ₂ and θ₃"""
    if len(block) == 1:
        return (letters.entry("d", block[0] + 1, block[0] + 1),)
    names = [Symbol(context.robot.coordinates[k].name) for k in block]
    return (f"the {len(block)}×{len(block)} block of ", *listed(names))


def _by_energies(context: Context, seen: list[Place] | None) -> Step | None:
    """Body by body: its energy vanishes only where one rate more does; or all at once, by the rank."""
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
            rate = letters.velocity(robot.coordinates[k])
            value = times(1, [(factor, 1), (rate, 2)], decimal=robot.has_decimals)
            lines.append(equation(energy, value))
            resting.add(k)
    is_by_lines = len(resting) == robot.n
    if not is_by_lines and seen != []:
        return None
    if robot.given is not None:
        return _step(context, say(_SIGNS, det=_determinant(context, matrix.determinant(context.values["D"]))))
    why = say(
        "$𝐪̇ᵀ 𝐃 𝐪̇ = 2 𝒦$, and no body{rotor} has a negative kinetic energy: where their sum is 0, each of "
        f"them is 0. {_LINE_BY_LINE if is_by_lines else _BY_RANK}",
        rotor=" and no rotor" if robot.actions.rotors else "",
        n=robot.n,
    )
    concluding = say("So $𝐪̇ᵀ 𝐃 𝐪̇ = 0$ at rest alone: $𝐃$ is positive definite.")
    shown = (Line((), tuple(lines)),) if is_by_lines else ()
    return _step(context, why, shown, concluding, by_energies=True)


_LINE_BY_LINE = (
    "In each line the rates of the lines before are 0, so that it is 0 only where its own rate is:"
)
_BY_RANK = (
    "The velocities that have an inertia are all 0 only at rest: the matrix that makes them of the rates has "
    "rank {n} in every configuration."
)
_SIGNS = (
    "{det} is 0 in no configuration, so that no eigenvalue of $𝐃$ changes its sign, and in some "
    "configuration all are positive. So $𝐃$ is positive definite."
)


def _determinant(context: Context, value: Expr) -> Node:
    """det D, and by its factors what it is where that is of use."""
    form = context.forms.products.form(value, apart=True)
    return equation(letters.DET_D, form) if cost(form) <= LONGEST else letters.DET_D


def _own_part(context: Context, k: int) -> tuple[str, Node] | None:
    """A body, or the rotors, that surely add something to d_kk, and what; nothing takes anything away."""
    parts = [
        (f"body {body.name} adds ", context.values[f"Dv{body.name}"] + context.values[f"Dw{body.name}"])
        for body in context.robot.bodies
    ]
    parts += [("the rotors add ", context.values["Dm"])] if context.robot.actions.rotors else []
    shown = ((who, context.show(added[k, k])) for who, added in parts)
    return next(((who, form) for who, form in shown if _is_positive(context, form)), None)


def _is_positive(context: Context, form: Node) -> bool:
    constant = frozenset(context.robot.ring.parameters)
    return is_positive(form, masses_and_moments(context.robot), constant)


def _minors(context: Context, block: Sequence[int]) -> list[Determinant] | None:
    """The determinants of the first two, three, ... coordinates of a block; None where a sign is not seen."""
    D = context.values["D"]
    found: list[Determinant] = []
    for size in range(2, len(block) + 1):
        places = tuple(sorted(block[:size]))
        value = matrix.determinant(part(D, places, places))
        form = _by_sine(context.show(value))
        if cost(form) > LONGEST or not _is_positive(context, form):
            return None
        if size == 2:
            found.append(determinant_of_two(context, (places[0], places[1]), value, form))
        else:
            found.append(Determinant(equation(letters.DET_D, form), form, (MULTIPLIED_OUT,)))
    return found


def _by_sine(form: Node) -> Node:
    """A factor a - b c² in numbers as a - b + b s², which has no minus where a > b; all else as it is.

    >>> from dynsolve.notation.unicode import to_unicode
    >>> cosine = Power(Function("cos", Symbol("q")), Number(2))
    >>> to_unicode(_by_sine(Sum((Number(5), Negative(Product((Number(2), cosine)))))))
    '3 + 2sin²(q)'
    """
    match form:
        case Product(factors):
            return Product(tuple(map(_by_sine, factors)))
        case Parenthesized(argument):
            return Parenthesized(_by_sine(argument))
        case Sum((Number() as a, Negative(Power(Function("cos"), Number(2, 1)) as square))):
            return _by_sine(Sum((a, Negative(Product((Number(1), square))))))
        case Sum(
            (Number() as a, Negative(Product((Number() as b, Power(Function("cos", angle), Number(2, 1))))))
        ):
            rest = Fraction(a.p, a.q) - Fraction(b.p, b.q)
            return Sum((number(rest), times(Fraction(b.p, b.q), [(Function("sin", angle), 2)])))
    return form
