"""The problems that come with dynsolve, by the stem of their file."""

from __future__ import annotations

from collections.abc import Mapping
from difflib import get_close_matches
from pathlib import Path

from dynsolve.errors import Finding, ProblemError

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
