"""What several tests need: the library, files, solving a problem, and numbers for what comes out.

Results are taken from the JSON that `dynsolve solve --json` prints, the contract
with other programs, so that what is tested is what a user gets.
"""

from __future__ import annotations

import json
import math
import re
import sqlite3
from collections.abc import Iterable, Iterator, Mapping
from contextlib import closing
from functools import cache
from pathlib import Path
from types import CodeType
from typing import Any

import numpy as np

import dynsolve
from dynsolve.document import Document
from dynsolve.explain.abbreviations import Abbreviated
from dynsolve.explain.step import Detail, Step
from dynsolve.solution.documents import solution_documents
from dynsolve.solution.json_export import to_json

ROOT = Path(__file__).parent.parent
ALL_PROBLEMS = sorted((ROOT / "problems").glob("*.yaml"))
LIBRARY = [path for path in ALL_PROBLEMS if "\nmasses:" in path.read_text(encoding="utf-8")]
"""The problems of the library that have dynamics; the others ask for kinematics alone."""

STEMS = frozenset(path.stem for path in LIBRARY)

ACTING = frozenset(
    path.stem for path in LIBRARY if re.search(r"^(friction|springs|motors):", path.read_text("utf-8"), re.M)
)
"""Those on which more than gravity acts."""

COURSE_DOCUMENT = ROOT / "tests" / "golden" / "answers" / "dynamics-overview.md"
TEXTBOOKS = sorted((ROOT / "tests" / "golden" / "textbooks").glob("*.yaml"))

FUNCTIONS: dict[str, Any] = {
    "__builtins__": {},
    "sin": math.sin,
    "cos": math.cos,
    "sqrt": math.sqrt,
    "sgn": lambda x: math.copysign(1.0, x),
    "pi": math.pi,
}


def problem_file(name: str) -> Path:
    """The problem of a textbook, or else of the library."""
    textbook = ROOT / "tests" / "golden" / "textbooks" / f"{name}.yaml"
    return textbook if textbook.exists() else ROOT / "problems" / f"{name}.yaml"


def with_files(folder: Path, files: Mapping[str, str | bytes]) -> Path:
    """`folder` with these files in it, each by its path within."""
    for name, content in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return folder


def record_of(folder: Path) -> list[tuple[object, ...]]:
    """The rows of all tables of the record of a graded course, in an order of their own."""
    with closing(sqlite3.connect(folder / "grades.sqlite")) as db:
        tables = [name for (name,) in db.execute("SELECT name FROM sqlite_master WHERE type = 'table'")]
        rows = [(table, *row) for table in tables for row in db.execute(f"SELECT * FROM {table}")]  # noqa: S608
    return sorted(rows, key=repr)


def solved(problem: Path | str) -> dynsolve.Solution:
    """The solution of a problem, by its name, its path or its text: one for all tests of a process.

    What it has derived and written once, no other test waits for.
    """
    return _solved(_source(problem))


def document(problem: Path | str, detail: Detail = Detail.FULL) -> Document:
    """Its worked solution in a depth, one for all tests of a process, too."""
    return _documents(_source(problem))[detail]


def _source(problem: Path | str) -> Path | str:
    by_name = isinstance(problem, str) and "\n" not in problem
    return problem_file(str(problem)) if by_name else problem


@cache
def _documents(problem: Path | str) -> dict[Detail, Document]:
    """In every depth: most of the work is that of the steps, which all of them have."""
    depths = tuple(Detail)
    return dict(zip(depths, solution_documents(_solved(problem), depths), strict=True))


@cache
def _solved(problem: Path | str) -> dynsolve.Solution:
    return explained_once(dynsolve.solve(problem))


def explained_once(solution: dynsolve.Solution) -> dynsolve.Solution:
    """The same, whose steps in the names of an abbreviated model are told once for all its reports."""
    explain, told = solution.explain, dict[tuple[int, bool], tuple[Abbreviated | None, tuple[Step, ...]]]()

    def once(
        stages: Iterable[str] | None = None, short: Abbreviated | None = None, *, by_energies: bool = False
    ) -> Iterator[Step]:
        if stages is not None:
            return explain(stages, short, by_energies=by_energies)
        key = id(short), by_energies
        if key not in told:
            told[key] = short, tuple(explain(None, short, by_energies=by_energies))
        return iter(told[key][1])

    vars(solution)["explain"] = once
    return solution


def solve_json(problem: Path | str) -> dict[str, Any]:
    """The JSON of a solution without its steps; `problem` is a path, or the text of a problem file."""
    return _json_of(problem) if isinstance(problem, Path) else json_of(dynsolve.solve(problem))


@cache
def _json_of(problem: Path) -> dict[str, Any]:
    return json_of(solved(problem))


def json_of(solution: dynsolve.Solution) -> dict[str, Any]:
    """The JSON of a solution without its steps."""
    return json.loads(json.dumps(to_json(_Unexplained(solution))))


class _Unexplained:
    """A solution of which no step is told: to explain the results takes longer than to find them."""

    steps = ()

    def __init__(self, solution: dynsolve.Solution) -> None:
        self._solution = solution

    def __getattr__(self, name: str) -> Any:
        return getattr(self._solution, name)


def numbers(entries: Any, values: Mapping[str, float]) -> Any:
    """A string, or nested lists of strings, as a number or an array."""
    if isinstance(entries, str):
        return float(eval(_compiled(entries), dict(FUNCTIONS), dict(values)))  # noqa: S307
    return np.array([numbers(entry, values) for entry in entries], dtype=float)


@cache
def _compiled(text: str) -> CodeType:
    """To compile a result takes longer than to evaluate it, and it is wanted at several states."""
    return compile(text, "<result>", "eval")


def assert_close(ours: Any, theirs: Any, what: str, tolerance: float = 1e-9) -> None:
    """`ours` equals `theirs`, to `tolerance` of the largest entry."""
    ours, theirs = np.asarray(ours, dtype=float), np.asarray(theirs, dtype=float)
    assert ours.size == theirs.size, f"{what}: {ours.shape} is not {theirs.shape}"
    ours = ours.reshape(theirs.shape)
    scale = max(1.0, float(np.abs(theirs).max(initial=0.0)))
    error = float(np.abs(ours - theirs).max(initial=0.0)) / scale
    assert error <= tolerance, f"{what}: off by {error:.1e}\nours\n{ours}\ntheirs\n{theirs}"
