"""`dynsolve problems`: the library that comes with dynsolve.

`dynsolve new`: a problem file to start from.

`dynsolve schema`: the JSON Schema of problem files, for editors.

`dynsolve lint`: what is wrong with problem files and problem sets, and what deserves a look.

`dynsolve docs`: the formats of files, verdicts and exit codes, as problems/README.md tells them.
"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from dynsolve.cli.numbers import STDIN, STDIN_NAME, Problems, Quiet, described, say, standard_input, stems
from dynsolve.errors import ExitCode, Finding, ProblemError, UsageError
from dynsolve.render.files import write_whole


def problems(
    name: Annotated[
        str | None, typer.Argument(help="Print this problem's file, to be copied.", show_default=False)
    ] = None,
) -> None:
    """List the bundled problems, or print one of them."""
    from dynsolve.problem import load
    from dynsolve.problem.reader import bundled, find

    if name is not None:
        typer.echo(find(name).read_text(encoding="utf-8"), nl=False)
        return
    known = bundled()
    width = max(map(len, known), default=0)
    for stem, path in known.items():
        typer.echo(f"{stem:{width}}  {load(path).title}")


# `dynsolve new`: a problem file to start from


def new(
    file: Annotated[
        str, typer.Argument(help="Where to write it; - for standard output.", show_default=False)
    ],
    like: Annotated[
        str | None, typer.Option(metavar="STEM", help="A bundled problem's file.", autocompletion=stems)
    ] = None,
    all_: Annotated[bool, typer.Option("--all", help="Every key, with its meaning.")] = False,
    force: Annotated[bool, typer.Option("--force", help="Overwrite a file that is there.")] = False,
) -> None:
    """Write a problem file to start from: an arm with two joints, in thirty lines."""
    if like and all_:
        raise UsageError("--like and --all are two ways to begin", "choose one of them")
    text = _beginning(like, all_)
    if file == "-":
        typer.echo(text, nl=False)
        return
    path = Path(file)
    if path.exists() and not force:
        raise UsageError(f"{file} exists; --force overwrites it")
    write_whole(path, text.encode())
    typer.echo(f"wrote {file}; now: dynsolve solve {file}", err=True)


def _beginning(like: str | None, every_key: bool) -> str:
    """What `new` writes: an arm to change, a bundled problem, or every key with an example."""
    from dynsolve.problem.reader import find
    from dynsolve.problem.schema import FIRST, template

    if like:
        return find(like).read_text(encoding="utf-8")
    return template() if every_key else FIRST


# `dynsolve schema`: the JSON Schema of problem files, for editors


def schema(
    of_set: Annotated[bool, typer.Option("--set", help="That of a set.yaml, for `grade`.")] = False,
) -> None:
    """Print the JSON Schema of problem files, for editors."""
    from json import dumps

    if of_set:
        from dynsolve.grading.set_file import set_schema as chosen
    else:
        from dynsolve.problem.schema import schema as chosen

    typer.echo(dumps(chosen(), indent=2, ensure_ascii=False))


# `dynsolve lint`


def lint(problem: Problems, quiet: Quiet = False) -> int:
    """Check problem files, or a set.yaml with all of its problems: faults and what deserves a look.

    Ends with 1 where something deserves a look, with 2 where a file is faulty.
    """
    code = ExitCode.DONE
    for name in problem:
        try:
            files = [name]
            if Path(name).name == "set.yaml" or Path(name).is_dir():
                from dynsolve.grading.set_file import load_set

                files = [item.problem.file for item in load_set(name).items]
            findings = [finding for file in files for finding in _findings(file)]
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


def _findings(name: str) -> list[Finding]:
    from dynsolve.problem.lint import remarks
    from dynsolve.problem.reader import find, read_file, read_whole
    from dynsolve.solution.given_axes import check_axes

    if name == STDIN:
        reading = read_whole(standard_input(), STDIN_NAME)
    else:
        reading = read_whole(read_file(find(name)), str(find(name)))
    return [*remarks(reading), *check_axes(reading.problem)]


# `dynsolve docs`

PAGES = ("students", "teachers", "python")
"""The pages for readers, beside that of all files."""


def docs(
    topic: Annotated[str | None, typer.Argument(help="What to read about.", show_default=False)] = None,
) -> None:
    """List what there is to read, or print one topic."""
    known = topics()
    if topic is None:
        width = max(map(len, known))
        for name, text in known.items():
            level = "## " if text.startswith("# ") else "### "
            headings = [line.removeprefix(level) for line in text.splitlines() if line.startswith(level)]
            typer.echo(f"{name:{width}}  {', '.join([_title(text), *headings])}")
    elif topic in known:
        typer.echo(known[topic], nl=False)
    else:
        from dynsolve.problem.kinds import did_you_mean

        help = did_you_mean(topic, known) or f"topics are {', '.join(known)}"
        raise UsageError(f"there is nothing about {topic[:40]}; {help}")


def topics() -> dict[str, str]:
    """The pages for readers, and the sections of that of all files by the names of links: `problem-file`."""
    import re

    from dynsolve.problem.reader import folder

    page = (folder() / "README.md").read_text(encoding="utf-8")
    sections = re.split("^(?=## )", page, flags=re.MULTILINE)[1:]
    pages = {name: (folder() / f"{name}.md").read_text(encoding="utf-8") for name in PAGES}
    return pages | {_title(section).lower().replace(" ", "-"): section for section in sections}


def _title(section: str) -> str:
    return section.partition("\n")[0].lstrip("# ")
