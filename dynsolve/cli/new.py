"""`dynsolve new`: a problem file to start from."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from dynsolve.errors import UsageError


def new(
    file: Annotated[
        str, typer.Argument(help="Where to write it; - for standard output.", show_default=False)
    ],
    force: Annotated[bool, typer.Option("--force", help="Overwrite a file that is there.")] = False,
) -> None:
    """Write a commented problem file to start from."""
    from dynsolve.problem.documentation import template

    if file == "-":
        typer.echo(template(), nl=False)
        return
    path = Path(file)
    try:
        with path.open("w" if force else "x", encoding="utf-8") as stream:
            stream.write(template())
    except FileExistsError:
        raise UsageError(f"{file} exists; --force overwrites it") from None
    except OSError as error:
        raise UsageError(f"{file} cannot be written: {(error.strerror or str(error)).lower()}") from None
    typer.echo(f"wrote {file}; now: dynsolve solve {file}", err=True)
