"""A quantity that is given several times: what cannot be read never takes the place of what can."""

from __future__ import annotations

from collections.abc import Sequence

from dynsolve.answers.submission import Answer, NotRecognized
from dynsolve.quantities.index import Quantities


def readable(answers: Sequence[Answer], quantities: Quantities) -> tuple[list[Answer], list[NotRecognized]]:
    r"""The answers that count, and those that could not be read although their quantity is given elsewhere.

    A report that gives τ row by row and then says `\tau = D \ddot q + F_v \dot q` has given τ.  A
    vector or a matrix is given elsewhere where all its entries are.
    """
    given = {answer.name for answer in answers if answer.node is not None}
    kept: list[Answer] = []
    lost: list[NotRecognized] = []
    for answer in answers:
        if answer.node is None and _is_given(answer.name, given, quantities):
            refused = NotRecognized(answer.text, answer.label, answer.place, answer.fault, (answer.name,))
            lost.append(refused)
        else:
            kept.append(answer)
    return kept, lost


def _is_given(name: str, given: set[str], quantities: Quantities) -> bool:
    if name in given:
        return True
    quantity = quantities.get(name)
    if quantity is None or quantity.shape is None:
        return False
    parts = set(quantities.parts(name))
    return bool(parts) and parts <= given
