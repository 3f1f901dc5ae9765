"""Problem files: bytes -> Problem, with all errors of a file at once.

The way goes text -> YAML nodes -> parsed file (every expression read, every name known)
-> robot (every value exact).  Each step reports what it finds and goes on with
what is sound; the errors are raised together at the end.

The problems that come with dynsolve, by the stem of their file.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from difflib import get_close_matches
from pathlib import Path
from typing import TYPE_CHECKING

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.errors import Finding, ProblemError
from dynsolve.problem.base import NO_BASE, NO_GRAVITY, Framed, read_base, read_gravity
from dynsolve.problem.bodies import DrawnFrames, read_bodies
from dynsolve.problem.build import build_robot
from dynsolve.problem.cells import Cell
from dynsolve.problem.decoder import Decoder
from dynsolve.problem.exercise import read_exercise
from dynsolve.problem.kinds import Fields, describe, free_text, word
from dynsolve.problem.model import FilePlace, Problem, read_accepted_tables
from dynsolve.problem.parsed import ParsedFile, check_size, check_symbols
from dynsolve.problem.questions import read_questions
from dynsolve.problem.specification import ACTION_KEYS, CONVENTION, DRAWING, EDITION, OF_A_TABLE, PROBLEM
from dynsolve.problem.table import DHTable, read_table
from dynsolve.problem.yaml_nodes import (
    MAX_BYTES,
    Faults,
    ListNode,
    MappingNode,
    YamlNode,
    as_source,
    read_nodes,
)
from dynsolve.robot.model import Convention, Robot

if TYPE_CHECKING:
    from dynsolve.problem.mechanism import Candidates, Model
    from dynsolve.problem.variation import Variation

_AXES = "delete it, or give the joint axes of a drawing in place of `dh`"


class Reading(Struct, frozen=True):
    """A problem with what its file says, and with its faults, which know the text."""

    problem: Problem
    parsed: ParsedFile
    fields: Fields
    faults: Faults
    variation: Variation | None = None


def load(path: str | os.PathLike[str]) -> Problem:
    """Read a problem file.

    Raises ProblemError with every fault of the file, or for a file that cannot be read.
    """
    return read_problem(read_file(path), os.fspath(path))


def read_file(path: str | os.PathLike[str]) -> bytes:
    """The bytes of a file, of a large one no more than shows that it is too large.

    Raises ProblemError for a file that cannot be read.
    """
    file = os.fspath(path)
    try:
        with Path(file).open("rb") as stream:
            return stream.read(MAX_BYTES + 1)
    except OSError as error:
        message = f"the file cannot be read: {(error.strerror or str(error)).lower()}"
    except ValueError:
        file, message = file.replace("\0", "?"), "this is no path"
    raise ProblemError([Finding(message, "check the path", file)])


def read_problem(content: str | bytes, file: str = "") -> Problem:
    r"""Read the text of a problem file; `file` is the name that errors carry.

    Raises ProblemError with every fault of the text.

    >>> text = "dh: [{theta: q1*, a: l1}]\ngravity: [0, -g, 0]\nmasses: [{mass: m1, link: 1}]"
    >>> [c.name for c in read_problem(text).robot.coordinates]
    ['q1']
    """
    return read_whole(content, file).problem


def read_whole(content: str | bytes, file: str = "") -> Reading:
    """Read a problem and keep what it was made from; see `read_problem`."""
    faults = Faults(as_source(content, file))
    root = read_nodes(faults)
    fields = _root_fields(faults, root)
    if fields is None:
        faults.raise_errors()
        raise AssertionError("a file without a root has an error")
    parsed = _parsed(faults, fields)
    if not check_size(faults, parsed):
        faults.raise_errors()
    check_symbols(faults, parsed)
    exercise = read_exercise(faults, fields, parsed)
    accepted = read_accepted_tables(faults, fields)
    edition = word(faults, fields.get("edition"), EDITION.choices, "edition", PROBLEM["edition"].help)
    title = free_text(faults, fields.get("title"), "title") or Path(file).stem
    source = free_text(faults, fields.get("source"), "source")
    variation = _variation(faults, root) if "vary" in fields else None
    robot = build_robot(faults, parsed, exercise.asked, exercise.written)
    if robot is not None:
        _check_task(faults, fields, robot)
    faults.raise_errors()
    assert robot is not None
    problem = Problem(
        title=title,
        source=source,
        file=file,
        robot=robot,
        convention=robot.convention,
        find=exercise.find,
        marks=exercise.marks,
        values=exercise.values,
        written=exercise.written,
        units=exercise.units,
        remarks=exercise.remarks,
        text=exercise.text,
        normals=parsed.normals,
        accepted=accepted,
        edition=int(edition or 1),
        places=dict(_places(faults, root)),
        warnings=tuple(faults.warnings),
    )
    return Reading(problem, parsed, fields, faults, variation)


def _variation(faults: Faults, root: YamlNode | None) -> Variation | None:
    from dynsolve.problem.variation import variation_of

    return variation_of(faults, root) if isinstance(root, MappingNode) else None


def _check_task(faults: Faults, fields: Fields, robot: Robot) -> None:
    """The tip moves, where its coordinates are the task."""
    task = robot.questions.task
    if task is not None and task.is_default and not task.entries:
        asking = (fields.get(key) for key in ("find", "marks", "velocity", "acceleration"))
        span = next((node.span for node in asking if node is not None), (0, 0))
        help = "say what it is to do: task: [q1], task: [P.x] of a point of `points`, or task: twist"
        faults.error(span, "the tip of this arm does not move, so that it has no task", help)


def _root_fields(faults: Faults, root: YamlNode | None) -> Fields | None:
    if isinstance(root, MappingNode):
        return Fields(faults, root, PROBLEM.names, "a problem file")
    if not faults.errors:
        help = "`dynsolve new problem.yaml` writes one to start from"
        message = (
            "the file is empty" if root is None else f"the file is {describe(root)}, not keys with values"
        )
        faults.error(root.span if root else (0, 0), message, help)
    return None


def _parsed(faults: Faults, fields: Fields) -> ParsedFile:
    named = word(
        faults, fields.get("convention"), CONVENTION.choices, "convention", PROBLEM["convention"].help
    )
    convention = Convention(named or "standard")
    model = _model(faults, fields) if "model" in fields else None
    framed = _framed(faults, fields, convention, model)
    table = framed.table
    candidates = _candidates(faults, fields, dict(table.coordinates))
    coordinates = dict(table.coordinates)
    rows = len(table.rows)
    drawn = DrawnFrames.of(framed.normals, table.coordinates)
    decoder = Decoder(faults, coordinates, rows)
    bodies = read_bodies(decoder, fields, drawn)
    acting = None
    if any(key.name in fields for key in ACTION_KEYS):
        from dynsolve.problem.acting import check_bodies, read_actions

        acting = read_actions(Decoder(faults, coordinates, rows), fields)
        has_mass = bool(bodies) or model is not None
        check_bodies(faults, fields, acting, [body["name"] for body in bodies], has_mass)
    return ParsedFile(
        convention=convention,
        table=table,
        gravity=_gravity(faults, fields, table, model),
        base=framed.base,
        bodies=bodies,
        questions=read_questions(faults, fields, rows, coordinates, [body["name"] for body in bodies], drawn),
        normals=framed.normals,
        drawn=framed.drawn,
        model=model,
        acting=acting,
        stated=(
            *decoder.stated,
            *(model.stated if model else ()),
            *(candidates.stated if candidates else ()),
        ),
        candidates=candidates,
    )


def _of_matrices(faults: Faults, fields: Fields) -> dict[str, str]:
    """The coordinates of candidates, with their types; keys that need a robot are reported."""
    for key in OF_A_TABLE:
        if key in fields and key != "coordinates":
            message = f"`{key}` stands beside `candidates`, which are of no robot"
            faults.error(fields.key_span(key), message, "delete it, or delete `candidates`")
    example = "write coordinates: {q1: revolute, q2: prismatic}"
    if "coordinates" not in fields:
        faults.error(fields.key_span("candidates"), "the candidates have no `coordinates`", example)
    from dynsolve.problem.mechanism import read_types

    return read_types(faults, fields.get("coordinates"), example)


def _gravity(faults: Faults, fields: Fields, table: DHTable, model: Model | None) -> tuple[Cell, ...] | None:
    """The acceleration of gravity, which acts on bodies: a model that is given without them has none."""
    if "candidates" in fields and model is None:
        return NO_GRAVITY
    if model is None or model.bodies or model.faulty:
        return read_gravity(faults, fields, table.names)
    if "gravity" in fields:
        message = "gravity has no effect: the energies of the model are given"
        faults.warn(fields.key_span("gravity"), message, "delete it; P holds what gravity does", "no-effect")
    return NO_GRAVITY


def _model(faults: Faults, fields: Fields) -> Model:
    """The model in the place of a table; keys that need a table are reported."""
    refused = [key for key in OF_A_TABLE if key in fields]
    for key in refused:
        message = f"`{key}` stands beside `model`, which has no table"
        faults.error(fields.key_span(key), message, "delete it, or give a `dh` table in place of `model`")
        fields.refuse(key)
    from dynsolve.problem.mechanism import read_model

    model = read_model(faults, fields.get("model"))
    return replace(model, faulty=model.faulty or bool(refused))  # which answers there would be is not known


def _candidates(faults: Faults, fields: Fields, coordinates: Mapping[str, str]) -> Candidates | None:
    """Matrices in the place of a robot, or what is assumed of parameters; None without either."""
    if not ("candidates" in fields or "assume" in fields or ("model" in fields and "find" in fields)):
        return None
    from dynsolve.problem.mechanism import read_candidates

    return read_candidates(faults, fields, coordinates)


def _framed(faults: Faults, fields: Fields, convention: Convention, model: Model | None) -> Framed:
    """The table and the base: as they are given, or found from a drawing; of a model the coordinates."""
    if model is not None:
        return Framed(DHTable((), model.coordinates), NO_BASE)
    if "candidates" in fields:
        return Framed(DHTable((), tuple(_of_matrices(faults, fields).items())), NO_BASE)
    if "axes" in fields:
        from dynsolve.problem.drawing import from_drawing, read_drawing

        return from_drawing(faults, read_drawing(faults, fields), convention)
    for key in DRAWING:
        if key in fields:
            faults.error(fields.key_span(key), f"`{key}` belongs to `axes`, and there are none", _AXES)
    table = read_table(faults, fields, convention is Convention.MODIFIED)
    return Framed(table, read_base(faults, fields.get("base"), table.names))


def _places(faults: Faults, root: YamlNode | None) -> list[tuple[tuple[str | int, ...], FilePlace]]:
    """Where every part of the file stands."""
    found: list[tuple[tuple[str | int, ...], FilePlace]] = []
    waiting: list[tuple[tuple[str | int, ...], YamlNode]] = [((), root)] if root else []
    while waiting:
        path, node = waiting.pop()
        if path:
            finding = faults.source.finding(*node.span, "")
            found.append((path, FilePlace(finding.line, finding.column, finding.length, finding.excerpt)))
        if isinstance(node, MappingNode):
            waiting += [((*path, key.decoded), value) for key, value in node.entries]
        elif isinstance(node, ListNode):
            waiting += [((*path, index), item) for index, item in enumerate(node.items)]
    return found


# The problems that come with dynsolve, by the stem of their file

ENDINGS = (".yaml", ".yml")


def folder() -> Path:
    """The folder of the bundled problems: in the installed package, or beside it in a source tree."""
    package = Path(__file__).parent.parent
    inside = package / "problems"
    return inside if inside.is_dir() else package.parent / "problems"


def bundled() -> Mapping[str, Path]:
    """Every bundled problem file by its stem, in alphabetical order."""
    return {path.stem: path for path in sorted(folder().glob("*.yaml"))}


def find(name: str) -> Path:
    """The file that a path or the stem of a bundled problem names.

    Raises ProblemError where there is none.

    >>> find("planar-2r").name
    'planar-2r.yaml'
    """
    path = Path(name)
    if path.exists() or path.suffix in ENDINGS or path.name != name:
        return path
    known = bundled()
    if name in known:
        return known[name]
    close = get_close_matches(name, known, n=1)
    help = (
        f"did you mean `{close[0]}`?" if close else "`dynsolve problems` lists those that come with dynsolve"
    )
    raise ProblemError([Finding("no such file, and no bundled problem of that name", help, name)])
