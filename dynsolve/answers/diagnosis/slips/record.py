"""What a slip is, and the problems of the examples."""

from __future__ import annotations

from dataclasses import dataclass, field

from dynsolve.answers.verdict import Diagnosis


@dataclass(frozen=True, slots=True)
class Example:
    """A hand-in that shows a slip: `name` of `problem` with a wrong value, other answers beside it."""

    problem: str
    name: str
    value: str | list[list[str]]
    beside: dict[str, str | list[list[str]]] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Slip:
    """A slip: `code`, its class in a few words, the message, and what to look at.

    `omits`: a part of the derivation was left out, which is tried before what was done otherwise.
    """

    code: str
    kind: str
    message: str
    look: str
    example: Example | None = None
    omits: bool = False

    def told(self, **what: str) -> Diagnosis:
        """The slip as it happened."""
        return Diagnosis(self.code, self.message.format(**what), self.kind, self.look.format(**what))


IN3140 = "in3140-rp"
PLANAR_2R = "planar-2r"
"""Problems of the library."""

HELD = """
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
velocity: [v, 0]
forces: [{link: 2, force: [0, F, 0], moment: [0, 0, M]}]
find: [qd, Q, tau_static]
"""
"""An arm at rest, on which a force and a moment act."""
