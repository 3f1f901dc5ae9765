"""A process that has imported dynsolve, and forks for every command line that it is sent.

Most of what a short run of the program takes is importing it. Here that is paid once: each
run is a process of its own still, with its own working directory, environment, standard
streams and exit code, but it starts where all is imported and nothing has been solved.
What Python reads from the environment as it starts, such as PYTHONHASHSEED, is the
server's; for that there is `dynsolve_afresh` in running.py.

The server hears on the socket whose descriptor is its argument. A request is
`Request.sent` with three descriptors for the streams, the answer the exit code, negative
for a signal, and the server ends with the other end of the socket.
"""

from __future__ import annotations

import contextlib
import gc
import importlib
import json
import os
import pkgutil
import socket
import sys
from dataclasses import asdict, dataclass

LONGEST = 1 << 20
"""The bytes of the longest request."""

HEAVY = ("numpy", "sympy")
"""What few runs need, and they import: NumPy brings threads, and a fork takes none along."""


@dataclass(frozen=True)
class Request:
    """A command line, the folder it is given in, and its environment."""

    words: tuple[str, ...]
    folder: str
    environment: dict[str, str]
    workers: bool = False
    """Whether `grade` starts workers, as it does for a user."""

    def sent(self, to: socket.socket, streams: list[int]) -> int:
        """The exit code of the run that `to` is asked for, with these standard streams."""
        socket.send_fds(to, [json.dumps(asdict(self)).encode()], streams)
        answer = to.recv(LONGEST)
        assert answer, "the server of the command line has ended"
        return int(answer)


def received(here: socket.socket) -> tuple[Request, list[int]] | None:
    """The next request with its streams; None where the other end is closed."""
    data, streams, _, _ = socket.recv_fds(here, LONGEST, 3)
    return (Request(**json.loads(data)), streams) if data else None


def import_all() -> None:
    """Import what most runs do, also what the libraries put off until they are used."""
    import dynsolve
    import tests.grading.here  # noqa: F401
    from dynsolve.cli.main import main

    sys.modules.update(dict.fromkeys(HEAVY))  # with None there, importing it fails
    for module in pkgutil.walk_packages(dynsolve.__path__, "dynsolve."):
        if not module.name.endswith("__main__"):
            with contextlib.suppress(ImportError):
                importlib.import_module(module.name)
    for name in HEAVY:
        del sys.modules[name]
    with contextlib.suppress(SystemExit):
        main(["lint", "in3140-rp", "--quiet"])


def run(request: Request, streams: list[int]) -> None:
    """Become the process of a run: its streams, folder and environment, then the program.

    The end is an end at once: to take apart all that was imported would take longer than most runs.
    """
    from dynsolve.cli.main import main
    from dynsolve.grading import public
    from tests.grading.here import Here

    if not request.workers:
        public.LocalPool = Here  # type: ignore[misc,assignment]
    for place, stream in enumerate(streams):
        os.dup2(stream, place)
        os.close(stream)
    os.chdir(request.folder)
    os.environ.clear()
    os.environ.update(request.environment)
    sys.argv[1:] = request.words
    try:
        main()
    except SystemExit as end:
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(int(end.code or 0))


def serve(here: socket.socket) -> None:
    """Fork for one request after the other; the child returns from no run."""
    while (found := received(here)) is not None:
        request, streams = found
        child = os.fork()
        if not child:
            here.close()
            run(request, streams)
        for stream in streams:
            os.close(stream)
        _, status = os.waitpid(child, 0)
        here.send(str(os.waitstatus_to_exitcode(status)).encode())


if __name__ == "__main__":
    import_all()
    gc.collect()
    gc.freeze()  # what is there stays: the children neither look at it nor copy it
    serve(socket.socket(fileno=int(sys.argv[1])))
