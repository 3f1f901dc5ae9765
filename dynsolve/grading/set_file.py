"""Reading what is graded: a problem, or a folder of problems with a `set.yaml`.

    title: Assignment 2
    problems: [in3140-rp.yaml, planar-2r.yaml]     # the order; default: every file, by name
    marks: {in3140-rp: {P: 2, K: 4, tau: 6}}       # wins over the problem files' own `marks`
    policy: {follow: 1/2, caps: {energy: 5}, rounding: 0.5, late: 0.8, hints: 2}

Beside it may lie an `extensions.csv` (`extensions`) and a `groups.csv` (`groups`).

Every fault of the file is reported at its place, as in problem files.

Every key of a `set.yaml`, said once: for its reader, its JSON Schema and the documentation.

To add one, write its record here and read it in `set_file.py`.

What is graded: problems with their marks and a policy, and how the record keeps them.

Groups: what a group handed in counts for each of its members, in `groups.csv` beside the `set.yaml`.

    group,student
    Group A,41
    Group A,ada@uni.example

A group is called as its files are; a student as in `grades.csv`, or as the platform's list says:
by number, name or address.  `platforms.registry` has whose the files are.
"""

from __future__ import annotations

import csv
import json
import re
from collections.abc import Iterable, Mapping
from fractions import Fraction
from pathlib import Path, PurePath
from typing import TYPE_CHECKING

from msgspec import Struct, field
from msgspec.structs import replace

from dynsolve.algebra.rationals import rational_value
from dynsolve.answers.marks import Policy, from_data, shown, to_data
from dynsolve.errors import Finding, ProblemError, UsageError
from dynsolve.grading.files import folder_name
from dynsolve.grading.record import Record
from dynsolve.grading.uploads import Extension, Fault, read_extensions, read_list
from dynsolve.problem.cells import read_cell
from dynsolve.problem.exercise import answer_meant
from dynsolve.problem.kinds import (
    NAME,
    TEXT,
    Fields,
    Key,
    Keyed,
    ListOf,
    MapOf,
    OneOf,
    Plain,
    describe,
    did_you_mean,
    free_text,
    items,
    mapping,
    whole_number,
)
from dynsolve.problem.model import Problem
from dynsolve.problem.reader import Reading, find, read_file, read_problem, read_whole
from dynsolve.problem.schema import Schema, schema_of_file
from dynsolve.problem.specification import VARIED
from dynsolve.problem.yaml_nodes import (
    Faults,
    FaultyNode,
    ListNode,
    MappingNode,
    ScalarNode,
    Span,
    YamlNode,
    as_source,
    read_nodes,
)
from dynsolve.quantities.index import Quantities
from dynsolve.quantities.stages import Stage

if TYPE_CHECKING:
    from dynsolve.problem.variation import Variation

# Groups

FILE = "groups.csv"
_KEYS = ("group", "student")


class Membership(Struct, frozen=True):
    """A student of a group."""

    group: str
    student: str


def read_groups(folder: Path) -> tuple[Membership, ...]:
    """The members that a folder's `groups.csv` names; raises ProblemError for a faulty one."""
    return read_list(folder / FILE, _KEYS, _KEYS, _membership)


def _membership(cells: dict[str, str]) -> Membership | Fault:
    if not (cells["group"] and cells["student"]):
        return "a row names a group and a student", "write Group A,41"
    return Membership(cells["group"], cells["student"])


# What is graded: problems with their marks and a policy, and how the record keeps them


class Item(Struct, frozen=True):
    """One problem of a set, with the text it was read from; its `marks` are those that count.

    `variation` is what may differ from student to student, by the set or else by the problem.
    """

    problem: Problem
    text: str
    variation: Variation | None = None

    @property
    def stem(self) -> str:
        """The name by which hand-ins refer to it."""
        return self.problem.stem


class ProblemSet(Struct, frozen=True):
    """The problems of a course's assignment, in order, and how they are marked.

    With `variants` every student has problem files of his own: their texts, by student and problem.
    `letters` are the names in them that the problem has others for, by student and problem.
    """

    title: str
    items: tuple[Item, ...]
    policy: Policy = field(default_factory=Policy)
    extensions: tuple[Extension, ...] = ()
    groups: tuple[Membership, ...] = ()
    variants: Mapping[tuple[str, str], str] | None = None
    letters: Mapping[tuple[str, str], Mapping[str, str]] = field(default_factory=dict)

    @property
    def stems(self) -> tuple[str, ...]:
        """The problems by the name that hand-ins call them."""
        return tuple(item.stem for item in self.items)

    def item(self, stem: str, student: str = "") -> Item:
        """The problem of this name, that of a student as the student's variant has it."""
        found = next(item for item in self.items if item.stem == stem)
        text = (self.variants or {}).get((student, stem))
        return found if text is None else replace(found, text=text)

    def lacks_variant(self, stem: str, student: str) -> bool:
        """Whether a student has no variant where there are some."""
        return self.variants is not None and (student, stem) not in self.variants


# -- in the record -----------------------------------------------------------------------------------

_NAME = "set"


def store_set(record: Record, problems: ProblemSet) -> None:
    """Keep a problem set in the record, without the paths of its files."""
    items = [
        {
            "file": PurePath(item.problem.file).name,
            "text": item.text,
            "marks": {name: str(of) for name, of in item.problem.marks.items()},
        }
        for item in problems.items
    ]
    data = {"title": problems.title, "items": items, "policy": to_data(problems.policy)}
    record.set_run(_NAME, json.dumps(data, ensure_ascii=False))


def stored_set(record: Record) -> ProblemSet:
    """The problem set that the record was made with.

    Raises UsageError where there is none yet.
    """
    text = record.run(_NAME)
    if not text:
        raise UsageError("there are no grades in that folder yet: `dynsolve grade` makes them")
    data = json.loads(text)
    items = []
    for entry in data["items"]:
        marks = {name: Fraction(of) for name, of in entry["marks"].items()}
        problem = replace(read_problem(entry["text"], entry["file"]), marks=marks)
        items.append(Item(problem, entry["text"]))
    return ProblemSet(data["title"], tuple(items), from_data(data["policy"]))


def stored_policy(record: Record) -> Policy:
    """The policy that the record was made with."""
    text = record.run(_NAME)
    return from_data(json.loads(text)["policy"]) if text else Policy()


# Every key of a `set.yaml`, said once

_POINTS = Plain("a number", {"type": ["string", "number"], "description": "4, 0.5 or 1/2"})

CAPS = Keyed(tuple(Key(stage, _POINTS) for stage in Stage))

POLICY = Keyed(
    (
        Key(
            "follow",
            _POINTS,
            "The share that an answer earns which follows from an earlier slip. Default 1.",
            "1/2",
            "1",
        ),
        Key(
            "caps",
            CAPS,
            "The most marks that the answers of a stage earn together.",
            "{energy: 5}",
            "no caps",
        ),
        Key(
            "rounding",
            _POINTS,
            "The step that the marks of an answer are rounded to. Default 0.01.",
            "1/2",
            "0.01",
        ),
        Key(
            "late",
            OneOf((_POINTS, ListOf(_POINTS, "a list of shares"))),
            "The share that a late hand-in keeps of what it earns, where the platform says who was late; a "
            "list has the share of each day, the last for all later ones. Default 1.",
            "[0.9, 0.8, 0.5]",
            "1",
        ),
        Key(
            "hints",
            Plain("1, 2 or 3", {"enum": [1, 2, 3]}),
            "1 says where, 2 what kind of slip, 3 how. Default 3.",
            "2",
            "3",
            remedy="write 1 (where), 2 (what kind) or 3 (how)",
        ),
    )
)

SET = Keyed(
    (
        Key("title", TEXT, "The name of the assignment.", "Assignment 2", "the name of the folder"),
        Key(
            "problems",
            ListOf(NAME, "a list of files"),
            "The problem files, in order. Default: all of the folder.",
            "[a.yaml, b.yaml]",
            "all of the folder",
        ),
        Key(
            "marks",
            MapOf(MapOf(_POINTS, "points by answer"), "points by problem and answer"),
            "Points by problem and answer: {in3140-rp: {P: 2, K: 4}}.",
            "{in3140-rp: {P: 2, K: 4}}",
            "those of the problem files",
        ),
        Key(
            "vary",
            MapOf(VARIED, "what may vary by problem"),
            "What may differ from student to student, by problem, as the `vary` of a problem file.",
            "{in3140-rp: {letters: {L1: [L1, a]}}}",
            "that of the problem files",
        ),
        Key("policy", POLICY, example="{follow: 1/2, hints: 2}"),
    )
)
"""The keys of a `set.yaml`, in the order of the documentation."""


def set_schema() -> Schema:
    """The schema, as data that `json.dumps` prints.

    >>> sorted(set_schema()["properties"])
    ['marks', 'policy', 'problems', 'title', 'vary']
    """
    description = "The problems of a folder, and how hand-ins to them are marked."
    return schema_of_file(SET, "dynsolve problem set", description)


SET_FILE = "set.yaml"

VARIANT_KEYS, VARIANTS_TABLE = "keys", "variants.csv"
"""The folder of a student's own problem files, in the folder that `vary` writes."""


def with_variants(problems: ProblemSet, folder: Path, students: Iterable[str]) -> ProblemSet:
    """The problems with the variants of these students that `vary` wrote into a folder.

    Raises UsageError for a folder that it did not write.
    """
    if not (folder / VARIANT_KEYS).is_dir():
        raise UsageError(f"{folder} is no folder of variants", "give the folder that `dynsolve vary` wrote")
    found = {}
    for student in students:
        for stem in problems.stems:
            file = folder / VARIANT_KEYS / folder_name(student) / f"{stem}.yaml"
            if file.is_file():
                found[student, stem] = file.read_text(encoding="utf-8")
    return replace(problems, variants=found, letters=_letters(problems, folder / VARIANTS_TABLE))


def _letters(problems: ProblemSet, table: Path) -> dict[tuple[str, str], dict[str, str]]:
    """The problem's name of each name that was drawn for it, by student and problem."""
    variations = {item.stem: item.variation for item in problems.items}
    found: dict[tuple[str, str], dict[str, str]] = {}
    with table.open(encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file):
            variation, drawn = variations.get(row["problem"]), f"; {row['drawn']}"
            for name in variation.letters if variation else ():
                if new := re.search(rf"; {re.escape(name)}: (\w+)", drawn):
                    found.setdefault((row["student"], row["problem"]), {})[new[1]] = name
    return found


def load_set(name: str) -> ProblemSet:
    """The problem set of a folder, of a `set.yaml`, or of one problem (a path or a bundled stem).

    Raises ProblemError with every fault of the files.
    """
    path = Path(name)
    if path.is_dir():
        return _folder(path)
    if path.name == SET_FILE:
        return _folder(path.parent)
    reading, text = _read(find(name))
    problem = reading.problem
    return ProblemSet(problem.title, (Item(_marked(problem, {}), text, reading.variation),))


def _read(path: Path) -> tuple[Reading, str]:
    content = read_file(path)
    reading = read_whole(content, str(path))
    return reading, as_source(content, str(path)).text


def _folder(folder: Path) -> ProblemSet:
    file = folder / SET_FILE
    faults = Faults(as_source(read_file(file) if file.exists() else b"", str(file)))
    fields = _fields(faults) if file.exists() else None
    paths = _paths(faults, folder, fields.get("problems") if fields else None)
    readings: dict[str, tuple[Reading, str]] = {}
    findings: list[Finding] = []
    for path in paths:
        try:
            readings[path.stem] = _read(path)
        except ProblemError as error:
            findings += error.findings
    marks = _marks(faults, fields.get("marks") if fields else None, readings)
    varied = _varied(faults, fields.get("vary") if fields else None, readings)
    policy = _policy(faults, fields.get("policy") if fields else None)
    if faults.errors or findings:
        raise ProblemError([*faults.found(), *findings])
    title = (free_text(faults, fields.get("title"), "title") if fields else "") or folder.resolve().name
    chosen = tuple(
        Item(_marked(reading.problem, marks.get(stem, {})), text, varied.get(stem, reading.variation))
        for stem, (reading, text) in readings.items()
    )
    extensions, groups = read_extensions(folder, list(readings)), read_groups(folder)
    return ProblemSet(title, chosen, policy, extensions, groups)


def _fields(faults: Faults) -> Fields | None:
    root = read_nodes(faults)
    if isinstance(root, MappingNode):
        return Fields(faults, root, SET.names, "a set.yaml")
    if root is not None:
        message = f"the file is {describe(root)}, not keys with values"
        faults.error(root.span, message, f"known are {', '.join(SET.names)}")
    return None


def _paths(faults: Faults, folder: Path, node: YamlNode | None) -> list[Path]:
    """The files of the problems in their order; without a list all of the folder."""
    found: dict[str, Path] = {}
    for item in items(faults, node, "problems", SET["problems"].help):
        name = item.decoded if isinstance(item, ScalarNode) else ""
        path = folder / name
        if not path.suffix:
            path = path.with_suffix(".yaml")
        if not name or Path(name).is_absolute() or ".." in Path(name).parts or not path.is_file():
            known = [p.name for p in _files(folder)]
            help = did_you_mean(name, known) or f"the folder holds {', '.join(known[:10]) or 'none'}"
            faults.error(item.span, f"there is no problem file `{name[:80]}` in the folder", help)
        elif path.stem in found:
            faults.error(item.span, f"`{name[:80]}` is listed twice", "keep one of them")
        else:
            found[path.stem] = path
    if node is None:
        found = {path.stem: path for path in _files(folder)}
        if not found:
            message = "the folder holds no problem file"
            raise ProblemError([Finding(message, "put the .yaml files of the problems there", str(folder))])
    return list(found.values())


def _files(folder: Path) -> list[Path]:
    both = (*folder.glob("*.yaml"), *folder.glob("*.yml"))
    return sorted(path for path in both if path.name != SET_FILE)


def _marks(
    faults: Faults, node: YamlNode | None, readings: Mapping[str, tuple[Reading, str]]
) -> dict[str, dict[str, Fraction]]:
    fields = mapping(faults, node, tuple(readings), "marks", SET["marks"].help)
    found: dict[str, dict[str, Fraction]] = {}
    for stem in fields or ():
        assert fields is not None
        value, names = fields.get(stem), Quantities(readings[stem][0].parsed.owners)
        if not isinstance(value, MappingNode):
            faults.error(fields.span_of(stem), f"the marks of {stem} are a mapping", "write {P: 2, K: 4}")
            continue
        found[stem] = {}
        for key, points in value.entries:
            name = names.canonical(key.text)
            if name is None:
                help = answer_meant(names, key.text) or "answers are tau, D, C, g, P, K, L, K1, ..."
                faults.error(key.span, f"`{key.text[:40]}` is no answer of {stem}", help)
            elif name in found[stem]:
                faults.error(key.span, f"{name} has marks already", "keep one of them")
            else:
                found[stem][name] = _number(faults, points, f"the marks for {name}") or Fraction(0)
    return found


def _varied(
    faults: Faults, node: YamlNode | None, readings: Mapping[str, tuple[Reading, str]]
) -> dict[str, Variation | None]:
    """What may vary by problem."""
    mapping(faults, node, tuple(readings), "vary", SET["vary"].help)
    if not isinstance(node, MappingNode):
        return {}
    from dynsolve.problem.variation import variation_in_set

    return {
        key.decoded: variation_in_set(faults, key, value, readings[key.decoded][0].faults.source)
        for key, value in node.entries
        if key.decoded in readings
    }


def _policy(faults: Faults, node: YamlNode | None) -> Policy:
    fields = mapping(faults, node, POLICY.names, "policy", SET["policy"].help)
    if fields is None:
        return Policy()
    plain = Policy()
    hints = whole_number(faults, fields.get("hints"), "hints", POLICY["hints"].help)
    if hints is not None and not 1 <= hints <= 3:
        message = "hints are 1, 2 or 3"
        faults.error(fields.span_of("hints"), message, "1 says where, 2 what kind of slip, 3 how")
    follow = _share(faults, fields, "follow")
    late, *later = _late(faults, fields) or (plain.late,)
    step = _number(faults, fields.get("rounding"), "rounding") if "rounding" in fields else None
    if step == 0:
        faults.error(fields.span_of("rounding"), "marks cannot be rounded to steps of 0", "write 0.5 or 0.01")
    caps = mapping(faults, fields.get("caps"), CAPS.names, "caps", POLICY["caps"].help)
    return Policy(
        plain.follow if follow is None else follow,
        {
            stage: _number(faults, caps.get(stage), f"the cap of {stage}") or Fraction(0)
            for stage in caps or ()
        }
        if caps
        else {},
        step or plain.rounding,
        late,
        hints or plain.hints,
        tuple(later),
    )


def _share(faults: Faults, fields: Fields, key: str) -> Fraction | None:
    return _read_share(faults, fields.get(key), fields.span_of(key), key) if key in fields else None


def _late(faults: Faults, fields: Fields) -> list[Fraction]:
    """The shares that a late hand-in keeps: one, or one a day."""
    if "late" not in fields:
        return []
    node, span = fields.get("late"), fields.span_of("late")
    nodes = node.items if isinstance(node, ListNode) else (node,)
    shares = [_read_share(faults, one, one.span if one is not None else span, "late") for one in nodes]
    return [share for share in shares if share is not None]


def _read_share(faults: Faults, node: YamlNode | None, span: Span, key: str) -> Fraction | None:
    percent = (
        re.fullmatch(r"\s*(\d+(?:\.\d+)?)\s*%\s*", node.decoded) if isinstance(node, ScalarNode) else None
    )
    if percent:
        share = Fraction(percent[1]) / 100
        message = f"`{key}` is a share, not a percentage"
        faults.error(span, message, f"write {shown(share)}" if share <= 1 else "write 1/2 or 0.8")
        return None
    value = _number(faults, node, key)
    if value is not None and value > 1:
        faults.error(span, f"`{key}` is a share, at most 1", "write 1/2 or 0.8")
    return value


def _number(faults: Faults, node: YamlNode | None, what: str) -> Fraction | None:
    """A number that is not negative, None (reported) for anything else."""
    if isinstance(node, FaultyNode):
        return None
    cell = read_cell(faults, node, what)
    if cell is None:
        return None
    value = rational_value(cell.tree)
    if value is None:
        faults.error(cell.span, f"{what}: `{cell.text[:40]}` is not a number", "write a number: 4, 0.5, 1/2")
    elif value < 0:
        faults.error(cell.span, f"{what} cannot be negative", "write 0 or more")
    return value


def _marked(problem: Problem, marks: Mapping[str, Fraction]) -> Problem:
    """The problem with the marks that count: the set's, else its own, else one for each answer asked for."""
    return replace(problem, marks=dict(marks or problem.marks or dict.fromkeys(problem.find, Fraction(1))))
