"""`dynsolve problems`: the library that comes with dynsolve."""

from __future__ import annotations

from typing import Annotated

import typer


def problems(
    name: Annotated[
        str | None, typer.Argument(help="Print this problem's file, to be copied.", show_default=False)
    ] = None,
) -> None:
    """List the bundled problems, or print one of them."""
    from dynsolve.problem import load
    from dynsolve.problem.library import bundled, find

    if name is not None:
        typer.echo(find(name).read_text(encoding="utf-8"), nl=False)
        return
    known = bundled()
    width = max(map(len, known), default=0)
    for stem, path in known.items():
        typer.echo(f"{stem:{width}}  {load(path).title}")
