"""The lines from ½ ωᵀ 𝓘 ω to the kinetic energy of rotation, along the axes in which they are short.

𝓘 = R I Rᵀ is the tensor along the axes of the base.  Where it varies with the configuration, ω is
brought to the body's own axes instead (`own_axes`), along which the tensor is the constant one that is given:
ωᵀ 𝓘 ω = (Rᵀ ω)ᵀ I (Rᵀ ω), and in the same way J_ωᵀ 𝓘 J_ω.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from dynsolve.algebra.compact.matrix_factor import matrix_factor
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.derivation.kinematics import rotation
from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.forms import is_numeric
from dynsolve.explain.step import Line
from dynsolve.explain.working.identities import (
    SILENT,
    Way,
    cancelled_in_product,
    chain,
    identities,
    said,
    used_in_product,
)
from dynsolve.explain.working.kinetic import collected, turned_name, without_signs
from dynsolve.explain.writing import block_of, is_small, sum_of
from dynsolve.notation import tree
from dynsolve.notation.build import factors_of, number_in_front, times
from dynsolve.notation.tree import ONE, ZERO, Letter, Node, Parenthesized, Product, Transpose, equation
from dynsolve.quantities import letters
from dynsolve.robot.model import Body, Robot


def along_own_axes(context: Context, body: Body) -> bool:
    """Whether the energy of a body is worked out along its own axes, without 𝓘; not of long arms.

    All bodies of an arm are treated alike: along their own axes, if that is the shorter way for one.
    Where the moments about all axes are equal, 𝓘 is known without any rotation.
    """
    if not context.is_short or not _is_turned(context, body):
        return False
    return any(_is_shorter(context, each) for each in context.robot.bodies if _is_turned(context, each))


def _is_turned(context: Context, body: Body) -> bool:
    """Whether a body turns, and the moments about its axes are not all equal."""
    if body.is_point or context.values[f"w{body.name}"].is_zero:
        return False
    return factor_of_identity(context.values[f"I_body{body.name}"]) is None


def factor_of_identity(tensor: Matrix) -> Expr | None:
    """a where a tensor is a E, the same about every axis; None for others."""
    a = tensor[0, 0]
    return a if tensor == Matrix.identity(a.ring, 3).scale(a) else None


def _is_shorter(context: Context, body: Body) -> bool:
    """Whether the tensor along the axes of the base takes longer than the given one, or varies."""
    values, b = context.values, body.name
    tensor, w = values[f"I{b}"], values[f"w{b}"]
    own = values[f"R{b}"].T @ w
    is_short = _terms_needed(w, tensor) <= _terms_needed(own, values[f"I_body{b}"])
    return not (is_short and _is_constant(context, tensor))


def _terms_needed(w: Matrix, tensor: Matrix) -> int:
    """The terms that wᵀ I w is made of: of the tensor, the entries that meet rows of w that are not zero."""
    turning = [k for k, row in enumerate(w.rows) if any(not entry.is_zero for entry in row)]
    met = sum(len(tensor[i, j]) for i in turning for j in turning)
    return met + sum(len(entry) for k in turning for entry in w.rows[k])


def _is_constant(context: Context, tensor: Matrix) -> bool:
    """Whether a tensor is the same in every configuration."""
    ring, count = context.robot.ring, context.robot.n
    return all(ring.diff(entry, k).is_zero for entry in tensor.entries for k in range(count))


def multiplied_out(context: Context, body: Body) -> tuple[Node, Way]:
    """K_ω = ½ [row] [tensor] [column] along the axes that are chosen, and the lines from there."""
    values, b = context.values, body.name
    base = values[f"w{b}"]
    if along_own_axes(context, body):
        w, tensor = values[f"R{b}"].T @ base, values[f"I_body{b}"]
    else:
        w, tensor = base, values[f"I{b}"]
    row, column, (front, inner) = context.show(w.T), context.show(w), _with_factor(context, tensor)
    product = Product((letters.HALF, *front, row, *([] if inner is None else [inner]), column))
    whole = equation(letters.energy_part("omega", body), product)
    return whole, _lines(context, body, w, tensor) if context.is_short else SILENT


def _with_factor(context: Context, tensor: Matrix) -> tuple[tuple[Node, ...], tree.Matrix | None]:
    """The factors that the moments share, and what is left of the tensor: of a multiple of E, nothing."""
    form, factor = context.show(tensor), factor_of_identity(tensor)
    assert isinstance(form, tree.Matrix)
    if factor is not None:
        return factors_of(number_in_front(context.show(factor))), None
    found = matrix_factor(context.forms.compactor.collector, form)
    return ((), form) if found is None else (factors_of(found[0]), found[1])


def _lines(context: Context, body: Body, w: Matrix, tensor: Matrix) -> Way:
    """½ Σ I_ij ω_i ω_j, and how it becomes the result."""
    value, result = context.values[f"Kw{body.name}"], context.form(f"Kw{body.name}")
    front, inner = _with_factor(context, tensor)
    terms = tuple(_terms(context, w, inner))
    if len(terms) < 2:
        return SILENT
    form = Product((letters.HALF, *front, sum_of(terms)))
    used = identities(value.ring, form, result)
    name = letters.energy_part("omega", body)
    return chain(
        value,
        [(("Multiplied out:",), form)],
        lambda tree: equation(name, tree),
        ("By ", *said(used), ":") if used else collected(form, result),
    )


def _terms(context: Context, w: Matrix, moments: tree.Matrix | None) -> Iterator[Node]:
    """I_ij ω_i ω_j; without a tensor, the squares alone."""
    for i in range(3):
        for j in range(i, 3):
            moment = (ONE if i == j else ZERO) if moments is None else moments.rows[i][j]
            if moment != ZERO and not (w[i, 0].is_zero or w[j, 0].is_zero):
                first, second = context.show(w[i, 0]), context.show(w[j, 0])
                rates = [(without_signs(first), 2)] if i == j else [(first, 1), (second, 1)]
                count = 1 if i == j else 2
                yield times(count, [(moment, 1), *rates], decimal=is_numeric(context.robot))


# -- ω, or the columns of J_ω, brought to a body's own axes: Rᵀ ω, by one product of matrices a line
# Where the base leans, its rotation is taken out first, as of a velocity: Rᵀ ω = ((R_0^w)ᵀ R)ᵀ (R_0^w)ᵀ ω,
# where (R_0^w)ᵀ R, the body's axes seen from frame 0, is made of the matrices of the table alone.


@dataclass(frozen=True, slots=True)
class Turned:
    """ω, or the columns of J_ω, along a body's own axes: the value, its name Rᵀ ω, how it comes about.

    `uses` names the rotation that the first line turns by.
    """

    value: Matrix
    name: Product
    lines: tuple[Line, ...]
    uses: str


def turned(context: Context, body: Body, quantity: str, letter: Letter) -> Turned:
    """Rᵀ ω or Rᵀ J_ω of a body: the quantity is `w` or `Jw`, the letter its name."""
    R, value = context.values[f"R{body.name}"], context.values[f"{quantity}{body.name}"]
    written, own = context.form(f"{quantity}{body.name}"), R.T @ value
    name = letters.of_body("R", body, "bold")
    whole, by_rotation = Product((Transpose(name), letter)), f"R{body.name}"
    if own == value:
        by: Prose = (name, " turns about the axis of ", letter, ", and leaves it as it is:")
        if quantity != "w":
            by = (name, " turns about the axis of the columns of ", letter, ", and leaves them as they are:")
        lines: tuple[Line, ...] = (Line(by, (equation(whole, letter),)),)
    elif leans(context.robot):
        by_rotation = "H0"
        lines = tuple(_by_frame_0(context, body, quantity, letter, written))
    else:
        by = ("Along the body's own axes", *_with(context, R, value), ":")
        product = Product((Transpose(context.form(f"R{body.name}")), written))
        lines = (Line(by, (equation(whole, product, context.show(own)),)),)
    return Turned(own, whole, lines, by_rotation)


def leans(robot: Robot) -> bool:
    """Whether frame 0 is turned in the world by more than quarter turns."""
    ring = robot.ring
    plain = (ring.zero, ring.one, -ring.one)
    return robot.has_table and any(entry not in plain for entry in robot.base_rotation.entries)


def _by_frame_0(context: Context, body: Body, quantity: str, letter: Letter, written: Node) -> Iterator[Line]:
    """(R_0^w)ᵀ ω, and from there along the body's axes, which are found once, with ω: a product a line."""
    base, R = rotation(context.values["H0"]), letters.of_body("R", body, "bold")
    value = context.values[f"{quantity}{body.name}"]
    seen, along = base.T @ context.values[f"R{body.name}"], base.T @ value
    own = context.show(seen.T @ along)
    axes, in_frame = (turned_name(context, 0, each) for each in (R, letter))
    whole = Product((Transpose(R), letter))
    first = Product((Transpose(block_of(context.matrix("H0"), 3, 0, 3)), written))
    by: Prose = ("Along the axes of frame 0", *_with(context, base, value))
    if seen.T @ along == along:
        given = f"v{body.name}" if quantity == "w" else f"Jv{body.name}#2"
        yield Line((*by, ":"), (equation(in_frame, first, own),), (given, "H0"))
        turned_back = Product((Transpose(Parenthesized(axes)), Parenthesized(in_frame)))
        yield _kept(context, body, quantity, equation(whole, turned_back, in_frame))
        return
    yield Line((*by, ":"), (equation(in_frame, first, context.show(along)),))
    if quantity == "w":
        yield _axes_seen(context, body, axes, seen)
    by = ("From there along the body's own axes, by ", axes, *_with(context, seen, along), ":")
    in_letters = Product((Transpose(Parenthesized(axes)), Parenthesized(in_frame)))
    second = Product((Transpose(context.show(seen)), context.show(along)))
    yield Line(by, (equation(whole, in_letters, second, own),), (_axes_label(body),))


def _kept(context: Context, body: Body, quantity: str, same: Node) -> Line:
    """That the rotation from frame 0 to the body's axes leaves ω, or the columns of J_ω, as they are."""
    axes = turned_name(context, 0, letters.of_body("R", body, "bold"))
    seen = rotation(context.values["H0"]).T @ context.values[f"R{body.name}"]
    this, what = ("this vector", "it as it is") if quantity == "w" else ("these columns", "them as they are")
    factors = _table_factors(context, body, seen)
    by: Prose = (axes, " turns")
    if factors is not None:
        H = (letters.H(context.robot, link) for link in (body.link, 0))
        by = (axes, " is the rotation of ", factors, ", as ", equation(next(H), Product((*H, factors))))
        by += (", and turns",)
    by += (f" about the axis of {this}, so its transpose leaves {what}. With ", *_identity(context), ":")
    rows = tuple(f"A{joint.index}" for joint in context.robot.path(body.link))
    return Line(by, (same,), (f"R{body.name}", *rows))


def _identity(context: Context) -> Prose:
    """What is put between the factors, so that each is seen from frame 0."""
    base = letters.R(context.robot, 0)
    return (Product((base, Transpose(base))), ", the identity, between the factors")


def _axes_label(body: Body) -> str:
    return f"R{body.name}-from-frame-0"


def _axes_seen(context: Context, body: Body, axes: Node, seen: Matrix) -> Line:
    """(R_0^w)ᵀ R with both matrices, and what it is: the body's axes seen from frame 0."""
    base, R = rotation(context.values["H0"]), context.form(f"R{body.name}")
    block = block_of(context.matrix("H0"), 3, 0, 3)
    members: list[Node] = [axes]
    if is_small(block, R):
        members.append(Product((Transpose(block), R)))
    by: Prose = ("The body's axes seen from frame 0", *_made_of(context, body, seen))
    by += (*_with(context, base, context.values[f"R{body.name}"]), ":")
    rows = tuple(f"A{joint.index}" for joint in context.robot.path(body.link))
    uses = ("H0", f"R{body.name}", *rows)
    return Line(by, (equation(*members, context.show(seen)),), uses, _axes_label(body))


def _made_of(context: Context, body: Body, seen: Matrix) -> Prose:
    """That the body's axes, seen from frame 0, are the rotation of A_1 A_2, where that is so."""
    factors = _table_factors(context, body, seen)
    return () if factors is None else (", the rotation of ", factors)


def _table_factors(context: Context, body: Body, seen: Matrix) -> Node | None:
    """A_1 A_2, where its rotation is that from frame 0 to the body's axes."""
    base, H = rotation(context.values["H0"]), context.values[f"H{body.link}"]
    factors = tuple(letters.A(joint.index) for joint in context.robot.path(body.link))
    if not factors or seen != base.T @ rotation(H):
        return None
    return Product(factors) if len(factors) > 1 else factors[0]


def _with(context: Context, R: Matrix, value: Matrix) -> Prose:
    """, with s₁² + c₁² = 1 (the terms with s₁ c₁ cancel)"""
    used = used_in_product(context, R.T, value, R.T @ value)
    named: Prose = (", with ", *said(used)) if used else ()
    return (*named, *cancelled_in_product(context, R.T, value))
