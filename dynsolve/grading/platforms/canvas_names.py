"""The names that Canvas gives to the files of a download (its `lib/content_zipper.rb`)."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import PurePosixPath

_NAMED = re.compile(
    r"(?P<who>[^/]+?)_(?P<late>LATE_)?(?P<user>\d+)_(?:(?P<file>\d+)_(?P<name>.+)|(?P<page>text|link)\.html)"
)
_ANONYMOUS = re.compile(
    r"(?P<late>LATE_)?(?P<who>anon)_(?P<user>[^_]+)_"
    r"(?:(?P<file>\d+)_(?P<name>.+)|(?P<page>text|link)\.html)"
)


@dataclass(frozen=True, slots=True)
class CanvasName:
    """The parts of a name: whose, the number of the student, that of the file, and the file's own name.

    A text or an address that was entered has a `page` and no file.
    """

    text: str
    who: str
    user: str
    late: bool
    file: str
    name: str
    page: str

    @property
    def ending(self) -> str:
        """The ending of the file's own name."""
        return PurePosixPath(self.name).suffix.lower()

    def with_name(self, name: str) -> str:
        """The whole name with another name for the file itself."""
        return self.text.removesuffix(self.name) + name


def canvas_name(text: str) -> CanvasName | None:
    """The parts of a name, None where it is none of Canvas's.

    Canvas takes `_<digits>_` out of names, so that the first such number is the user's.

    >>> found = canvas_name("lovelaceada_LATE_101_9001_rp.yaml")
    >>> found.user, found.file, found.late, found.with_name("elbow_rp.yaml")
    ('101', '9001', True, 'lovelaceada_LATE_101_9001_elbow_rp.yaml')
    """
    found = _ANONYMOUS.fullmatch(text) or _NAMED.fullmatch(text)
    if found is None:
        return None
    who, user, late = found["who"], found["user"], bool(found["late"])
    return CanvasName(text, who, user, late, found["file"] or "", found["name"] or "", found["page"] or "")
