"""Pages of documentation whose examples are run: their files, their sections, their commands.

A YAML or Markdown block under a line that holds nothing but a file's name in backticks is
that file.  A block marked `console` holds commands after `$ ` and what they print; `...`
stands for what is left out.
"""

from __future__ import annotations

import doctest
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

from tests.cli.running import Ran, dynsolve, environment

_FILE = re.compile(r"^`([\w.-]+)`:\n+```\w+\n(.*?)^```$", re.MULTILINE | re.DOTALL)
_SECTION = re.compile(r"^## ([^\n]+)\n(.*?)(?=^## |\Z)", re.MULTILINE | re.DOTALL)
_COMMAND = re.compile(r"^\$ (.*)\n((?:(?!\$ ).*\n)*)", re.MULTILINE)


def files(page: str) -> dict[str, str]:
    """The files that a page shows, by their names."""
    return dict(_FILE.findall(page))


def sections(page: str) -> dict[str, str]:
    """The text under each heading of the second level; what comes first is `The beginning`."""
    return dict(_SECTION.findall("## The beginning\n" + page))


def blocks(text: str, language: str) -> list[str]:
    """The blocks in a language."""
    return re.findall(rf"^```{language}\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)


def examples(text: str) -> list[tuple[str, str]]:
    """The commands of a text, each with what it prints."""
    return [
        (command.strip(), expected)
        for block in blocks(text, "console")
        for command, expected in _COMMAND.findall(block)
    ]


def run(commands: list[tuple[str, str]], folder: Path) -> None:
    """Run commands one after the other in one folder, and compare what they print."""
    for command, expected in commands:
        ran = _ran(command, folder)
        assert ran.code == 0 or "help:" in expected, f"{command}\n{ran.err}"
        printed = ran.out + ran.err
        options = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE
        assert doctest.OutputChecker().check_output(expected, printed, options), f"{command}\n{printed}"


_SHELL = set("|&;<>()$`\\*?[]{}~#!")
"""A command without any of these is the same words for every shell, and needs none."""


def _ran(command: str, folder: Path) -> Ran:
    first, _, rest = command.partition(" | ")
    if not first.startswith("dynsolve ") or set(first) & _SHELL:
        return _bash(command, folder)
    ran = dynsolve(*shlex.split(first)[1:], cwd=folder, NO_COLOR="1")
    if not rest:
        return ran
    end = _bash(rest, folder, ran.out)
    return Ran(end.code, end.out, ran.err + end.err)


def _bash(command: str, folder: Path, stdin: str = "") -> Ran:
    here = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    done = subprocess.run(
        ["bash", "-c", command],
        input=stdin, cwd=folder, env=environment(PATH=here, NO_COLOR="1"),
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    return Ran(done.returncode, done.stdout, done.stderr)
