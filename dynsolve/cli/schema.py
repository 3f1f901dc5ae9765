"""`dynsolve schema`: the JSON Schema of problem files, for editors."""

from __future__ import annotations

from typing import Annotated

import typer


def schema(
    of_set: Annotated[bool, typer.Option("--set", help="That of a set.yaml, for `grade`.")] = False,
) -> None:
    """Print the JSON Schema of problem files, for editors."""
    from json import dumps

    if of_set:
        from dynsolve.grading.set_keys import set_schema as chosen
    else:
        from dynsolve.problem.schema import schema as chosen

    typer.echo(dumps(chosen(), indent=2, ensure_ascii=False))
