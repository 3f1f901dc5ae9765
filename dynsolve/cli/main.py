"""The program: its commands, and how every error becomes a message and an exit code.

To add a command, write its file with one function and put it among `COMMANDS`.
"""

from __future__ import annotations

import gc
import os
import re
import sys
import warnings
from collections.abc import Sequence
from importlib import import_module
from typing import Annotated, Any, NoReturn

import typer

from dynsolve.errors import DynsolveError, ExitCode, ExplanationWarning, InputError

TRACEBACK = "--traceback"

YOUNG = 1_000_000
"""So many new objects before the garbage collector looks: a solution is kept whole, and next to nothing of it
is garbage.  Measured on panda-7r --json: 8 % less time than with 50 000, and the same memory; thirty small
problems in one call take a tenth less time, and 90 MB in place of 63."""

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

# Typer brings Click inside since 0.16; whichever it is, its base error is this one's.
_ClickError: Any = next(base for base in typer.BadParameter.__mro__ if base.__name__ == "ClickException")


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
        code = app(words)(list(words), prog_name="dynsolve", standalone_mode=False)
        sys.stdout.flush()
        return _ended(int(code or ExitCode.DONE))
    except (KeyboardInterrupt, typer.Abort):
        return _ended(ExitCode.INTERRUPTED)
    except BrokenPipeError:
        return _reader_left()
    except SystemExit as end:  # Click's own way to end when the reader of the output has left
        if not isinstance(end.__context__, BrokenPipeError):
            raise
        return _reader_left()
    except typer.Exit as end:
        return _ended(int(end.exit_code))
    except _ClickError as error:
        error.message = _plain(error.message)
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


def _plain(message: str) -> str:
    """A message of Typer's as people write it, with the choice that may have been meant.

    >>> _plain("Value error, 'torqe' is not one of 'energy', 'torque'.")
    "'torqe' is not one of 'energy', 'torque'; did you mean `torque`?"
    """
    from dynsolve.problem.kinds import did_you_mean

    message = message.removeprefix("Value error, ")
    given, is_choice, choices = message.partition(" is not one of ")
    meant = did_you_mean(given.strip("'"), re.findall("'([^']*)'", choices)) if is_choice else ""
    return f"{message.rstrip('.')}; {meant}" if meant else message


def _ended(code: int) -> int:
    if code == ExitCode.INTERRUPTED:
        _say("interrupted")
    return code


def app(words: Sequence[str] = ()) -> typer.Typer:
    """The commands with their help; where `words` begin with one of them, that one alone."""
    program = typer.Typer(
        name="dynsolve",
        help="The equations of motion of a robot manipulator, derived exactly, step by step, and verified.",
        epilog="PROBLEM is a path, the stem of a bundled problem, or - for standard input.",
        no_args_is_help=True,
        rich_markup_mode=None,
        pretty_exceptions_enable=False,
        context_settings={"help_option_names": ["-h", "--help"]},
    )
    program.callback()(_globals)
    for name in words[:1] if words and words[0] in COMMANDS else COMMANDS:
        program.command()(getattr(import_module(f"dynsolve.cli.{COMMANDS[name]}"), name))
    return program


def _version(wanted: bool) -> None:
    if wanted:
        from dynsolve import __version__

        typer.echo(f"dynsolve {__version__}")
        raise typer.Exit


def _globals(
    version: Annotated[
        bool, typer.Option("--version", help="Print the version and stop.", callback=_version, is_eager=True)
    ] = False,
    traceback: Annotated[
        bool, typer.Option(TRACEBACK, help="Show where an error arose; may stand anywhere.")
    ] = False,
) -> None:
    pass


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
