"""A progress bar on standard error, where there is a terminal and it takes longer than a second."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.progress import Progress

PATIENCE = 1.0
"""Seconds without a bar."""

Advance = Callable[[int, int], None]
"""advance(done, of)"""


@contextmanager
def progress(title: str, quiet: bool = False) -> Iterator[Advance | None]:
    """Give a function that is told how far the work is, None where nobody would see it."""
    if quiet or not sys.stderr.isatty():
        yield None
        return
    start, shown = time.monotonic(), _Shown(title)

    def advance(done: int, of: int) -> None:
        if time.monotonic() - start > PATIENCE:
            shown.update(done, of)

    try:
        yield advance
    finally:
        shown.close()


class _Shown:
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
