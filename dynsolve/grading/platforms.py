"""Whose file it is, from its name, as each learning platform names what it hands out.

To add a platform, write a function of the path's parts that gives an `Owner` or None,
and put it into `_PLATFORMS`.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import PurePosixPath
from typing import Any
from unicodedata import normalize

from dynsolve.answers.reading.files import ENDINGS
from dynsolve.grading.uploads import printable

METADATA = "submission_metadata.yml"

Submitters = dict[str, tuple[dict[str, str], ...]]
"""Of each submission of Gradescope who handed it in: `:name`, `:sid`, `:email`."""

_SUBMITTERS = ":submitters"
_DEEPEST = 100
_MOST_AROUND = 4


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
    r"(?P<who>[^/]+?)_(?P<late>LATE_)?(?P<user>\d+)_(?:(?P<file>\d+)_(?P<name>.+)|(?P<page>text|link)\.html)"
)
_ANONYMOUS = re.compile(
    r"(?P<late>LATE_)?anon_(?P<user>[^_]+)_(?:(?P<file>\d+)_(?P<name>.+)|(?P<page>text|link)\.html)"
)
_PAGES = {"text": "text.html", "link": "link.url"}
"""A text that was entered is read as a page; what is behind an address is not fetched."""

_MOODLE = re.compile(r"(?P<who>.+?)_(?P<id>\d+)_assignsubmission_[a-z]+_?(?P<name>.*)", re.DOTALL)
_EXPORT, _SUBMISSION = re.compile(r"assignment_\d+_export"), re.compile(r"submission_\d+")


def _canvas(parts: tuple[str, ...]) -> Owner | None:
    """`<lastfirst>[_LATE]_<user id>_<attachment id>_<name>`, `..._text.html`, `[LATE_]anon_<id>_...`.

    Canvas takes `_<digits>_` out of names, so that the first such number is the user's.
    """
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
    name = found["name"] or _PAGES[found["page"]]
    order = int((found["file"] or "0")[:18])
    return Owner(f"{who}_{found['user']}", found["user"], "late" if late else "", name, late, order)


def _moodle(parts: tuple[str, ...]) -> Owner | None:
    """`<Full name>_<participant id>_assignsubmission_file[_]/<path>`, or the same without folders."""
    found = _MOODLE.fullmatch(parts[0])
    if found is None:
        return None
    rest = [piece for piece in (found["name"], *parts[1:]) if piece]
    return Owner(f"{found['who']}_{found['id']}", found["id"], "", "/".join(rest) or "onlinetext.html")


_PLATFORMS: tuple[Callable[[tuple[str, ...]], Owner | None], ...] = (_moodle, _canvas)


class Owners:
    """Tells whose file each one is; `files` are all that were handed in.

    `metadata` is Gradescope's, `late` are the platform's ids of those who were late, as
    far as it tells them elsewhere than in the names; `is_problem` tells whether a file's
    name is that of a problem.
    """

    def __init__(
        self,
        files: Iterable[PurePosixPath],
        metadata: Submitters | None = None,
        late: Collection[str] = (),
        is_problem: Callable[[str], bool] = lambda name: False,
    ) -> None:
        files = list(files)
        self.depth = _wrapping(files, is_problem)
        self.exports = exports(files)
        self.submitters = metadata or {}
        self.late = late

    def of(self, path: PurePosixPath) -> tuple[Owner, ...]:
        """The owners of a file: one, or the members of a group."""
        return tuple(
            replace(
                owner,
                student=normalize("NFC", owner.student),
                late=owner.late or owner.id in self.late,
            )
            for owner in self._of(path)
        )

    def _of(self, path: PurePosixPath) -> tuple[Owner, ...]:
        for export in self.exports:
            rest = path.parts[len(export) :]
            if path.parts[: len(export)] == export and rest:
                if len(rest) > 1 and (_SUBMISSION.fullmatch(rest[0]) or rest[0] in self.submitters):
                    return self._gradescope(rest[0], "/".join(rest[1:]))
                if rest[0] in self.submitters:
                    return self._gradescope(rest[0], rest[0])
        parts = path.parts[self.depth :] if len(path.parts) > self.depth else path.parts
        for platform in _PLATFORMS:
            owner = platform(parts)
            if owner is not None:
                return (owner,)
        if len(parts) > 1:
            return (Owner(parts[0], "", parts[0], "/".join(parts[1:])),)
        stem = PurePosixPath(parts[0]).stem
        return (Owner(stem, "", stem, parts[0], certain=False),)

    def _gradescope(self, submission: str, name: str) -> tuple[Owner, ...]:
        id = PurePosixPath(submission).stem
        number = id.removeprefix("submission_")
        order = int(number[:18]) if number.isdigit() else 0
        students = (_submitter(one, id) for one in self.submitters.get(submission, ()))
        return tuple(Owner(s, id, id, name, order=order) for s in students if s) or (
            Owner(id, id, id, name, order=order),
        )


def _submitter(one: Mapping[str, str], id: str) -> str:
    """What a student is called: by a number or an address; a name alone may be another's too."""
    known = [one.get(key, "").strip() for key in (":sid", ":email")]
    name = one.get(":name", "").strip()
    return printable(next(filter(None, known), f"{name} ({id})" if name else ""))


def exports(files: Iterable[PurePosixPath]) -> tuple[tuple[str, ...], ...]:
    """The folders that hold an export of Gradescope: `assignment_<id>_export`, or all that there is."""
    files = list(files)
    tops = {path.parts[0] for path in files}
    found: set[tuple[str, ...]] = {(top,) for top in tops if _EXPORT.fullmatch(top)}
    if any(_SUBMISSION.fullmatch(top) for top in tops) or PurePosixPath(METADATA) in files:
        found.add(())
    if len(tops) == 1 and any(_is_of_gradescope(path.parts[1:]) for path in files):
        found.add((files[0].parts[0],))
    return tuple(sorted(found, reverse=True))


def _is_of_gradescope(parts: tuple[str, ...]) -> bool:
    return parts == (METADATA,) or (len(parts) > 1 and bool(_SUBMISSION.fullmatch(parts[0])))


def _wrapping(files: list[PurePosixPath], is_problem: Callable[[str], bool]) -> int:
    """How many folders stand around everything: 1 where a download lies in a folder of its own.

    Files beside it that are no answers, such as a roster, do not matter.
    """
    level = [path.parts for path in files]
    for depth in range(_MOST_AROUND):
        if any(map(_is_of_platform, level)):
            return depth
        beside = any(len(parts) == 1 and _is_answer(parts[0]) for parts in level)
        if beside or len({parts[0] for parts in level if len(parts) > 1}) != 1:
            break
        level = [parts[1:] for parts in level if len(parts) > 1]
    return int(_is_around_students([path.parts for path in files], is_problem))


def _is_of_platform(parts: tuple[str, ...]) -> bool:
    return _canvas(parts) is not None or _MOODLE.fullmatch(parts[0]) is not None


def _is_answer(name: str) -> bool:
    return PurePosixPath(name).suffix.lower() in ENDINGS


def _is_around_students(files: list[tuple[str, ...]], is_problem: Callable[[str], bool]) -> bool:
    """Whether the one folder that there is holds a folder a student, or a file a student."""
    if any(len(parts) < 2 for parts in files) or len({parts[0] for parts in files}) != 1:
        return False
    loose = [parts[1] for parts in files if len(parts) == 2]
    if not loose:
        return len({parts[1] for parts in files}) > 1
    of_one = any(is_problem(PurePosixPath(name).stem) for name in loose)
    return sum(map(_is_answer, loose)) > 1 and len(loose) == len(files) and not of_one


def read_metadata(content: bytes) -> Submitters:
    r"""Gradescope's list of whose each submission is, as far as it can be read.

    It is read event by event: nothing is constructed, expanded or nested.

    >>> read_metadata(b"submission_1:\n  :submitters:\n  - :name: A\n    :sid: '007'\n  :score: 2\n")
    {'submission_1': ({':name': 'A', ':sid': '007'},)}
    """
    import yaml

    found: dict[str, list[dict[str, str]]] = {}
    open_: list[_OpenCollection] = []
    loader: Any = getattr(yaml, "CBaseLoader", yaml.BaseLoader)
    with suppress(yaml.YAMLError, ValueError):
        for event in yaml.parse(content, Loader=loader):
            if len(open_) > _DEEPEST:
                break
            if isinstance(event, yaml.CollectionStartEvent):
                if _kinds(open_) == "mms" and open_[1].key == _SUBMITTERS:
                    found.setdefault(open_[0].key or "", []).append({})
                open_.append(_OpenCollection("m" if isinstance(event, yaml.MappingStartEvent) else "s"))
            elif isinstance(event, yaml.CollectionEndEvent):
                open_.pop()
                if open_:
                    open_[-1].key = "" if open_[-1].key is None else None  # a key, or what stands at one
            elif isinstance(event, yaml.NodeEvent) and open_:
                _scalar(found, open_, event.value if isinstance(event, yaml.ScalarEvent) else "")
    return {submission: tuple(submitters) for submission, submitters in found.items()}


@dataclass(slots=True)
class _OpenCollection:
    """A collection that is being read: a mapping (m) with the key it is at, or a sequence (s)."""

    kind: str
    key: str | None = None


def _kinds(open_: list[_OpenCollection]) -> str:
    return "".join(one.kind for one in open_[:5])


def _scalar(found: dict[str, list[dict[str, str]]], open_: list[_OpenCollection], value: str) -> None:
    """A key of a mapping, or what stands at one."""
    last = open_[-1]
    if last.kind == "s":
        return
    if last.key is None:
        last.key = value
        return
    if _kinds(open_) == "mmsm" and open_[1].key == _SUBMITTERS:
        found[open_[0].key or ""][-1][last.key] = value
    last.key = None
