"""Progress on standard error: a bar where there is a terminal and it takes longer than a second."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

import typer

if TYPE_CHECKING:
    from rich.progress import Progress

PATIENCE = 1.0
"""Seconds without a bar."""

EVERY = 10.0
"""Seconds between two lines of progress where there is no terminal."""

Advance = Callable[[int, int], None]
"""advance(done, of)"""


@contextmanager
def progress(title: str, quiet: bool = False) -> Iterator[Advance | None]:
    """Give a function that is told how far the work is, None where nobody would see it."""
    if quiet or not sys.stderr.isatty():
        yield None
        return
    start, shown = time.monotonic(), _Bar(title)

    def advance(done: int, of: int) -> None:
        if time.monotonic() - start > PATIENCE:
            shown.update(done, of)

    try:
        yield advance
    finally:
        shown.close()


@contextmanager
def bar_or_lines(title: str, quiet: bool = False) -> Iterator[Advance | None]:
    """A bar on a terminal; elsewhere a line now and then, with an estimate of what is left."""
    if sys.stderr.isatty() or quiet:
        with progress(title, quiet) as advance:
            yield advance
        return
    start = said = time.monotonic()

    def line(done: int, of: int) -> None:
        nonlocal said
        now = time.monotonic()
        if now - said > EVERY:
            said = now
            left = (now - start) / done * (of - done)
            typer.echo(f"{done} of {of}, about {left:.0f} s left", err=True)

    yield line


class _Bar:
    """The bar, made when it is first wanted: importing it costs time too."""

    def __init__(self, title: str) -> None:
        self._title = title
        self._bar: Progress | None = None

    def update(self, done: int, of: int) -> None:
        if self._bar is None:
            from rich.console import Console
            from rich.markup import escape
            from rich.progress import Progress

            self._bar = Progress(console=Console(stderr=True), transient=True)
            self._bar.add_task(escape(self._title), total=of)
            self._bar.start()
        self._bar.update(self._bar.task_ids[0], completed=done, total=of)

    def close(self) -> None:
        if self._bar is not None:
            self._bar.stop()
