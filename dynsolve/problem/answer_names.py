"""The names of answers: what `find` and `marks` may ask for, and in which form it is kept.

`M` and `B` are D, `G` is g, `phi1` is g1, `m12` is d12, `c` is Cqd; the force of a
revolute coordinate is tau_i, of a prismatic one f_i, whichever was written.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

_WHOLE = {"M": "D", "B": "D", "G": "g", "c": "Cqd", "V": "Cqd"}
_WHOLES = ("tau", "D", "C", "g", "P", "K", "L", "Jv", "Jw", "J", "Cqd")
_BODY = ("rc", "Jv", "Jw", "v", "w", "I_body", "I", "P", "Kv", "Kw", "K")
_COORDINATE = ("dLdqd", "ddt", "dLdq", "g")
_ROW = ("A", "H")
_ENTRY = re.compile(r"([dDmMbB]|[cC])([0-9])([0-9])([0-9])?")


@dataclass(frozen=True, slots=True)
class AnswerNames:
    """The answers of one robot: `forces` are the names of the generalized forces (tau1, f2)."""

    rows: int
    forces: Sequence[str]
    bodies: Sequence[str]

    def canonical(self, name: str) -> str | None:
        """The form in which a name of an answer is kept, None for what is none."""
        name = name.strip()
        name = _WHOLE.get(name, name)
        if name in self._all():
            return name
        indexed = re.fullmatch(r"(tau|f|phi|G)([0-9]+)", name)
        if indexed and 1 <= int(indexed[2][:4]) <= len(self.forces):
            index = int(indexed[2])
            return self.forces[index - 1] if indexed[1] in ("tau", "f") else f"g{index}"
        return self._entry(name)

    def _entry(self, name: str) -> str | None:
        """d11, C12, c121: an entry of D, of C, a Christoffel symbol."""
        entry = _ENTRY.fullmatch(name)
        if not entry or any(not 1 <= int(digit) <= len(self.forces) for digit in entry.groups()[1:] if digit):
            return None
        letter, digits = entry[1].lower(), "".join(digit for digit in entry.groups()[1:] if digit)
        if letter == "c":
            return f"c{digits}" if len(digits) == 3 else f"C{digits}"
        return f"d{digits}" if len(digits) == 2 else None

    def _all(self) -> frozenset[str]:
        return frozenset(self.examples())

    def examples(self) -> Iterator[str]:
        """Every name but the entries of matrices."""
        yield from _WHOLES
        yield from self.forces
        yield from (f"{letter}{i}" for letter in _ROW for i in range(1, self.rows + 1))
        yield from (f"{letter}{i}" for letter in _COORDINATE for i in range(1, len(self.forces) + 1))
        yield from (f"{letter}{name}" for letter in _BODY for name in self.bodies)
