"""Names that mean an answer only where their value says so: k_1, u_1, H_11.

Craig calls the energies of a body k_i and u_i, others the torques u_i; Asada and Slotine call the
inertia matrix H.  All of these are abbreviations as well: what stands on the other side decides.
"""

from __future__ import annotations

import re

from dynsolve.answers.reading.grids import Abstract, Grid, Value
from dynsolve.answers.reading.vocabulary import Vocabulary
from dynsolve.notation.names import split
from dynsolve.notation.tree import Symbol
from dynsolve.notation.walk import walk

_NAME = re.compile(r"(k|u)([0-9a-z]?)|(H)((?:[1-9][1-9])?)")


def meant(vocabulary: Vocabulary, name: str, value: Value) -> tuple[str, ...]:
    """The answers that a name of the student's own may be, by what its value is made of; none for others."""
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
        wanted = f"tau{index}" if letter == "u" else ""
    elif letter == "k":
        wanted = f"K{index}" if 1 in rates and has_mass else ""
    else:
        is_weight = any(split(symbol.name)[0] == "g" for symbol in symbols)
        wanted = f"P{index}" if is_weight and rates <= {0} else ""
    names = vocabulary.named(wanted) if wanted else ()
    scalar = not isinstance(value, Grid)
    return tuple(n for n in names if (vocabulary.shape(n) is None) == scalar)
