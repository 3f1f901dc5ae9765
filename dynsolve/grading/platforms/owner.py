"""Whose file it is, as a platform's name of it says, and who there is, as its list of students says."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class FileOwner:
    """Whose file it is: `student` names the row, `id` is the platform's own, empty where there is none.

    `delivery` is what was handed in at once: its files belong together, another delivery
    of the same student is another copy.  `late` are the
    days that it is late, begun ones counted.  `order` grows with the delivery; `name` is the
    file's own name.  A loose file's name is not `certain` to be a student's: what stands
    in the file wins.  `group` is whose it is in the names of the files where a group handed it in.
    `called` is what people call the student, where the platform's name says it.
    """

    student: str
    id: str
    delivery: str
    name: str
    late: int = 0
    order: int = 0
    certain: bool = True
    group: str = ""
    called: str = ""


@dataclass(frozen=True, slots=True)
class Person:
    """A student of a platform's list: `student` as the names of the files have it, the platform's `id`.

    `name` is what people call the student, `group` the group that the list puts them in; `also`
    are other things that the list says of this student alone, such as an address.
    """

    student: str
    id: str
    name: str
    group: str = ""
    also: tuple[str, ...] = ()

    def is_called(self, said: str) -> bool:
        """Whether this is what the student is called.

        >>> person = Person("Ada Lovelace_41", "41", "Ada Lovelace", also=("ada@uni.example",))
        >>> [person.is_called(said) for said in ("41", "Ada Lovelace", "ada@uni.example", "Ada", "")]
        [True, True, True, False, False]
        """
        return bool(said) and said in (self.student, self.id, self.name, *self.also)
