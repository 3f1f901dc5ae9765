"""The textbook's letters: H_2^0, J_{v_1}, 𝓘_1, τ_1.

How students spell the names of quantities and coordinates.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from itertools import product

from dynsolve.notation.characters import split
from dynsolve.notation.tree import (
    Derivative,
    Letter,
    Negative,
    Node,
    Number,
    Parenthesized,
    Product,
    Quotient,
    Row,
    Sum,
    Symbol,
    Transpose,
    Words,
)
from dynsolve.robot.model import Body, Coordinate, JointType, Robot
from dynsolve.robot.names import FORCES, names_taken, spelled

HALF = Quotient(Number(1), Number(2))
"""½ of a general formula, a fraction also where the numbers of a robot are decimals."""


COUNT = Symbol("i")
"""What counts: in italics, in sentences as in formulas."""
BEFORE = Sum((COUNT, Negative(Number(1))))
"""i - 1"""
AFTER = Sum((COUNT, Number(1)))
"""i + 1"""


def bold(base: str, sub: Node | None = None, sup: Node | None = None, dots: int = 0) -> Letter:
    """A vector or a matrix."""
    return Letter(base, sub, sup, "bold", dots)


def index_of(name: str) -> Node:
    """A body's name as an index."""
    return Number(int(name)) if name.isdecimal() else Symbol(name)


DH = Letter("DH", style="upright")


def A(i: int) -> Letter:
    """A_i"""
    return bold("A", Number(i))


def H(robot: Robot, i: int) -> Letter:
    """H_i^0, or H_i^w where the base is turned or moved in the world w."""
    return bold("H", Number(i), Words("w") if has_base(robot) else Number(0))


def R(robot: Robot, i: int) -> Letter:
    """R_i^0, the rotation in H_i^0."""
    return bold("R", Number(i), Words("w") if has_base(robot) else Number(0))


def columns(robot: Robot, row: Node) -> tuple[Node, Node, Node, Node]:
    """θ, d, a, α: what the columns of the table are called, as a coordinate θ_1 is another thing.

    Where the problem calls something so, the entries of a row are θ_i, d_i, a_i and α_i.
    """
    if names_taken(robot).isdisjoint(("theta", "d", "a", "alpha")):
        return Symbol("theta"), Symbol("d"), Symbol("a"), Symbol("alpha")
    return Letter("theta", row), Letter("d", row), Letter("a", row), Letter("alpha", row)


def has_base(robot: Robot) -> bool:
    """Whether the problem turns or moves frame 0 in the world."""
    ring = robot.ring
    diagonal = all(
        robot.base_rotation[i, j] == (ring.one if i == j else ring.zero) for i in range(3) for j in range(3)
    )
    return not (diagonal and robot.base_position.is_zero)


def z(i: int) -> Letter:
    """z_i"""
    return bold("z", Number(i))


def o(i: int) -> Letter:
    """o_i"""
    return bold("o", Number(i))


J = bold("J")
JV = bold("J", Letter("v"))
JW = bold("J", Symbol("omega"))
Q = bold("q")
QD = bold("q", dots=1)
QDD = bold("q", dots=2)
D = bold("D")
C = bold("C")
G = bold("g")
GRAVITY = bold("g", Number(0))
"""g_0, the vector of the acceleration of gravity: g is the number, and in D q̈ + C q̇ + g = τ the term."""
TAU = bold("tau")
Q_FORCES = bold("Q")
TAU_STATIC = bold("tau", Words("static"))
PARAMETERS = bold("a")
REGRESSOR = bold("Y")
H_C = bold("h")
A_C = bold("A", Words("c"))
LAMBDA = bold("lambda")
DET_D = Row((Words("det "), D))
LINEAR_A = bold("A", Words("lin"))
LINEAR_B = bold("B", Words("lin"))
DIVISOR = Letter("Delta")
"""What several entries of a result are divided by."""
DIVISOR_THERE = Letter("Delta", Words("e"))
"""The same in the equilibrium."""
TASK_INERTIA = bold("Lambda")
NULLSPACE = Row((Letter("N", style="script"), Parenthesized(bold("J", Symbol("r")))))
RANGESPACE = Row((Letter("R", style="script"), Parenthesized(bold("J", Symbol("r")))))
LOST = Row((Letter("N", style="script"), Parenthesized(Transpose(bold("J", Symbol("r"))))))
TASK = bold("r")
IN_IDENTITIES = (Letter("U"), Letter("V"))
"""Any two quantities."""
PSI = Letter("psi")
"""An angle that is sought."""
STEADY_ENERGY = Letter("V", Words("eff"))
TASK_OF_Q = Row((TASK, Parenthesized(Q)))
FRAME_OF_Q = Row((bold("H"), Parenthesized(Q)))
J_TASK = bold("J", Symbol("r"))
WEIGHTS = bold("W")
K = Letter("K", style="script")
P = Letter("P", style="script")
L = Letter("L", style="script")
PS = Letter("P", Words("s"))
KM = Letter("K", Words("m"))
DM = bold("D", Words("m"))
D_POINTS = bold("D", Words("points"))
FRICTION = bold("tau", Words("f"))
DISSIPATION = Letter("R", style="script")


def of_part(base: str, part: str) -> Letter:
    """a_M, Y_g: of one part of the equations of motion."""
    return bold(base, Symbol(part))


def jv(body: Body) -> Letter:
    """J_{v_i}"""
    return bold("J", Letter("v", index_of(body.name)))


def jw(body: Body) -> Letter:
    """J_{ω_i}"""
    return bold("J", Letter("omega", index_of(body.name)))


def rc(body: Body) -> Letter:
    """r_{ci}"""
    return bold("r", Row((Words("c"), index_of(body.name))))


def of_body(base: str, body: Body, style: str = "italic") -> Letter:
    """A letter with the body's index: P_1, v_1, 𝓘_1."""
    return Letter(base, index_of(body.name), None, style)


def of_point(base: str, point: str, axes: int | None = None) -> Letter:
    """A letter with a point's name as its index: p_P, v_P, or v_P^i along the axes of frame i."""
    return bold(base, Symbol(point), None if axes is None else Number(axes))


def j_of_point(part: str, point: str, axes: int | None = None) -> Letter:
    """J_{v_P}, J_{ω_P}, or J_{v_P}^i along the axes of frame i."""
    return bold("J", Letter(part, Symbol(point)), None if axes is None else Number(axes))


def of_load(index: int) -> Letter:
    """Q_{F_i}, the generalized forces of one force."""
    return bold("Q", bold("F", Number(index)))


def static_torque(robot: object, i: int) -> Letter:
    """τ_{static,i}, an entry of the torques that hold the arm at rest."""
    return Letter("tau", Row((Words("static,"), Number(i))))


def in_link(base: str, i: int, dots: int = 0) -> Letter:
    """A vector of link i along the axes of its own frame: ω_i^i, f_i^i."""
    return bold(base, Number(i), Number(i), dots)


def center_in_link(base: str, body: Body) -> Letter:
    """A vector of the mass centre of a body, along the axes of its link's frame: a_{c2}^2."""
    return bold(base, Row((Words("c"), index_of(body.name))), Number(body.link))


def rate(matrix: Letter) -> Letter:
    """The time derivative of a matrix: J̇_v."""
    return Letter(matrix.base, matrix.sub, matrix.sup, matrix.style, matrix.dots + 1)


def is_taken(robot: Robot, base: str, body: Body) -> bool:
    """Whether the problem calls something else by a body's letter: h_1 a length of the table."""
    return spelled(f"{base}{body.name}") in names_taken(robot)


def mass(robot: Robot, body: Body, value: Node) -> Node:
    """The mass of a body in a formula: the problem's symbol, else m_i unless that is another thing."""
    is_value = isinstance(value, Symbol) or is_taken(robot, "m", body)
    return value if is_value else of_body("m", body)


def height(index: Node) -> Letter:
    """η_i, the height of a mass centre: h is a factor of C's entries, as in the textbook, or a length."""
    return Letter("eta", index)


def any_vector(index: Node) -> Letter:
    """u_i, an entry of any vector."""
    return Letter("u", index)


def tensor(robot: Robot, body: Body) -> Letter:
    """I_1, the tensor in the body's own frame; I_1^b in a problem that calls a parameter I_1 or I_2."""
    taken = any(is_taken(robot, "I", other) for other in robot.bodies)
    return bold("I", index_of(body.name), Words("b") if taken else None)


def base_tensor(index: Node) -> Letter:
    """𝓘_i, the tensor along the axes of frame 0: a matrix too, and so in bold script."""
    return Letter("I", index, None, "bold script")


def energy_part(part: str, body: Body) -> Letter:
    """K_{v_i} or K_{ω_i}"""
    return Letter("K", Letter(part, index_of(body.name)))


def force(q: Coordinate) -> Letter:
    """τ_k of an angle, f_k of a length."""
    return Letter("tau" if q.type is JointType.REVOLUTE else "f", Number(q.index))


def friction(i: int) -> Letter:
    """τ_{f i}, entry i of the friction."""
    return Letter("tau", Row((Words("f"), Number(i))))


def velocity(q: Coordinate) -> Symbol:
    """q̇_k"""
    return Symbol(q.name, 1)


def partial_derivative(of: Node, by: Node) -> Derivative:
    """∂of/∂by"""
    return Derivative(of, by)


def time_derivative(of: Node) -> Derivative:
    """d of/dt"""
    return Derivative(of, Symbol("t"), total=True)


def transposed_product(left: Node, middle: Node | None = None) -> Product:
    """xᵀ x, or xᵀ M x"""
    return Product(tuple(part for part in (Transpose(left), middle, left) if part is not None))


def square_of(J: Node, rows: int, columns: int) -> Node:
    """J, or the smaller of (J Jᵀ) and (Jᵀ J) where J is not square: what has a determinant."""
    if rows == columns:
        return J
    return Parenthesized(Product((J, Transpose(J)) if rows < columns else (Transpose(J), J)))


def determinant(J: Node, rows: int, columns: int) -> Row:
    """det J, or that of the smaller of (J Jᵀ) and (Jᵀ J)."""
    return Row((Words("det "), square_of(J, rows, columns)))


def entry(letter: str, *indices: int) -> Letter:
    """d_12, c_121, g_1: the entry of a matrix by the small letter of its name."""
    if all(i < 10 for i in indices):
        return Letter(letter, Row(tuple(Number(i) for i in indices)))
    parts: list[Node] = [Number(indices[0])]
    for i in indices[1:]:
        parts += [Words(","), Number(i)]
    return Letter(letter, Row(tuple(parts)))


def entries(letter: str, n: int) -> tuple[tuple[Node, ...], ...]:
    """The names of the entries of a square matrix."""
    return tuple(tuple(entry(letter, i + 1, j + 1) for j in range(n)) for i in range(n))


def entries_of_column(letter: str, n: int) -> tuple[tuple[Node, ...], ...]:
    """The names of the entries of a column."""
    return tuple((entry(letter, i + 1),) for i in range(n))


# Letters that stand in for those which a problem calls something else by

SPONGS: dict[tuple[str, int], tuple[str, ...]] = {
    **{(letter, 1): others for letter, others in FORCES.items()},
    ("c", 2): ("C",),
    ("c", 3): ("Gamma",),
    ("d", 2): ("D",),
    ("g", 1): ("phi",),
    ("P", 1): ("U", "V"),
    ("K", 1): ("T",),
}
"""Base and number of lower indices of a scalar of the textbook -> letters that stand in for it."""

OWN: dict[tuple[str, int], tuple[str, ...]] = {
    ("eta", 1): ("zeta", "chi"),
    ("m", 1): ("mu", "M"),
    ("u", 1): ("xi", "w"),
    ("lambda", 1): ("mu", "nu"),
    ("Delta", 0): ("Theta", "Gamma"),
    ("Delta", 1): ("Theta",),
    ("Q", 1): ("Xi",),
    ("b", 1): ("p", "w"),
    ("n", 2): ("N", "nu"),
    ("rho", 0): ("gamma", "nu"),
    ("psi", 0): ("chi", "omega"),
    ("A", 0): ("E", "alpha"),
    ("B", 0): ("F", "beta"),
    ("D", 0): ("N", "delta"),
    ("X", 0): ("S", "xi"),
    ("Y", 0): ("T", "zeta"),
    ("U", 0): ("G", "mu"),
    ("V", 0): ("H", "nu"),
    ("theta", 1): ("beta",),
    ("d", 1): ("p",),
    ("a", 1): ("delta",),
    ("alpha", 1): ("gamma",),
    **dict.fromkeys((("x", 1), ("y", 1), ("z", 1)), ()),
}
"""The same for what the textbook has no letter of."""


# How students spell the names of quantities and coordinates

_STRIP = re.compile(r"[_{}, ]")


def key(name: str) -> str:
    """The letters and digits of a name, by which it is looked up.

    >>> key("I_{1,zz}"), key("theta_1")
    ('I1zz', 'theta1')
    """
    return name if name.isalnum() else _STRIP.sub("", name)


def subscripts(coordinates: tuple[Coordinate, ...]) -> dict[str, Coordinate]:
    """Coordinates by the subscript of their name; by their place where names have none, or share one."""
    found: dict[str, Coordinate] = {}
    for q in coordinates:
        index = "".join(split(q.name)[1])
        if not index.isdigit() or index in found:
            return {str(q.index): q for q in coordinates}
        found[index] = q
    return found


def other_names(q: Coordinate, subscript: str) -> tuple[str, ...]:
    """What a coordinate is called: its own name first, q by its place, θ or d by its subscript."""
    letter = "theta" if q.type is JointType.REVOLUTE else "d"
    return tuple(dict.fromkeys((key(q.name), f"q{q.index}", f"{letter}{subscript}")))


def open_index(name: str) -> str:
    """A name with `#` for each digit of its index: P# of `P3`, d## of `d13`; empty without an index."""
    stem = name.rstrip("0123456789")
    return stem + "#" * (len(name) - len(stem)) if stem != name else ""


def each(*pieces: str | Iterable[str]) -> tuple[str, ...]:
    """Templates of spellings: every choice of one of each piece, joined.

    >>> each("K T", "v w", "{b}")
    ('Kv{b}', 'Kw{b}', 'Tv{b}', 'Tw{b}')
    """
    choices = [piece.split(" ") if isinstance(piece, str) else piece for piece in pieces]
    return tuple("".join(choice) for choice in product(*choices))
