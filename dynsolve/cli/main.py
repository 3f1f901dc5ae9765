"""The program: its commands, and how every error becomes a message and an exit code.

To add a command, write its file with one function and put it among `COMMANDS`.
"""

from __future__ import annotations

import gc
import os
import sys
import warnings
from collections.abc import Sequence
from importlib import import_module
from pathlib import Path
from typing import NoReturn

import click

from dynsolve import __version__
from dynsolve.errors import DynsolveError, ExitCode, ExplanationWarning, InputError

TRACEBACK = "--traceback"

YOUNG = 50_000
"""So many new objects before the garbage collector looks: a solution is kept whole, and next to nothing of it
is garbage.  Measured on puma560 --json: 5 % less time than with Python's 700, and the same memory."""

COMMANDS = {
    "solve": "solve",
    "draw": "check",
    "sheet": "exercise",
    "template": "exercise",
    "vary": "exercise",
    "check": "check",
    "grade": "grade",
    "override": "check",
    "autograder": "check",
    "lint": "library",
    "new": "library",
    "schema": "library",
    "problems": "library",
    "docs": "library",
}
"""The file of each command, in the order of the help; only that of the one that is called is imported."""

SHELLS = {
    "bash": (".bashrc", 'eval "$(_DYNSOLVE_COMPLETE=bash_source dynsolve)"'),
    "zsh": (".zshrc", 'eval "$(_DYNSOLVE_COMPLETE=zsh_source dynsolve)"'),
    "fish": (".config/fish/config.fish", "_DYNSOLVE_COMPLETE=fish_source dynsolve | source"),
}
"""What a shell reads as it starts, and the line in it that lets TAB complete."""


def main(arguments: Sequence[str] | None = None) -> NoReturn:
    """Run a command line and end the process with its exit code."""
    words = list(sys.argv[1:] if arguments is None else arguments)
    options = words[: words.index("--")] if "--" in words else words
    traceback = TRACEBACK in options
    if traceback:
        words.remove(TRACEBACK)
    gc.set_threshold(YOUNG)
    warnings.filterwarnings("always", category=ExplanationWarning)
    warnings.showwarning = lambda message, *_, **__: _say(f"warning: {message}")
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="replace")
    sys.exit(int(_run(words, traceback)))


def _run(words: Sequence[str], traceback: bool) -> int:
    try:
        code = app(words).main(words, prog_name="dynsolve", standalone_mode=False)
        sys.stdout.flush()
        return _ended(int(code or ExitCode.DONE))
    except (KeyboardInterrupt, click.Abort):
        return _ended(ExitCode.INTERRUPTED)
    except (BrokenPipeError, SystemExit):  # so Click ends when the reader of the output has left
        return _reader_left()
    except click.ClickException as error:
        error.show()
        return ExitCode.USAGE
    except DynsolveError as error:
        if traceback:
            raise
        _say(str(error) if isinstance(error, InputError) else f"error: {error}")
        return error.exit_code
    except Exception as error:
        if traceback:
            raise
        what = " ".join(f"{type(error).__name__}: {error}".split())
        _say(f"internal error: {what} (run again with {TRACEBACK} to see where)")
        return ExitCode.FAILED


def _ended(code: int) -> int:
    if code == ExitCode.INTERRUPTED:
        _say("interrupted")
    return code


class _InOrder(click.Group):
    """The commands in the order in which they are listed here."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Not by the alphabet."""
        return list(self.commands)


def app(words: Sequence[str] = ()) -> click.Group:
    """The commands with their help; where `words` begin with one of them, that one alone."""
    program = _InOrder(
        help="The equations of motion of a robot manipulator, derived exactly, step by step, and verified.",
        epilog="PROBLEM is a path, the stem of a bundled problem, or - for standard input.",
        no_args_is_help=True,
        context_settings={"help_option_names": ["-h", "--help"], "show_default": True},
    )
    for option in (
        click.version_option(__version__, message="dynsolve %(version)s", help="Print the version and stop."),
        click.option(
            TRACEBACK, is_flag=True, expose_value=False, help="Show where an error arose; may stand anywhere."
        ),
        click.option(
            "--install-completion",
            is_flag=True,
            is_eager=True,
            expose_value=False,
            callback=_install_completion,
            help="Let TAB complete in this shell.",
        ),
    ):
        option(program)
    for name in words[:1] if words and words[0] in COMMANDS else COMMANDS:
        program.add_command(getattr(import_module(f"dynsolve.cli.{COMMANDS[name]}"), name))
    return program


def _install_completion(context: click.Context, _: click.Parameter, wanted: bool) -> None:
    if not wanted:
        return
    shell = Path(os.environ.get("SHELL", "")).name
    if shell not in SHELLS:
        raise click.UsageError(f"words are completed in {', '.join(SHELLS)}; SHELL names none of them")
    name, line = SHELLS[shell]
    with (Path.home() / name).open("a", encoding="utf-8") as file:
        file.write(f"{line}\n")
    click.echo(f"~/{name} has the line now: {line}")
    context.exit()


def _say(text: str) -> None:
    """A message on standard error, if anyone still reads it."""
    try:
        print(text, file=sys.stderr, flush=True)  # noqa: T201
    except OSError:
        return


def _reader_left() -> int:
    """The reader of the output has closed the pipe, as `head` does: end without a message."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return ExitCode.DONE
