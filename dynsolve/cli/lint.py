"""`dynsolve lint`: what is wrong with problem files and problem sets, and what deserves a look."""

from __future__ import annotations

import typer

from dynsolve.cli.common import STDIN, STDIN_NAME, Problems, Quiet, described, say, standard_input
from dynsolve.errors import ExitCode, Finding, ProblemError


def lint(problem: Problems, quiet: Quiet = False) -> int:
    """Check problem files, or a set.yaml with all of its problems: faults and what deserves a look.

    Ends with 1 where something deserves a look, with 2 where a file is faulty.
    """
    code = ExitCode.DONE
    for name in problem:
        try:
            findings = _of_set(name) if _is_set(name) else _findings(name)
        except ProblemError as error:
            say(error.findings)
            code = ExitCode.USAGE
            continue
        for finding in findings:
            typer.echo(described(finding, "warning"))
        if findings:
            code = max(code, ExitCode.FALLS_SHORT)
        elif not quiet:
            typer.echo(f"{name}: nothing to remark", err=True)
    return code


def _is_set(name: str) -> bool:
    """Whether a name is that of a problem set: its `set.yaml`, or its folder."""
    from pathlib import Path

    return Path(name).name == "set.yaml" or Path(name).is_dir()


def _of_set(name: str) -> list[Finding]:
    """What deserves a look in a set and in its problems.

    Raises ProblemError with all that is wrong with it.
    """
    from dynsolve.grading.set_file import load_set

    return [finding for item in load_set(name).items for finding in _findings(item.problem.file)]


def _findings(name: str) -> list[Finding]:
    from dynsolve.problem import read_problem
    from dynsolve.problem.library import find
    from dynsolve.problem.lint import lint_text
    from dynsolve.problem.reader import read_file
    from dynsolve.solution.given_axes import check_axes

    content, file = (
        (standard_input(), STDIN_NAME) if name == STDIN else (read_file(find(name)), str(find(name)))
    )
    return [*lint_text(content, file), *check_axes(read_problem(content, file))]
