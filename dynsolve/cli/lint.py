"""`dynsolve lint`: what is wrong with problem files, and what deserves a look."""

from __future__ import annotations

import typer

from dynsolve.cli.common import Problems, Quiet, described, read, say
from dynsolve.errors import ExitCode, ProblemError


def lint(problem: Problems, quiet: Quiet = False) -> int:
    """Check problem files; ends with 1 where there is a finding, with 2 for a faulty file."""
    from dynsolve.solution import check_axes

    code = ExitCode.DONE
    for name in problem:
        try:
            found = read(name)
            warnings = [*found.warnings, *check_axes(found)]
        except ProblemError as error:
            say(error.findings)
            code = ExitCode.USAGE
            continue
        for warning in warnings:
            typer.echo(described(warning, "warning"))
        if warnings:
            code = max(code, ExitCode.FALLS_SHORT)
        elif not quiet:
            typer.echo(f"{found.file}: no findings", err=True)
    return code
