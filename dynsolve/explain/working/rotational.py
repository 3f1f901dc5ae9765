"""The lines from ½ ωᵀ 𝓘 ω to the kinetic energy of rotation, along the axes in which they are short.

Where ω is always parallel to an axis of the body, the moment about it is enough (`turning_axis`).  Else
𝓘 = R I Rᵀ is the tensor along the axes of the base.  Where it varies with the configuration, ω is
brought to the body's own axes instead (`along_own_axes`), along which the tensor is the constant one that is
given: ωᵀ 𝓘 ω = (Rᵀ ω)ᵀ I (Rᵀ ω), and in the same way J_ωᵀ 𝓘 J_ω.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations_with_replacement

from msgspec import Struct

from dynsolve.algebra.compact.collect import matrix_factor
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr
from dynsolve.document.sentences import say
from dynsolve.explain.context import Context
from dynsolve.explain.step import Line
from dynsolve.explain.working.identities import (
    SILENT,
    Way,
    chain,
    collected,
    identities,
    product_line,
    said,
)
from dynsolve.explain.working.squares import turn_of_frame, turned_name, without_signs
from dynsolve.explain.writing import sum_of
from dynsolve.notation import tree
from dynsolve.notation.build import factors_of, number_in_front, times
from dynsolve.notation.template import formula
from dynsolve.notation.tree import ONE, ZERO, Entry, Letter, Node, Product, Transpose, Words, equation
from dynsolve.quantities import letters
from dynsolve.robot.model import Body, Robot


def turning_axes(context: Context, body: Body) -> list[int]:
    """The axes of a body along which 𝛚 has components: the rows of Rᵀ J_ω that are not 0."""
    own = context.values[f"R{body.name}"].T @ context.values[f"Jw{body.name}"]
    return [k for k, row in enumerate(own.rows) if not all(entry.is_zero for entry in row)]


def turning_axis(context: Context, body: Body) -> int | None:
    """The axis of a body that 𝛚 is always parallel to: of the tensor the moment about it alone enters."""
    axes = [] if body.is_point else turning_axes(context, body)
    return axes[0] if len(axes) == 1 else None


def along_own_axes(context: Context, body: Body) -> bool:
    """Whether the energy of a body is worked out along its own axes, without 𝓘.

    All bodies of an arm are treated alike: along their own axes, if that is the shorter way for one.
    Where the moments about all axes are equal, 𝓘 is known without any rotation.
    """
    if not _is_turned(context, body):
        return False
    return any(_is_shorter(context, each) for each in context.robot.bodies if _is_turned(context, each))


def _is_turned(context: Context, body: Body) -> bool:
    """Whether a body turns, about no one of its axes, and the moments about these are not all equal."""
    if body.is_point or len(turning_axes(context, body)) < 2:
        return False
    return factor_of_identity(context.values[f"I_body{body.name}"]) is None


def factor_of_identity(tensor: Matrix) -> Expr | None:
    """a where a tensor is a E, the same about every axis; None for others."""
    a = tensor[0, 0]
    return a if tensor == Matrix.identity(a.ring, 3).scale(a) else None


def _is_shorter(context: Context, body: Body) -> bool:
    """Whether the tensor along the axes of the base takes longer than the given one, or varies."""
    ring, n, (tensor, w) = context.robot.ring, context.robot.n, _in_axes(context, body, own=False)
    if any(not ring.diff(entry, k).is_zero for entry in tensor.entries for k in range(n)):
        return True
    own_tensor, own = _in_axes(context, body, own=True)
    return _terms_needed(w, tensor) > _terms_needed(own, own_tensor)


def _in_axes(context: Context, body: Body, *, own: bool) -> tuple[Matrix, Matrix]:
    """The tensor and ω along the body's own axes, or those of the base."""
    values, b = context.values, body.name
    if own:
        return values[f"I_body{b}"], values[f"R{b}"].T @ values[f"w{b}"]
    return base_tensor(context, body), values[f"w{b}"]


def base_tensor(context: Context, body: Body) -> Matrix:
    """𝓘; where ω is always parallel to an axis of the body, the moment about that times the identity."""
    axis = turning_axis(context, body)
    name = f"I{body.name}" if axis is None else f"I_body{body.name}"
    tensor: Matrix = context.values[name]
    return tensor if axis is None else tensor.identity(tensor.ring, 3).scale(tensor[axis, axis])


def angular_square(context: Context, body: Body, turning: Node) -> Product:
    """xᵀ 𝓘 x of ω or J_ω, in letters; where ω is always parallel to an axis of the body, (I)_zz xᵀ x."""
    axis = turning_axis(context, body)
    if axis is None:
        return letters.transposed_product(turning, letters.base_tensor(letters.index_of(body.name)))
    moment = Entry(letters.tensor(context.robot, body), Words("xyz"[axis] * 2))
    return Product((moment, *letters.transposed_product(turning).factors))


def _terms_needed(w: Matrix, tensor: Matrix) -> int:
    """The terms that wᵀ I w is made of: of the tensor, the entries that meet rows of w that are not zero."""
    turning = [k for k in range(3) if not w[k, 0].is_zero]
    return sum(len(tensor[i, j]) for i in turning for j in turning) + sum(len(w[k, 0]) for k in turning)


def multiplied_out(context: Context, body: Body) -> tuple[Node, Way]:
    """K_ω = ½ [row] [tensor] [column] along the axes that are chosen, and the lines from there."""
    tensor, w = _in_axes(context, body, own=along_own_axes(context, body))
    front, inner = _with_factor(context, tensor)
    matrices = [context.show(w.T), *([] if inner is None else [inner]), context.show(w)]
    name, result = letters.energy_part("omega", body), f"Kw{body.name}"
    whole = equation(name, Product((letters.HALF, *front, *matrices)))
    terms = tuple(_terms(context, w, inner))
    if not context.is_short or len(terms) < 2:
        return whole, SILENT
    form, after = Product((letters.HALF, *front, sum_of(terms))), context.form(result)
    used = identities(context.robot.ring, form, after)
    concluding = say("By {used}:", used=said(used)) if used else collected(context.robot.ring, form, after)
    return whole, chain(context, result, name, [("Multiplied out:", form)], concluding)


def _with_factor(context: Context, tensor: Matrix) -> tuple[tuple[Node, ...], tree.Matrix | None]:
    """The factors that the moments share, and what is left of the tensor: of a multiple of E, nothing."""
    form, factor = context.show(tensor), factor_of_identity(tensor)
    assert isinstance(form, tree.Matrix)
    if factor is not None:
        return factors_of(number_in_front(context.show(factor))), None
    found = matrix_factor(context.forms.compactor.collector, form)
    return ((), form) if found is None else (factors_of(found[0]), found[1])


def _terms(context: Context, w: Matrix, moments: tree.Matrix | None) -> Iterator[Node]:
    """I_ij ω_i ω_j; without a tensor, the squares alone."""
    turning = [k for k in range(3) if not w[k, 0].is_zero]
    for i, j in combinations_with_replacement(turning, 2):
        moment = (ONE if i == j else ZERO) if moments is None else moments.rows[i][j]
        first, second = context.show(w[i, 0]), context.show(w[j, 0])
        rates = [(without_signs(first), 2)] if i == j else [(first, 1), (second, 1)]
        if moment != ZERO:
            yield times(1 if i == j else 2, [(moment, 1), *rates], decimal=context.robot.has_decimals)


# -- ω, or the columns of J_ω, brought to a body's own axes: Rᵀ ω, by one product of matrices a line
# Where the base leans, its rotation is taken out first, as of a velocity: Rᵀ ω = ((R_0^w)ᵀ R)ᵀ (R_0^w)ᵀ ω,
# where (R_0^w)ᵀ R, the body's axes seen from frame 0, is made of the matrices of the table alone.


class Turned(Struct, frozen=True):
    """ω, or the columns of J_ω, along a body's own axes: the value, its name Rᵀ ω, how it comes about.

    `uses` names the rotation that the first line turns by.
    """

    value: Matrix
    name: Product
    lines: tuple[Line, ...]
    uses: str


def turned(context: Context, body: Body, quantity: str, letter: Letter) -> Turned:
    """Rᵀ ω or Rᵀ J_ω of a body: the quantity is `w` or `Jw`, the letter its name."""
    b, R = body.name, letters.of_body("R", body, "bold")
    rotation, value = ((context.values[key], context.form(key)) for key in (f"R{b}", f"{quantity}{b}"))
    own, whole = rotation[0].T @ value[0], Product((Transpose(R), letter))
    if not context.is_short:
        by = say("Along the body's own axes, multiplied out:")
        return Turned(own, whole, (Line(by, (equation(whole, context.show(own)),)),), f"R{b}")
    if leans(context.robot):
        return Turned(own, whole, tuple(_by_frame_0(context, body, quantity, letter)), "H0")
    line = product_line(context, "Along the body's own axes", [whole], rotation, value)
    return Turned(own, whole, (line,), f"R{b}")


def leans(robot: Robot) -> bool:
    """Whether frame 0 is turned in the world by more than quarter turns."""
    ring = robot.ring
    plain = (ring.zero, ring.one, -ring.one)
    return robot.has_table and any(entry not in plain for entry in robot.base_rotation.entries)


def _by_frame_0(context: Context, body: Body, quantity: str, letter: Letter) -> Iterator[Line]:
    """(R_0^w)ᵀ ω, and from there along the body's axes, which are found once, with ω: a product a line."""
    b, R, base = body.name, letters.of_body("R", body, "bold"), turn_of_frame(context, 0)
    value = context.values[f"{quantity}{b}"], context.form(f"{quantity}{b}")
    rotation = context.values[f"R{b}"], context.form(f"R{b}")
    seen, along = base[0].T @ rotation[0], base[0].T @ value[0]
    axes, in_frame = (turned_name(context, 0, each) for each in (R, letter))
    whole = Product((Transpose(R), letter))
    turned_back = formula("({axes})ᵀ ({vector})", axes=axes, vector=in_frame)
    rows = tuple(f"A{joint.index}" for joint in context.robot.path(body.link))
    label = f"R{b}-from-frame-0"
    yield product_line(context, "Along the axes of frame 0", [in_frame], base, value)
    if quantity == "w":
        made = _table_factors(context, body, seen)
        made_of = () if made is None else say(", the rotation of {made}", made=made)
        by = say("The body's axes seen from frame 0{made_of}", made_of=made_of)
        yield product_line(context, by, [axes], base, rotation, ("H0", f"R{b}", *rows), label)
    by = say("From there along the body's own axes, by {axes}", axes=axes)
    turn, vector = ((each, context.show(each)) for each in (seen, along))
    yield product_line(context, by, [whole, turned_back], turn, vector, (label,))


def _table_factors(context: Context, body: Body, seen: Matrix) -> Node | None:
    """A_1 A_2, where its rotation is that from frame 0 to the body's axes."""
    factors = tuple(letters.A(joint.index) for joint in context.robot.path(body.link))
    base, end = (turn_of_frame(context, link)[0] for link in (0, body.link))
    if not factors or seen != base.T @ end:
        return None
    return Product(factors) if len(factors) > 1 else factors[0]
