"""The accelerations in the entries of D: (d₂₂ b₁ - d₁₂ b₂)/Δ, with names for det D and for what acts."""

from __future__ import annotations

from collections.abc import Sequence

from msgspec import Struct

from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.linear_systems import adjugate, blocks, part
from dynsolve.algebra.matrix import Matrix, determinant
from dynsolve.algebra.ring_values import build_ring
from dynsolve.document.sentences import say
from dynsolve.explain.context import Context
from dynsolve.explain.step import Line
from dynsolve.explain.terms import with_force_letters
from dynsolve.explain.writing import is_small, listed
from dynsolve.notation import tree
from dynsolve.notation.build import cost, summands, times, total
from dynsolve.notation.template import formula
from dynsolve.notation.tree import ONE, Node, Quotient, Relation, Symbol, column, equation, mapped
from dynsolve.quantities import letters
from dynsolve.questions.forward_dynamics.derive import acting_forces, acting_names, driving_forces

MOST_COUPLED = 3
"""Of more coordinates the minors of D are themselves too long to be read."""

SHORT = 24
"""Rows that have no more operations each are read as quickly multiplied out."""


class OfEntries:
    """adj and det of a part of D, which is symmetric, as formulas in the entries that are not 0."""

    def __init__(self, D: Matrix, block: Sequence[int]) -> None:
        names = {(i, j): f"d{i}_{j}" for i in block for j in block if i <= j and not D[i, j].is_zero}
        ring = build_ring([], [*map(Symbol, names.values())])
        entries = {place: ring.symbol(name) for place, name in names.items()}
        rows = ([entries.get((min(i, j), max(i, j)), ring.zero) for j in block] for i in block)
        whole, compactor = Matrix.of(ring, rows), Compactor(ring)
        letter = {name: letters.entry("d", i + 1, j + 1) for (i, j), name in names.items()}

        def written(node: Node) -> Node:
            return mapped(node, lambda one: letter.get(one.name, one) if isinstance(one, Symbol) else one)

        self.letters = {place: letter[name] for place, name in names.items()}
        self.adjugate = written(compactor.matrix(adjugate(whole)))
        self.determinant = written(compactor.form(determinant(whole)))

    def times(self, forces: Sequence[Node]) -> list[Node]:
        """The rows of adj D b/Δ."""
        assert isinstance(self.adjugate, tree.Matrix)
        sums = (
            total([times(1, [(minor, 1), (force, 1)]) for minor, force in zip(row, forces, strict=True)])
            for row in self.adjugate.rows
        )
        return [times(1, [(above, 1), (letters.DIVISOR, -1)]) for above in sums]


class Named(Struct, frozen=True):
    """The rows of q̈, the lines that introduce the names in them, and what these mean, as do entries of D."""

    shown: tree.Matrix
    lines: tuple[Line, ...]
    meanings: tuple[Relation, ...]
    entries: tuple[Relation, ...]


def named(context: Context) -> Named | None:
    """q̈ in the entries of D, where two or three coordinates are coupled and it is shorter so."""
    D = context.values["D"]
    coupled = [block for block in blocks(D) if len(block) > 1]
    if len(coupled) != 1 or len(coupled[0]) > MOST_COUPLED:
        return None
    (block,) = coupled
    is_whole, with_letters = len(block) == len(D.rows), with_force_letters(context.robot)
    written = context.form("qdd_forward")
    if not (is_whole or isinstance(written, tree.Matrix)):
        return None
    driving, names = driving_forces(context.robot), acting_names(context.robot)
    beside = acting_forces(context.robot, *map(context.values.__getitem__, names)) - driving
    forces = {
        k: mapped(total([context.forms.of(part.entries[k]) for part in (driving, beside)]), with_letters)
        for k in block
    }
    short = {k: letters.entry("b", k + 1) if len(summands(forces[k])) > 1 else forces[k] for k in block}
    entries, size = OfEntries(D, block), context.forms.products.form(determinant(part(D, block, block)))
    rows = dict(zip(block, entries.times([short[k] for k in block]), strict=True))
    divisor = equation(letters.DIVISOR, entries.determinant, *((size,) if is_small(size) else ()))
    of_forces = tuple(equation(short[k], force) for k, force in forces.items() if short[k] != force)
    meanings = (divisor, *of_forces)
    values = [meaning.parts[-1] for meaning in meanings]
    if isinstance(written, tree.Matrix):
        expanded = [mapped(row[0], with_letters) for row in written.rows]
        shown = column(*(rows.get(k, row) for k, row in enumerate(expanded)))
        before = [cost(expanded[k]) for k in block]
        if max(before) <= SHORT or sum(before) <= sum(map(cost, (*rows.values(), *values))):
            return None
    elif is_small(*values):
        shown = column(*rows.values())
    else:
        return None
    inverse = formula("𝐃⁻¹ = {over} {A}", over=Quotient(ONE, letters.DIVISOR), A=entries.adjugate)
    rows_named = listed([str(k + 1) for k in block])
    told = say("The block of $𝐃$ with rows {rows} has the determinant", rows=rows_named)
    lines = [Line(say("The determinant of $𝐃$:") if is_whole else told, (divisor,), is_kept=True)]
    if is_whole:
        told = say("The inverse of $𝐃$, its adjugate over that, in the entries of $𝐃$:")
        lines.append(Line(told, (inverse,), is_kept=True))
    if of_forces:
        named_so = listed([meaning.parts[0] for meaning in of_forces])
        lines.append(Line(say("What acts, row by row, named {names}:", names=named_so), of_forces))
    inertia = context.matrix("D").rows
    of_inertia = tuple(equation(one, inertia[i][j]) for (i, j), one in entries.letters.items())
    return Named(shown, tuple(lines), meanings, of_inertia)
