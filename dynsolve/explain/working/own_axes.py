"""ω, or the columns of J_ω, brought to a body's own axes: Rᵀ ω, by one product of matrices a line.

Where the base leans, its rotation is taken out first, as of a velocity: Rᵀ ω = ((R_0^w)ᵀ R)ᵀ (R_0^w)ᵀ ω,
where (R_0^w)ᵀ R, the body's axes seen from frame 0, is made of the matrices of the table alone.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from dynsolve.algebra.matrix import Matrix
from dynsolve.derivation.kinematics import rotation
from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.step import Line
from dynsolve.explain.working.identities import said
from dynsolve.explain.working.other_axes import turned_name
from dynsolve.explain.working.products import cancelled_in_product, used_in_product
from dynsolve.explain.writing import block_of, is_small
from dynsolve.notation.tree import Letter, Node, Parenthesized, Product, Transpose, equation
from dynsolve.quantities import letters
from dynsolve.robot.model import Body, Robot


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
