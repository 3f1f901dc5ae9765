"""The equations of motion of a robot manipulator, derived exactly, step by step, and verified.

>>> import dynsolve
>>> solution = dynsolve.solve("planar-2r")
>>> solution.g[1]
g*lc2*m2*cos(q1 + q2)
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from dynsolve.answers.public import check as check
    from dynsolve.grading.public import grade as grade
    from dynsolve.grading.public import override as override
    from dynsolve.problem import Problem as Problem
    from dynsolve.solution.solution import Solution as Solution
    from dynsolve.solution.solution import load as load
    from dynsolve.solution.solution import solve as solve

__version__ = "0.1.0"

__all__ = ["Problem", "Solution", "check", "grade", "load", "override", "solve", "__version__"]

_PLACES = {
    "check": "dynsolve.answers.public",
    "grade": "dynsolve.grading.public",
    "override": "dynsolve.grading.public",
    "Problem": "dynsolve.problem",
    "Solution": "dynsolve.solution.solution",
    "load": "dynsolve.solution.solution",
    "solve": "dynsolve.solution.solution",
}


def __getattr__(name: str) -> Any:
    """Import what is asked for, and nothing else: no command pays for what it does not use."""
    if name not in _PLACES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module(_PLACES[name]), name)


def __dir__() -> list[str]:
    return sorted(__all__)
