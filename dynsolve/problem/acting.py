"""What acts by the keys of a problem file -> the robot's `Actions`, each kind by its own folder in `acts`.

What kinds have in common is here: constants, linear forms of the coordinates, what no kind may do; and the
key `passive`.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from typing import Any

from msgspec import Struct

from dynsolve.algebra.ring import Expr
from dynsolve.notation.tree import Function
from dynsolve.problem.cells import Cell
from dynsolve.problem.decoder import Decoder, Stated
from dynsolve.problem.kinds import Fields, items
from dynsolve.problem.specification import PROBLEM
from dynsolve.problem.table import known_coordinate
from dynsolve.problem.values import CellValues
from dynsolve.problem.yaml_nodes import Faults
from dynsolve.robot.actions import KINDS, part
from dynsolve.robot.model import Actions


class Acting(Struct, frozen=True):
    """What acts on the robot, as the file has it: `given` is what each kind has read, of each one.

    `functions` are what the ring must hold beside the expressions that were stated.
    """

    stated: tuple[Stated, ...] = ()
    given: Mapping[str, tuple[Any, ...]] = {}
    passive: tuple[str, ...] = ()
    functions: tuple[Function, ...] = ()

    @property
    def terms(self) -> frozenset[str]:
        """The results that there are by them, as `Actions.terms`."""
        return frozenset(_term(kind) for kind, given in self.given.items() if given)


def _term(kind: str) -> str:
    name: str = part(kind, "act").TERM.term
    return name


def read_actions(decoder: Decoder, fields: Fields) -> Acting:
    """The keys of a file that say what acts; what is wrong with one is reported."""
    given = {kind: tuple(_read(kind, decoder, fields)) for kind in KINDS if kind in fields}
    help = PROBLEM["passive"].help
    listed = items(decoder.faults, fields.get("passive"), "passive", help)
    names = [known_coordinate(decoder.faults, item, decoder.coordinates, help) for item in listed]
    passive = tuple(name for name in names if name)
    return Acting(tuple(decoder.stated), given, passive, tuple(decoder.functions))


def _read(kind: str, decoder: Decoder, fields: Fields) -> Iterable[Any]:
    """What the file gives of each one of a kind: as its folder reads it, or the records of its list."""
    act = part(kind, "act")
    found: Iterable[Any]
    found = act.read(decoder, fields) if hasattr(act, "read") else decoder.entries(fields, part(kind).KEY)
    return found


_TAKEN = {"Ps": ("s", "P_s", "the springs"), "Km": ("m", "K_m", "the rotors")}
"""The body's name, and what it would call by the same letter as these terms."""


def check_bodies(
    faults: Faults, fields: Fields, acting: Acting, bodies: Collection[str], has_mass: bool
) -> None:
    """Report that nothing has mass, and a body whose energy would be called as that of springs or rotors."""
    if not has_mass:
        key = next(key for key in (*KINDS, "passive") if key in fields)
        message = f"`{key}` stands in the equations of motion, and nothing has mass"
        faults.error(fields.key_span(key), message, "give the bodies under `masses`")
    for kind in (kind for kind, given in acting.given.items() if given):
        name, letter, of = _TAKEN.get(_term(kind), ("", "", ""))
        if name in bodies:
            message = f"{letter} is the energy of {of}, and a body is called {name}, too"
            faults.error(fields.key_span(kind), message, "give the body another name")


# -- with exact values -----------------------------------------------------------------------------


def actions(values: CellValues, acting: Acting) -> Actions:
    """The actions of a file; what was reported is left out."""
    names = values.ring.names
    acts = (part(kind, "act").build(values, one) for kind, given in acting.given.items() for one in given)
    return Actions(
        acts=tuple(act for act in acts if act),
        passive=tuple(sorted({names.index(name) for name in acting.passive})),
    )


def constant(values: CellValues, cell: Cell | None) -> Expr | None:
    """The value of a constant; a negative number is reported."""
    value = values.expr(cell) if cell else None
    if cell and value is not None and value.is_number and value.number < 0:
        values.faults.error(cell.span, f"{cell.what} is negative", "stiffness, friction and inertia are not")
    return value


def linear(values: CellValues, cell: Cell | None) -> Expr | None:
    """A form that is linear in the coordinates, None (reported) where it is none."""
    value, ring = values.expr(cell) if cell else None, values.ring
    if cell is None or value is None:
        return None
    slopes = [ring.diff(value, k) for k in range(len(ring.names))]
    rest = ring.at_rest(value)
    if all(slope.is_zero for slope in slopes):
        values.faults.error(cell.span, f"{cell.what} contains no coordinate", "write of: q2 - q1")
    elif any(map(ring.depends_on_coordinates, slopes)):
        help = "write a linear form: q2 - q1; the `energy` of one of `springs` may be any"
        values.faults.error(cell.span, f"{cell.what} is not linear in the coordinates", help)
    elif not rest.is_zero:
        help = "leave it out; where a spring of `springs` is at rest stands under its `rest`"
        values.faults.error(cell.span, f"{cell.what} has a part without coordinates", help)
    else:
        return value
    return None
