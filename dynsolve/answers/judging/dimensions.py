"""Dimensions for whoever judges answers; see `dynsolve.robot.dimensions`."""

from __future__ import annotations

from dynsolve.robot.dimensions import (
    ACCELERATION,
    ENERGY,
    INERTIA,
    LENGTH,
    MASS,
    NONE,
    Dimension,
    Dimensions,
    describe,
    dimension,
    times,
)

__all__ = [
    "ACCELERATION",
    "ENERGY",
    "INERTIA",
    "LENGTH",
    "MASS",
    "NONE",
    "Dimension",
    "Dimensions",
    "describe",
    "dimension",
    "times",
]
