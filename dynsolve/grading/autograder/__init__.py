"""dynsolve as an autograder of Gradescope: students get their marks and their pages when they hand in.

    setup.sh        run once there, when the image is built: installs what dynsolve needs
    run_autograder  run there for every submission: starts the next
    __main__        judges the submission, and writes `results/results.json`

The layout is that of Gradescope's "Autograder Specifications" and "Submission Metadata"; everything lies
in /autograder, or where `AUTOGRADER_ROOT` says, so that it can be tried anywhere.

The zip that Gradescope is given, which is made here, holds the two scripts and

    requirements.txt     what this program needs, in the versions that it has here
    program/dynsolve/    this program, so that the marks there are those that it gives here
    course/              the problem set
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import suppress
from importlib import metadata
from pathlib import Path

import dynsolve
from dynsolve.errors import UsageError
from dynsolve.grading.platforms.moodle import zipped
from dynsolve.grading.set_file import SET_FILE, load_set
from dynsolve.grading.uploads import FILE as EXTENSIONS
from dynsolve.render.files import write_whole

COURSE, PROGRAM = "course", "program"
_SCRIPTS = ("setup.sh", "run_autograder")
_DOCUMENTS = "pypandoc-binary"
"""With it hand-ins of word processors are read there as they are here."""


def write_autograder(problems: str, path: Path) -> None:
    """Write the zip for a problem set: a folder, a problem file, or the stem of a bundled problem.

    Raises ProblemError for a faulty set, UsageError where the zip cannot be written.
    """
    course = dict(_course(problems))
    scripts = {name: (Path(__file__).parent / name).read_bytes() for name in _SCRIPTS}
    files = {**scripts, "requirements.txt": _requirements().encode(), **course, **dict(_program())}
    write_whole(path, zipped(files.items(), programs=_SCRIPTS))


def _course(problems: str) -> Iterator[tuple[str, bytes]]:
    """The problems with their set, read and found without fault."""
    chosen = load_set(problems)
    for item in chosen.items:
        yield f"{COURSE}/{Path(item.problem.file).name}", item.text.encode()
    given = Path(problems)
    folder = given if given.is_dir() else given.parent if given.name == SET_FILE else None
    for name in (SET_FILE, EXTENSIONS):
        if folder is not None and (folder / name).is_file():
            yield f"{COURSE}/{name}", (folder / name).read_bytes()


def _program() -> Iterator[tuple[str, bytes]]:
    root = Path(dynsolve.__file__).parent
    for path in sorted(root.rglob("*")):
        if path.is_file() and "__pycache__" not in path.parts:
            yield f"{PROGRAM}/dynsolve/{path.relative_to(root).as_posix()}", path.read_bytes()


def _requirements() -> str:
    """What dynsolve needs, a line each, in the versions that are installed here."""
    try:
        needed = [one for one in metadata.requires("dynsolve") or () if "extra ==" not in one]
        names = [re.split(r"[^\w.-]", one, maxsplit=1)[0] for one in needed]
        lines = [f"{name}=={metadata.version(name)}" for name in names]
    except metadata.PackageNotFoundError:
        message = "what dynsolve needs is not known: it runs from its source without being installed"
        raise UsageError(f"{message}; install it with pip install .") from None
    with suppress(metadata.PackageNotFoundError):
        lines.append(f"{_DOCUMENTS}=={metadata.version(_DOCUMENTS)}")
    return "".join(f"{line}\n" for line in lines)
