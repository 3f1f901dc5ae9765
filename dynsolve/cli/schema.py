"""`dynsolve schema`: the JSON Schema of problem files, for editors."""

from __future__ import annotations

import typer


def schema() -> None:
    """Print the JSON Schema of problem files, for editors."""
    from json import dumps

    from dynsolve.problem.schema import schema as problem_schema

    typer.echo(dumps(problem_schema(), indent=2, ensure_ascii=False))
