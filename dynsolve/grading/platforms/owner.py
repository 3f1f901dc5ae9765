"""Whose file it is, as a platform's name of it says."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class FileOwner:
    """Whose file it is: `student` names the row, `id` is the platform's own, empty where there is none.

    `delivery` is what was handed in at once: its files belong together, another delivery
    of the same student is another copy.  `late` are the
    days that it is late, begun ones counted.  `order` grows with the delivery; `name` is the
    file's own name.  A loose file's name is not `certain` to be a student's: what stands
    in the file wins.
    """

    student: str
    id: str
    delivery: str
    name: str
    late: int = 0
    order: int = 0
    certain: bool = True
