"""`dynsolve docs`: the formats of files, verdicts and exit codes, as problems/README.md tells them."""

from __future__ import annotations

from typing import Annotated

import typer

from dynsolve.errors import UsageError


def docs(
    topic: Annotated[str | None, typer.Argument(help="What to read about.", show_default=False)] = None,
) -> None:
    """List what there is to read, or print one topic."""
    known = topics()
    if topic is None:
        width = max(map(len, known))
        for name, text in known.items():
            typer.echo(f"{name:{width}}  {_first_words(text)}")
    elif topic in known:
        typer.echo(known[topic], nl=False)
    else:
        from dynsolve.problem.fields import did_you_mean

        help = did_you_mean(topic, known) or f"topics are {', '.join(known)}"
        raise UsageError(f"there is nothing about {topic[:40]}; {help}")


def topics() -> dict[str, str]:
    """The sections of the page by the names that links on it have: `problem-file`."""
    import re

    from dynsolve.problem.library import folder

    page = (folder() / "README.md").read_text(encoding="utf-8")
    sections = re.split("^(?=## )", page, flags=re.MULTILINE)[1:]
    return {_title(section).lower().replace(" ", "-"): section for section in sections}


def _title(section: str) -> str:
    return section.partition("\n")[0].removeprefix("## ")


def _first_words(section: str) -> str:
    """The headings within a section, which say what it is about."""
    parts = [line.removeprefix("### ") for line in section.splitlines() if line.startswith("### ")]
    return ", ".join([_title(section), *parts])
