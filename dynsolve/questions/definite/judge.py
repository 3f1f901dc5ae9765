"""Verdicts on what is said of a matrix: whether it can be an inertia matrix."""

from __future__ import annotations

from dynsolve.questions.definite.derive import Definiteness
from dynsolve.questions.judging import Fault, by_code

FAULTS = by_code(
    Fault("is_definite", "a verdict", "{number} can be an inertia matrix.",
          "Look for the smallest value of each leading minor, under what is assumed."),
    Fault("definite_if", "a verdict", "Whether {number} is positive definite depends on its parameters.",
          "Take each leading minor at its smallest value over the coordinates."),
    Fault("refused_asymmetric", "a verdict", "{number} is not symmetric.",
          "Compare the entries across the diagonal."),
    Fault("refused_not_periodic", "a verdict", "In {number} an angle stands outside of sines and cosines.",
          "After a full turn the matrix must be the same."),
    Fault("refused_length_in_sine", "a verdict", "In {number} a length stands in a sine or cosine.",
          "Sines and cosines are of angles."),
    Fault("refused_degree", "a verdict", "In {number} a length stands in a higher power than the second.",
          "Moments of inertia are masses times squares of distances."),
    Fault("refused_base", "a verdict", "{number} depends on the coordinate of the base.",
          "The kinetic energy is the same wherever the first coordinate stands."),
    Fault("refused_indefinite", "a verdict", "{number} is not positive definite.",
          "Look at the determinant where a sine or cosine is 0, 1 or -1."),
)  # fmt: skip


def fault(found: Definiteness, word: str) -> Fault | None:
    """What is wrong with yes, no or if; None where it is right."""
    if word == found.answer.value:
        return None
    if found.refusal is not None:
        return FAULTS[f"refused_{found.refusal.name.lower()}"]
    return FAULTS["definite_if" if found.conditions else "is_definite"]
