"""Running the program as a user does.

`dynsolve` waits for the end of a run, `started` hands over one that goes on, and `in_terminal`
gives it a terminal to write to.
"""

from __future__ import annotations

import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from tests.support import ROOT

INTERRUPTIBLE = """
import os, signal, sys
signal.signal(signal.SIGINT, signal.SIG_DFL)
os.execv(sys.argv[1], sys.argv[1:])
"""
"""Runs a command that heeds Ctrl-C, also where a shell has started the tests in the background.

There SIGINT is ignored, and what ignores a signal hands that on to its children.
"""


@dataclass(frozen=True)
class Ran:
    """What a run printed, and its exit code."""

    code: int
    out: str
    err: str


def environment(**extra: str) -> dict[str, str]:
    kept = {name: value for name, value in os.environ.items() if name not in ("COLUMNS", "NO_COLOR", "TERM")}
    return {**kept, "PYTHONIOENCODING": "utf-8", "TERM": "xterm-256color", **extra}


def dynsolve(*words: str, stdin: str | bytes = "", cwd: Path = ROOT, **extra: str) -> Ran:
    """Run `dynsolve words...` in a pipe."""
    data = stdin.encode() if isinstance(stdin, str) else stdin
    command = [sys.executable, "-m", "dynsolve", *words]
    done = subprocess.run(
        command, input=data, capture_output=True, cwd=cwd, env=environment(**extra), check=False
    )
    return Ran(done.returncode, done.stdout.decode(), done.stderr.decode())


def started(*words: str) -> subprocess.Popen[bytes]:
    """`dynsolve words...` on its way, with pipes to it and from it; it heeds Ctrl-C."""
    pipe = subprocess.PIPE
    command = [sys.executable, "-c", INTERRUPTIBLE, sys.executable, "-m", "dynsolve", *words]
    return subprocess.Popen(command, stdin=pipe, stdout=pipe, stderr=pipe, cwd=ROOT, env=environment())


def in_terminal(*words: str, columns: int = 80, **extra: str) -> Ran:
    """Run it with a terminal of that many columns as its standard output."""
    import fcntl
    import pty
    import struct
    import termios

    leader, follower = pty.openpty()
    fcntl.ioctl(follower, termios.TIOCSWINSZ, struct.pack("HHHH", 50, columns, 0, 0))
    process = subprocess.Popen(
        [sys.executable, "-m", "dynsolve", *words],
        stdin=subprocess.DEVNULL, stdout=follower, stderr=subprocess.PIPE, cwd=ROOT, env=environment(**extra),
    )  # fmt: skip
    os.close(follower)
    pieces: list[bytes] = []
    while True:
        try:
            piece = os.read(leader, 65536)
        except OSError:
            break
        if not piece:
            break
        pieces.append(piece)
    os.close(leader)
    with process:
        assert process.stderr is not None
        err = process.stderr.read().decode()
    return Ran(process.returncode, b"".join(pieces).decode().replace("\r\n", "\n"), err)
