"""Names that mean an answer only where their value says so: k_1, u_1, H_11, T_1, Γ_1.

Craig calls the energies of a body k_i and u_i, others the torques u_i; Asada and Slotine call the
inertia matrix H; torques are called by any letter.  All of these are abbreviations as well, or other
answers: what stands on the other side decides.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from dynsolve.answers.reading.grids import Abstract, Grid, Value
from dynsolve.answers.reading.vocabulary import Vocabulary
from dynsolve.notation.names import split
from dynsolve.notation.tree import Symbol
from dynsolve.notation.walk import walk
from dynsolve.quantities.stages import Stage

_NAME = re.compile(r"(k|u)([0-9a-z]?)|(H)((?:[1-9][1-9])?)")
_FRICTION = re.compile(r"(?:tau|[TMFQ])(?:f|fr|fric|friction|r|R|Reib|reib|fv|d|D|diss)")
"""What the vector of friction is called beside the torques."""


def meant(vocabulary: Vocabulary, name: str, value: Value) -> tuple[str, ...]:
    """The answers that a name of the student's own may be, by what its value is made of; none for others."""
    if _FRICTION.fullmatch(name) and vocabulary.is_answer("friction"):
        return ("friction",) if _is_friction(vocabulary, value) else ()
    found = _NAME.fullmatch(name)
    if found is None or isinstance(value, Abstract):
        return ()
    letter, index = found[1] or found[3], found[2] or found[4] or ""
    symbols = [
        part for part in walk(value.node if isinstance(value, Grid) else value) if isinstance(part, Symbol)
    ]
    rates = {symbol.dots for symbol in symbols}
    has_mass = any(symbol.name in vocabulary.masses for symbol in symbols)
    if letter == "H":
        wanted = f"D{index}" if has_mass and rates <= {0} else ""
    elif 2 in rates:
        return ()
    elif letter == "k":
        wanted = f"K{index}" if 1 in rates and has_mass else ""
    else:
        is_weight = any(split(symbol.name)[0] == "g" for symbol in symbols)
        wanted = f"P{index}" if is_weight and rates <= {0} else ""
    names = vocabulary.named(wanted) if wanted else ()
    scalar = not isinstance(value, Grid)
    return tuple(n for n in names if (vocabulary.shape(n) is None) == scalar)


def _is_friction(vocabulary: Vocabulary, value: Value) -> bool:
    """Whether a vector holds rates, beside no mass and no acceleration."""
    symbols = (
        [part for part in walk(value.node) if isinstance(part, Symbol)] if isinstance(value, Grid) else []
    )
    has_mass = any(symbol.name in vocabulary.masses for symbol in symbols)
    return not has_mass and {symbol.dots for symbol in symbols} in ({1}, {0, 1})


def force_meant(vocabulary: Vocabulary, name: str, value: Value) -> tuple[str, ...]:
    """The generalized force of the index of a name, where its value holds accelerations beside a mass.

    Without an index it is one of those that are driven.
    """
    if isinstance(value, Abstract) or not name or name in vocabulary.symbols:
        return ()
    tree = value.node if isinstance(value, Grid) else value
    symbols = [part for part in walk(tree) if isinstance(part, Symbol)]
    has_mass = any(symbol.name in vocabulary.masses for symbol in symbols)
    if not has_mass or all(symbol.dots < 2 for symbol in symbols):
        return ()
    if isinstance(value, Grid):
        return ("tau",) if value.shape == vocabulary.shape("tau") and len(name) == 1 else ()
    forces = [q.force for q in vocabulary.coordinates]
    index = "".join(split(name)[1]) or name[1:]
    counted = "".join(character for character in index if character.isdigit())
    named = vocabulary.named(f"tau{index}") or vocabulary.named(f"tau{counted}")
    driven = [force for force in forces if force not in vocabulary.passive]
    is_open = not split(name)[1] and (len(driven) == 1 or not index)
    return tuple(force for force in named if force in forces) or (tuple(driven) if is_open else ())


def called_force(
    vocabulary: Vocabulary, name: str, candidates: tuple[str, ...], values: Sequence[Value]
) -> tuple[str, ...]:
    """The force that T_1 or G_1 is, else an energy or an entry of g; none where that has the very name."""
    scalars = [vocabulary.quantities[c] for c in candidates if vocabulary.shape(c) is None]
    may_differ = all(
        one.family.stage is Stage.ENERGY or vocabulary.quantities.entry_of(one.name)[0] == "g"
        for one in scalars
    )
    if name in candidates or not values or not may_differ:
        return ()
    return force_meant(vocabulary, name, values[-1])
