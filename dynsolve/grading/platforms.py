"""Whose file it is, from its name, as each learning platform names what it hands out.

To add a platform, write a function of the path's parts that gives an `Owner` or None,
and put it into `_PLATFORMS`.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import PurePosixPath
from typing import Any

from dynsolve.grading.uploads import printable

METADATA = "submission_metadata.yml"
MAX_METADATA = 30_000_000


@dataclass(frozen=True, slots=True)
class Owner:
    """Whose file it is: `student` names the row, `id` is the platform's own, empty where there is none.

    `delivery` is what was handed in at once: its files belong together, another delivery
    of the same student is another copy.  `order` grows with the delivery; `name` is the
    file's own name.  A loose file's name is not `certain` to be a student's: what stands
    in the file wins.
    """

    student: str
    id: str
    delivery: str
    name: str
    late: bool = False
    order: int = 0
    certain: bool = True


_CANVAS = re.compile(
    r"(?P<who>[^_/]+)(?P<late>_LATE)?_(?P<user>\d+)_(?:(?P<file>\d+)_(?P<name>.+)|(?P<text>text\.html))"
)
_ANONYMOUS = re.compile(r"(?P<late>LATE_)?anon_(?P<user>[^_]+)_(?:(?P<file>\d+)_)?(?P<name>.+)")
_MOODLE = re.compile(r"(?P<who>.+)_(?P<id>\d+)_assignsubmission_(?:file|onlinetext)_?(?P<name>.*)", re.DOTALL)


def _canvas(parts: tuple[str, ...]) -> Owner | None:
    """`<lastfirst>[_LATE]_<user id>_<attachment id>_<name>`, `..._text.html`, `[LATE_]anon_<id>_...`."""
    if len(parts) > 1:
        return None
    found = _ANONYMOUS.fullmatch(parts[0])
    who = "anon"
    if found is None:
        found = _CANVAS.fullmatch(parts[0])
        if found is None:
            return None
        who = found["who"]
    late = bool(found["late"])
    name = found["name"] or "text.html"
    order = int((found["file"] or "0")[:18])
    return Owner(f"{who}_{found['user']}", found["user"], "late" if late else "", name, late, order)


def _moodle(parts: tuple[str, ...]) -> Owner | None:
    """`<Full name>_<participant id>_assignsubmission_file[_]/<path>`, or the same without folders."""
    for place, part in enumerate(parts):
        found = _MOODLE.fullmatch(part)
        if found is not None:
            rest = [piece for piece in (found["name"], *parts[place + 1 :]) if piece]
            name = "/".join(rest) or "onlinetext.html"
            return Owner(f"{found['who']}_{found['id']}", found["id"], "", name)
    return None


_PLATFORMS: tuple[Callable[[tuple[str, ...]], Owner | None], ...] = (_moodle, _canvas)


class Owners:
    """Tells whose file each one is; `files` are all that were handed in, `metadata` is Gradescope's."""

    def __init__(self, files: Iterable[PurePosixPath], metadata: Mapping[str, Any] | None = None) -> None:
        self.depth = _wrapping(list(files))
        self.submitters = metadata or {}

    def of(self, path: PurePosixPath) -> tuple[Owner, ...]:
        """The owners of a file: one, or the members of a group."""
        parts = path.parts[self.depth :] if len(path.parts) > self.depth else path.parts
        for place, part in enumerate(path.parts[:-1]):
            if part in self.submitters or re.fullmatch(r"submission_\d+", part):
                return self._gradescope(part, "/".join(path.parts[place + 1 :]))
        for platform in _PLATFORMS:
            owner = platform(parts)
            if owner is not None:
                return (owner,)
        if len(parts) > 1:
            return (Owner(parts[0], "", parts[0], "/".join(parts[1:])),)
        stem = PurePosixPath(parts[0]).stem
        return (Owner(stem, "", stem, parts[0], certain=False),)

    def _gradescope(self, submission: str, name: str) -> tuple[Owner, ...]:
        number = submission.removeprefix("submission_")
        order = int(number[:18]) if number.isdigit() else 0
        entry = self.submitters.get(submission)
        found = entry.get(":submitters", ()) if isinstance(entry, dict) else ()
        owners = []
        for one in found if isinstance(found, list) else ():
            if isinstance(one, dict):
                student = next((one[key] for key in (":sid", ":email", ":name") if one.get(key)), "")
                if isinstance(student, str) and student:
                    owners.append(Owner(printable(student), submission, submission, name, order=order))
        return tuple(owners) or (Owner(submission, submission, submission, name, order=order),)


def _wrapping(files: list[PurePosixPath]) -> int:
    """How many folders stand around everything: 1 where a download lies in a folder of its own."""
    if not files or any(len(path.parts) < 2 for path in files):
        return 0
    if len({path.parts[0] for path in files}) > 1 or _MOODLE.fullmatch(files[0].parts[0]):
        return 0
    inside = all(len(path.parts) > 2 for path in files) and len({p.parts[1] for p in files}) > 1
    return int(inside or all(_canvas(path.parts[1:]) is not None for path in files))


def is_metadata(path: PurePosixPath) -> bool:
    """Whether a file is Gradescope's list of who handed in what."""
    return path.name == METADATA


def read_metadata(content: bytes) -> dict[str, Any]:
    r"""Gradescope's list: scalars stay text, tags mean nothing, so that nothing is constructed.

    >>> read_metadata(b"submission_1:\n  :submitters:\n  - :name: A\n    :sid: '007'\n")
    {'submission_1': {':submitters': [{':name': 'A', ':sid': '007'}]}}
    """
    import yaml

    loader: Any = getattr(yaml, "CBaseLoader", yaml.BaseLoader)
    try:
        data = yaml.load(content[:MAX_METADATA], Loader=loader)  # noqa: S506
    except (yaml.YAMLError, RecursionError, ValueError):
        return {}
    return data if isinstance(data, dict) else {}
