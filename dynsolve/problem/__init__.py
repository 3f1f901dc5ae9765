"""Problem files: YAML text -> `Problem` with its `Robot`, every error located.

`load(path)` and `read_problem(text)` are the way in; they are resolved lazily, so
that the schema and the template cost no more than they need.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from dynsolve.problem.model import FilePlace, Problem
    from dynsolve.problem.reader import load, read_problem

__all__ = ["FilePlace", "Problem", "load", "read_problem"]

_HOMES = {"FilePlace": "model", "Problem": "model", "load": "reader", "read_problem": "reader"}


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)
