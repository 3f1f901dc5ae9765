"""Who the members of a group are, and so whose its files: the platform's list and `groups.csv` say so."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import replace
from unicodedata import normalize

from dynsolve.grading.groups import Membership
from dynsolve.grading.platforms.owner import FileOwner, Person

_REMOVED = re.compile(r"""[\x00-\x1f\x7f&<>"`|':\\/]|\.\.+""")
"""What Moodle takes out of the names of files (`clean_filename`)."""

_NUMBER = re.compile(r"(?:.*_)?(\d+)", re.DOTALL)


class Groups:
    """Whose a group's files are: its members' as `listed`, else as the platform says of its `people`.

    Of groups that are not known they are the group's own.
    """

    def __init__(self, listed: Iterable[Membership] = (), people: Iterable[Person] = ()) -> None:
        people = tuple(people)
        self._by_id = {person.id: person for person in people if person.id}
        self._platform_has_groups = any(person.group for person in people)
        members: dict[str, dict[str, Person]] = {}
        for person in people:
            if person.group:
                members.setdefault(person.group, {})[person.student] = person
        said: dict[str, dict[str, Person]] = {}
        for one in listed:
            person = _person(one.student, people)
            said.setdefault(one.group, {})[person.student] = person
        self._members = _by_spelling({**members, **said})

    def of(self, owner: FileOwner) -> tuple[FileOwner, ...]:
        """The members of the group that a file is of, else its owner.

        >>> groups = Groups([Membership("Group A", "41"), Membership("Group A", "42")])
        >>> [member.student for member in groups.of(FileOwner("Group A_77", "77", "", "hw.md"))]
        ['41', '42']
        """
        called = owner.student.removesuffix(f"_{owner.id}") if owner.id else owner.student
        spelled = (spell(name) for spell in (_in_moodle, _in_canvas) for name in (owner.student, called))
        members = next((self._members[name] for name in spelled if name in self._members), ())
        if members:
            return tuple(
                replace(
                    owner,
                    student=member.student,
                    id=member.id,
                    group=owner.student,
                    certain=True,
                    called=member.name,
                )
                for member in members
            )
        return (replace(owner, id="") if self._is_unknown_group(owner) else owner,)

    def _is_unknown_group(self, owner: FileOwner) -> bool:
        """Whether the number is that of a group that nothing is known of, and no student's."""
        if not (self._platform_has_groups and owner.id):
            return False
        person = self._by_id.get(owner.id)
        return person is None or _in_moodle(person.name) not in _in_moodle(owner.student)


def _person(said: str, people: tuple[Person, ...]) -> Person:
    """The one student who is called so; else somebody of this name, with the number that it ends in."""
    found = [person for person in people if person.is_called(said)]
    if len(found) == 1:
        return found[0]
    number = _NUMBER.fullmatch(said)
    return Person(said, number[1] if number else "", said)


def _by_spelling(groups: Mapping[str, Mapping[str, Person]]) -> dict[str, tuple[Person, ...]]:
    """The members by each way that a platform writes a group's name; not where that is another's, too."""
    spelled: dict[str, set[str]] = {}
    for name in groups:
        for spelling in {_in_moodle(name), _in_canvas(name)}:
            spelled.setdefault(spelling, set()).add(name)
    return {
        spelling: tuple(groups[name].values())
        for spelling, names in spelled.items()
        for name in names
        if len(names) == 1 and spelling
    }


def _in_moodle(name: str) -> str:
    """A name as Moodle puts it into the names of files.

    >>> _in_moodle("Group_A: best")
    'Group A best'
    """
    return _REMOVED.sub("", normalize("NFC", name).replace("_", " ")).strip()


def _in_canvas(name: str) -> str:
    """A name as Canvas puts it into the names of files.

    >>> _in_canvas("Group A")
    'groupa'
    """
    return re.sub(r"[\W_]", "", normalize("NFC", name).casefold())
