"""Displayed formulas in a terminal, set to its width: on one line, or a line a member, or entry by entry."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from dynsolve.document import Formula
from dynsolve.notation.tree import Letter, Matrix, Node, Relation, Row
from dynsolve.notation.unicode import UnicodePrinter, width
from dynsolve.render.matrices import entry_equations
from dynsolve.render.terminal_boxes import TextBox, beside, boxed, matrix_box, matrix_width, pieces
from dynsolve.render.terminal_breaking import break_sum
from dynsolve.render.typesetting import listed

_HANG = 4
_UNDER_HEAD = 2
"""How far the entries of a matrix are moved in under the letter that they belong to."""

_LONGEST_HANG = 12

Group = tuple[str, TextBox | Matrix]
"""What stands before a piece (` = `, a space) and the piece; a `Matrix` is one too wide for a box."""


def set_formula(formula: Formula, printer: UnicodePrinter, room: int) -> list[str]:
    """The lines of a displayed formula in `room` cells; none for an optional one that does not fit."""
    groups = list(_grouped(formula.node, printer, room))
    boxes = [beside([TextBox.of(lead), piece]) for lead, piece in groups if isinstance(piece, TextBox)]
    if len(boxes) == len(groups) and sum(box.width for box in boxes) <= room:
        return list(beside(boxes).lines)
    if formula.optional and len(boxes) < len(groups):
        return []
    if formula.otherwise and any(
        isinstance(piece, Matrix) and not _is_alone(piece, formula.node) for _, piece in groups
    ):
        found = [set_formula(each, printer, room) for each in formula.otherwise]
        return [line for lines in found for line in (*lines, "")][:-1]
    if isinstance(formula.node, Row) and len(parts := list(listed(formula.node))) > 1:
        return _set_several(parts, formula, printer, room)
    members = list(_members(groups))
    left = _width(members[0], room)
    hang = left + 1 if left + 1 <= _LONGEST_HANG else _HANG
    lines: list[str] = []
    start = members[0]
    if len(members) > 1 and left <= room // 2:
        start = [*members[0], *members[1]]
        members = members[1:]
    lines += _set_member(start, formula, printer, room, 0, hang + 2)
    for member in members[1:]:
        lines += _set_member(member, formula, printer, room, hang, hang + 2)
    return lines


def _set_several(parts: Sequence[Node], formula: Formula, printer: UnicodePrinter, room: int) -> list[str]:
    """Equations with commas between them, as many on one line as it holds."""
    lines: list[str] = []
    row = TextBox.of("")
    for place, part in enumerate(parts):
        comma = "," if place < len(parts) - 1 else ""
        boxes = list(pieces(part, printer))
        fits = all(isinstance(box, TextBox) or matrix_width(box, printer) < room for box in boxes)
        box = beside([boxed(piece, printer) for piece in boxes]) if fits else None
        if box is not None and box.width < room:
            if row.width and row.width + 1 + box.width + len(comma) > room:
                lines += [*_flushed(row), *([""] if len(row.lines) > 1 else [])]
                row = TextBox.of("")
            row = beside([row, TextBox.of(" " if row.width else ""), box, TextBox.of(comma)])
        else:
            *others, last = set_formula(replace(formula, node=part, optional=False), printer, room - 1)
            lines += [*_flushed(row), *others, last + comma]
            row = TextBox.of("")
    return lines + _flushed(row)


def _grouped(node: Node, printer: UnicodePrinter, room: int) -> Iterator[Group]:
    lead = ""
    for part in pieces(node, printer):
        if isinstance(part, Matrix):
            fits = matrix_width(part, printer) + (_LONGEST_HANG if _is_alone(part, node) else 0) <= room
            yield lead, matrix_box(part, printer) if fits else part
            lead = ""
        else:
            text = part.lines[0]
            if len(part.lines) == 1 and (not text.strip(" =+-×≠≈⇒≤,") or text == " "):
                lead += text
            else:
                yield lead, part
                lead = ""


def _is_alone(matrix: Matrix, node: Node) -> bool:
    """Whether a matrix is a side of an equation, so that its entries may be listed in its place."""
    return matrix in (node.parts if isinstance(node, Relation) else (node,))


def _width(member: Sequence[Group], room: int) -> int:
    """How wide a member of a chain is; more than the room where it is not all boxes."""
    return sum(len(lead) + (piece.width if isinstance(piece, TextBox) else room) for lead, piece in member)


def _members(groups: Sequence[Group]) -> Iterator[list[Group]]:
    """The members of a chain of equations."""
    member: list[Group] = []
    for lead, piece in groups:
        if ("=" in lead or "≈" in lead) and member:
            yield member
            member = []
        member.append((lead, piece))
    yield member


def _set_member(
    member: Sequence[Group], formula: Formula, printer: UnicodePrinter, room: int, indent: int, hang: int
) -> list[str]:
    """One member of a chain, its pieces side by side as far as they go."""
    lines: list[str] = []
    row = TextBox.of(" " * indent)
    for lead, piece in member:
        if not row.lines[0].strip() and len(row.lines) == 1:
            lead = lead.lstrip()
        if isinstance(piece, Matrix):
            is_headed = row.lines[0].strip() != _left_side(formula, printer)
            lines += _flushed(row) if is_headed else []
            lines += _entry_by_entry(piece, formula, printer, room, _UNDER_HEAD * is_headed)
            row = TextBox.of(" " * hang)
        elif row.width + width(lead) + piece.width <= room:
            row = beside([row, TextBox.of(lead), piece])
        elif len(piece.lines) > 1:
            multiplies = not lead.strip() and len(row.lines) > 1
            lines += [*_flushed(row), *[""] * multiplies]
            sign = "· " if multiplies else lead.lstrip()
            margin = max(0, min(hang, room - width(sign) - piece.width))
            row = beside([TextBox.of(" " * margin), TextBox.of(sign), piece])
        else:
            if len(row.lines) > 1:
                lines += _flushed(row)
                row = TextBox.of(" " * hang)
            text = row.lines[0] + lead + piece.lines[0]
            margin = len(text) - len(text.lstrip())
            first, *others = break_sum(text.lstrip(), room - margin, room - hang)
            broken = [" " * margin + first, *(" " * hang + other for other in others)]
            lines += broken[:-1]
            row = TextBox.of(broken[-1])
    return lines + _flushed(row)


def _left_side(formula: Formula, printer: UnicodePrinter) -> str:
    """The letter that the entries of a matrix are named after, so that it need not stand alone."""
    left = formula.node.parts[0] if isinstance(formula.node, Relation) else None
    return printer.text(left) if isinstance(left, Letter) else ""


def _flushed(row: TextBox) -> list[str]:
    return [line.rstrip() for line in row.lines] if any(line.strip() for line in row.lines) else []


def _entry_by_entry(
    matrix: Matrix, formula: Formula, printer: UnicodePrinter, room: int, indent: int
) -> list[str]:
    """`d₁₂ = ...` a line for each entry; equal ones in one chain, those that are 0 last."""
    lines: list[str] = []
    left = formula.node.parts[0] if isinstance(formula.node, Relation) else None
    for chain in entry_equations(matrix, left, formula):
        text = " = ".join(map(printer.text, chain.parts))
        first, *others = break_sum(text, room - indent, room - _HANG - indent)
        lines += [" " * indent + first, *(" " * (indent + _HANG) + other for other in others)]
    return lines
