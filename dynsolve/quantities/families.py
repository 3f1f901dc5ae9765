"""Every family of quantities, one record each, in the order of the derivation.

To add a quantity:

1. its record here, at its place in the derivation;
2. its formula in `dynsolve.derivation`, in the file of its section of the textbook, and its rule there;
3. its step in the stage's file of `dynsolve.explain`.

Reading, judging, marks, numbers, JSON and NumPy take what they must know from the record.
"""

from __future__ import annotations

from collections.abc import Iterable
from itertools import product

from dynsolve.notation.tree import Node, Product, Symbol
from dynsolve.quantities import (
    action_families,
    constraint_families,
    definite_families,
    kinematic_families,
    letters,
    model_families,
    recursion_families,
    static_families,
)
from dynsolve.quantities.family import Family, Owner, of_body, of_coordinate, of_robot
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Coordinate
from dynsolve.robot.units import ENERGY, INERTIA, LENGTH, MOMENTUM, NONE, PER_SECOND, VELOCITY


def _each(*pieces: str | Iterable[str]) -> tuple[str, ...]:
    """Every choice of one of each piece, joined.

    >>> _each("K T", "v w", "{b}")
    ('Kv{b}', 'Kw{b}', 'Tv{b}', 'Tw{b}')
    """
    choices = [piece.split(" ") if isinstance(piece, str) else piece for piece in pieces]
    return tuple("".join(choice) for choice in product(*choices))


# What students write for v and ω of a body, and before it for the energy that belongs to it.
_V = _each("v vc vm", "{b}")
_W = _each("omega omegac w wc", "{b}")
_ENERGY = "K Ek T E"


# -- forward kinematics ----------------------------------------------------------------------------

H0 = Family(name="H0", stage=Stage.KINEMATICS, shape=(4, 4), is_answer=False)

DH = Family(
    name="DH",
    stage=Stage.KINEMATICS,
    shape=("n", 4),
    letter=of_robot(letters.DH),
    spellings=("DHtable", "table"),
)
"""The Denavit-Hartenberg table; no rule gives it, and its rows need not be those of the robot."""

A = Family(
    name="A{i}",
    owner=Owner.ROW,
    stage=Stage.KINEMATICS,
    shape=(4, 4),
    letter=lambda robot, i: letters.A(i),
    json="A",
)

H = Family(
    name="H{i}",
    owner=Owner.ROW,
    stage=Stage.KINEMATICS,
    shape=(4, 4),
    letter=letters.H,
    json="H",
    spellings=("T{i}", "H0{i}", "T0{i}"),
)

# -- the Jacobian of the end of the arm ------------------------------------------------------------

JV = Family(
    name="Jv",
    stage=Stage.JACOBIAN,
    shape=(3, "n"),
    letter=of_robot(letters.JV),
    json="Jv",
    dimension=LENGTH,
    per=("column",),
    dimension_is_told=False,
    spellings=("JP", "Jp"),
    part_of="J",
)

JW = Family(
    name="Jw",
    stage=Stage.JACOBIAN,
    shape=(3, "n"),
    letter=of_robot(letters.JW),
    json="Jw",
    dimension=NONE,
    dimension_is_told=False,
    spellings=("Jomega", "JO", "JOmega"),
    part_of="J",
)

J = Family(name="J", stage=Stage.JACOBIAN, shape=(6, "n"), letter=of_robot(letters.J))

# -- what an exercise asks of the kinematics -------------------------------------------------------

_ASKED_OF_KINEMATICS = kinematic_families.FAMILIES

# -- the bodies: mass centres, velocities, inertia -------------------------------------------------

RC = Family(
    name="rc{b}",
    owner=Owner.BODY,
    stage=Stage.INERTIA,
    capped_in=Stage.KINEMATICS,
    shape=(3, 1),
    letter=of_body(letters.rc),
    json="r_c",
    dimension=LENGTH,
    spellings=("pc{b}", "oc{b}", "rm{b}"),
)

R = Family(
    name="R{b}",
    owner=Owner.BODY,
    stage=Stage.INERTIA,
    shape=(3, 3),
    letter=of_body(lambda body: letters.of_body("R", body, "bold")),
    json="R",
    dimension=NONE,
    is_answer=False,
    needs_rotation=True,
)

JV_BODY = Family(
    name="Jv{b}",
    owner=Owner.BODY,
    stage=Stage.ENERGY,
    capped_in=Stage.JACOBIAN,
    shape=(3, "n"),
    letter=of_body(letters.jv),
    json="Jv",
    dimension=LENGTH,
    per=("column",),
    dimension_is_told=False,
    spellings=_each("J", _V),
)

JW_BODY = Family(
    name="Jw{b}",
    owner=Owner.BODY,
    stage=Stage.ENERGY,
    capped_in=Stage.JACOBIAN,
    shape=(3, "n"),
    letter=of_body(letters.jw),
    json="Jw",
    dimension=NONE,
    dimension_is_told=False,
    spellings=_each("J", _W),
)

V = Family(
    name="v{b}",
    owner=Owner.BODY,
    stage=Stage.ENERGY,
    capped_in=Stage.JACOBIAN,
    shape=(3, 1),
    letter=of_body(lambda body: letters.of_body("v", body, "bold")),
    json="v",
    dimension=VELOCITY,
    spellings=_V,
)

W = Family(
    name="w{b}",
    owner=Owner.BODY,
    stage=Stage.ENERGY,
    capped_in=Stage.JACOBIAN,
    shape=(3, 1),
    letter=of_body(lambda body: letters.of_body("omega", body, "bold")),
    json="w",
    dimension=PER_SECOND,
    unit="rad/s",
    spellings=_W,
)

I_BODY = Family(
    name="I_body{b}",
    owner=Owner.BODY,
    stage=Stage.INERTIA,
    shape=(3, 3),
    letter=lambda robot, b: letters.tensor(robot, robot.bodies[b - 1]),
    json="I_body",
    dimension=INERTIA,
    spellings=("Ib{b}", "I{b}", "Ic{b}", "I{b}b", "I{b}body"),
    needs_rotation=True,
)

I = Family(  # noqa: E741  the book's symbol
    name="I{b}",
    owner=Owner.BODY,
    stage=Stage.INERTIA,
    shape=(3, 3),
    letter=of_body(lambda body: letters.of_body("I", body, "script")),
    json="I_base",
    dimension=INERTIA,
    spellings=("I0{b}", "Ibase{b}", "I{b}base"),
    needs_rotation=True,
)

# -- energies --------------------------------------------------------------------------------------

P_BODY = Family(
    name="P{b}",
    owner=Owner.BODY,
    stage=Stage.ENERGY,
    letter=of_body(lambda body: letters.of_body("P", body)),
    json="P",
    dimension=ENERGY,
    unit="J",
    spellings=_each("U Ep PE Epot V", "{b}"),
    part_of="P",
)

KV = Family(
    name="Kv{b}",
    owner=Owner.BODY,
    stage=Stage.ENERGY,
    letter=of_body(lambda body: letters.energy_part("v", body)),
    json="Kv",
    dimension=ENERGY,
    unit="J",
    spellings=(*_each(_ENERGY, _V), *_each("K T E", "{b}", "v"), *_each("Klin Ktrans Kt KT KL Kl", "{b}")),
    part_of="K{b}",
)

KW = Family(
    name="Kw{b}",
    owner=Owner.BODY,
    stage=Stage.ENERGY,
    letter=of_body(lambda body: letters.energy_part("omega", body)),
    json="Kw",
    dimension=ENERGY,
    unit="J",
    spellings=(*_each(_ENERGY, _W), *_each("K T E", "{b}", "omega w"), *_each("Krot Kr KR", "{b}")),
    part_of="K{b}",
    needs_rotation=True,
)

K_BODY = Family(
    name="K{b}",
    owner=Owner.BODY,
    stage=Stage.ENERGY,
    letter=of_body(lambda body: letters.of_body("K", body)),
    json="K",
    dimension=ENERGY,
    unit="J",
    spellings=_each("T Ek KE Ekin", "{b}"),
    part_of="K",
)

_ENERGIES_OF_ACTIONS = action_families.OF_ENERGY

P = Family(
    name="P",
    stage=Stage.ENERGY,
    letter=of_robot(letters.P),
    json="P",
    dimension=ENERGY,
    unit="J",
    spellings=("U", "Ep", "PE", "Epot", "Ptot", "Ptotal", "V", "Etp", "Utot"),
)

K = Family(
    name="K",
    stage=Stage.ENERGY,
    letter=of_robot(letters.K),
    json="K",
    dimension=ENERGY,
    unit="J",
    spellings=("T", "Ek", "KE", "Ekin", "Ktot", "Ktotal", "Ttot"),
)

# -- Lagrange --------------------------------------------------------------------------------------

L = Family(
    name="L",
    stage=Stage.LAGRANGIAN,
    letter=of_robot(letters.L),
    json="L",
    dimension=ENERGY,
    unit="J",
    spellings=("Lagrangian",),
)


def _momentum(q: Coordinate) -> Node:
    return letters.partial_derivative(letters.L, letters.velocity(q))


_FRICTION = action_families.OF_TORQUE

DLDQD = Family(
    name="dLdqd{i}",
    owner=Owner.COORDINATE,
    stage=Stage.TORQUE,
    capped_in=Stage.LAGRANGIAN,
    letter=of_coordinate(_momentum),
    json="dL_dqdot",
    dimension=MOMENTUM,
    per=("owner",),
    spellings=("dLdqdot{i}", "dLd{name}dot"),
)

DDT = Family(
    name="ddt{i}",
    owner=Owner.COORDINATE,
    stage=Stage.TORQUE,
    capped_in=Stage.LAGRANGIAN,
    letter=of_coordinate(lambda q: letters.time_derivative(_momentum(q))),
    json="ddt",
    dimension=ENERGY,
    per=("owner",),
    unit="N m",
    spellings=("ddtdLdqd{i}",),
)

DLDQ = Family(
    name="dLdq{i}",
    owner=Owner.COORDINATE,
    stage=Stage.TORQUE,
    capped_in=Stage.LAGRANGIAN,
    letter=of_coordinate(lambda q: letters.partial_derivative(letters.L, Symbol(q.name))),
    json="dL_dq",
    dimension=ENERGY,
    per=("owner",),
    unit="N m",
    spellings=("dLd{name}",),
)

FORCE = Family(
    name="{force}",
    rule="tau{i}",
    owner=Owner.COORDINATE,
    stage=Stage.TORQUE,
    letter=of_coordinate(letters.force),
    json="force",
    dimension=ENERGY,
    per=("owner",),
    unit="N m",
    spellings=(*_each("tau f F Q", "{i}"), *_each("tau f F", "{q}")),
    fallback_spellings=("tau{s}", "f{s}"),
    aliases=("tau{i}", "f{i}"),
    part_of="tau",
)

TAU = Family(
    name="tau",
    stage=Stage.TORQUE,
    shape=("n", 1),
    letter=of_robot(letters.TAU),
    json="tau",
    dimension=ENERGY,
    per=("row",),
    unit="N m",
    spellings=("tauvec",),
)

# -- the vectorized form ---------------------------------------------------------------------------

D = Family(
    name="D",
    stage=Stage.VECTORIZED,
    shape=("n", "n"),
    letter=of_robot(letters.D),
    json="D",
    dimension=INERTIA,
    per=("row", "column"),
    spellings=("M", "B", "Dq", "Mq"),
    aliases=("M", "B"),
)

D_ENTRY = Family(
    name="d{i}{j}",
    rule="D",
    owner=Owner.PAIR,
    stage=Stage.VECTORIZED,
    letter=lambda robot, i, j: letters.entry("d", i, j),
    spellings=_each("D m M b B", "{i}{j}"),
    aliases=_each("D m M b B", "{i}{j}"),
    part_of="D",
    is_symmetric_entry=True,
)

CHRISTOFFEL = Family(name="christoffel", stage=Stage.VECTORIZED, is_answer=False)

C_SYMBOL = Family(
    name="c{i}{j}{k}",
    rule="christoffel",
    owner=Owner.TRIPLE,
    stage=Stage.VECTORIZED,
    letter=lambda robot, i, j, k: letters.entry("c", i, j, k),
    spellings=_each("C Gamma", "{i}{j}{k}"),
    aliases=("C{i}{j}{k}",),
    part_of="christoffel",
)

C = Family(
    name="C",
    stage=Stage.VECTORIZED,
    shape=("n", "n"),
    letter=of_robot(letters.C),
    json="C",
    dimension=MOMENTUM,
    per=("row", "column"),
    dimension_is_told=False,
    spellings=("S",),
)

C_ENTRY = Family(
    name="C{i}{j}",
    rule="C",
    owner=Owner.PAIR,
    stage=Stage.VECTORIZED,
    letter=lambda robot, i, j: letters.entry("c", i, j),
    spellings=("c{i}{j}",),
    aliases=("c{i}{j}",),
    part_of="C",
)

G = Family(
    name="g",
    stage=Stage.VECTORIZED,
    shape=("n", 1),
    letter=of_robot(letters.G),
    json="g",
    dimension=ENERGY,
    per=("row",),
    unit="N m",
    spellings=("G", "phi", "gvec"),
    aliases=("G",),
)

G_ENTRY = Family(
    name="g{i}",
    rule="g",
    owner=Owner.COORDINATE,
    stage=Stage.VECTORIZED,
    letter=lambda robot, i: letters.entry("g", i),
    spellings=("G{i}", "phi{i}", "Phi{i}"),
    aliases=("phi{i}", "G{i}"),
    part_of="g",
)

CQD = Family(
    name="Cqd",
    stage=Stage.VECTORIZED,
    shape=("n", 1),
    letter=of_robot(Product((letters.C, letters.QD))),
    dimension=ENERGY,
    per=("row",),
    unit="N m",
    spellings=("c", "V", "Cqdot", "h", "C", "n", "N"),
    aliases=("c", "V"),
)

# -- the same, assembled directly ------------------------------------------------------------------

G_DIRECT = Family(
    name="g_direct",
    stage=Stage.VECTORIZED,
    shape=("n", 1),
    dimension=ENERGY,
    per=("row",),
    unit="N m",
    is_answer=False,
)

D_DIRECT = Family(
    name="D_direct",
    stage=Stage.VECTORIZED,
    shape=("n", "n"),
    dimension=INERTIA,
    per=("row", "column"),
    is_answer=False,
)

_ROTORS = action_families.OF_THE_MODEL

# -- the Newton-Euler recursions -------------------------------------------------------------------

_RECURSIONS = recursion_families.FAMILIES

# -- what an exercise asks of the equations of motion ----------------------------------------------

_ASKED_OF_MODEL = model_families.FAMILIES

# -- what an exercise asks of forces ---------------------------------------------------------------

_ASKED_OF_STATICS = static_families.FAMILIES

# -- constraints -----------------------------------------------------------------------------------

_CONSTRAINTS = constraint_families.FAMILIES

# -- what an exercise asks of matrices -------------------------------------------------------------

_ASKED_OF_MATRICES = definite_families.FAMILIES

HOLD_FORCES = frozenset({constraint_families.LAMBDA.name, model_families.QDD_FORWARD.name})
"""The names of the results that hold the generalized forces by their names."""

_GROUPS = (
    _ASKED_OF_KINEMATICS, _ENERGIES_OF_ACTIONS, _FRICTION, _ROTORS, _RECURSIONS, _ASKED_OF_MODEL,
    _ASKED_OF_STATICS, _CONSTRAINTS, _ASKED_OF_MATRICES,
)  # fmt: skip
"""The families that have a file of their own."""

FAMILIES: tuple[Family, ...] = tuple(
    record
    for value in tuple(vars().values())
    for record in (value if value in _GROUPS else (value,))
    if isinstance(record, Family)
)
"""The records above, in their order."""
