"""Running the program as a user does.

`dynsolve` waits for the end of a run that starts where all is imported (`fork_server.py`),
`dynsolve_afresh` for one of an interpreter of its own, `started` hands over one that goes
on, and `in_terminal` gives it a terminal to write to.
"""

from __future__ import annotations

import atexit
import os
import socket
import subprocess
import sys
import tempfile
from contextlib import ExitStack
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from tests.cli.fork_server import Request
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


def dynsolve(
    *words: str, stdin: str | bytes = "", cwd: Path = ROOT, workers: bool = False, **extra: str
) -> Ran:
    """Run `dynsolve words...` with files for its standard streams, in a process of its own.

    `grade` does the work in that process, unless it is to have `workers`.
    """
    assert not any(name.startswith("PYTHON") for name in extra), "read as Python starts: `dynsolve_afresh`"
    data = stdin.encode() if isinstance(stdin, str) else stdin
    with ExitStack() as stack:
        files = [stack.enter_context(tempfile.TemporaryFile()) for _ in range(3)]
        files[0].write(data)
        for file in files:
            file.seek(0)
        request = Request(words, str(cwd), environment(**extra), workers)
        code = request.sent(_server(), [file.fileno() for file in files])
        out, err = (_contents(file.fileno()) for file in files[1:])
    return Ran(code, out, err)


def _contents(file: int) -> str:
    return os.pread(file, os.fstat(file).st_size, 0).decode()


@cache
def _server() -> socket.socket:
    """The way to this process's server, which starts where it is first needed and ends with this process."""
    here, there = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    with there:
        server = subprocess.Popen(
            [sys.executable, "-m", "tests.cli.fork_server", str(there.fileno())],
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, pass_fds=[there.fileno()], cwd=ROOT,
            env=environment(),
        )  # fmt: skip
    atexit.register(_end, server, here)
    return here


def _end(server: subprocess.Popen[bytes], way: socket.socket) -> None:
    way.close()
    server.wait()


def dynsolve_afresh(*words: str, stdin: str | bytes = "", cwd: Path = ROOT, **extra: str) -> Ran:
    """Run `dynsolve words...` in a pipe, in an interpreter of its own."""
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
