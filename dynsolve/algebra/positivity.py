"""What is positive because of how it is written: lengths and masses are, and squares, and their sums."""

from __future__ import annotations

from dynsolve.algebra.expr import Expr


def is_positive(expr: Expr) -> bool:
    """Whether every term has a positive factor and no coordinate, sine or cosine to an odd power.

    Parameters count as positive, as lengths and masses do.

    >>> from dynsolve.algebra.build import build_ring
    >>> from dynsolve.notation.tree import Symbol
    >>> ring = build_ring([("d1", "prismatic")], [Symbol("l")])
    >>> l, d = ring.symbol("l"), ring.symbol("d1")
    >>> is_positive(l + d * d), is_positive(l + d), is_positive(l - d * d)
    (True, False, False)
    """
    ring = expr.ring
    names = set(ring.names)
    free = {g.index for g in ring.generators if g.kind == "symbol" and g.name not in names}
    terms = expr.poly.to_dict()
    return bool(terms) and all(
        factor > 0 and all(e % 2 == 0 or i in free for i, e in enumerate(exponents))
        for exponents, factor in terms.items()
    )
