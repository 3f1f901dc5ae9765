"""What solutions, feedback and reports are made of: frozen data, no markup.

Prose is a sequence of words, formulas and what somebody typed; a block is a heading, a paragraph, a
displayed formula, a list, a note, a table or a fold of further blocks.  Renderers
in `dynsolve.render` turn documents into what a person sees.

`sentences` writes prose as it is read; `books` has the books that references name, and their editions;
`figures` has drawings as data, before `dynsolve.draw` makes pictures of them.

To add a kind of block, add its dataclass here and its case to each renderer.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.notation.tree import Node


class Verbatim(Struct, frozen=True):
    """What somebody typed, shown as it is: nothing in it is taken for mathematics."""

    text: str


class Reference(Struct, frozen=True):
    """The numbers of results, after words that lead to them: of (3) and (7).

    Nothing, words and all, where a page has no numbers.
    """

    labels: tuple[str, ...]
    before: str = " "


Inline = str | Node | Verbatim | Reference
"""A piece of a sentence: words, a formula among them, what somebody typed, numbers of results."""

Prose = tuple[Inline, ...]
"""A sentence or several."""


class Heading(Struct, frozen=True):
    """A heading; level 1 is the document's title.

    From one that is `closing` to the end is one page, where all of that fits one; an `appendix` may be
    folded away.
    """

    text: str
    level: int = 2
    closing: bool = False
    appendix: bool = False


class Text(Struct, frozen=True):
    """A paragraph; `source` is where the textbook has what it says."""

    parts: Prose
    source: str = ""


class Formula(Struct, frozen=True):
    """A displayed formula.

    `source` is where the textbook has it.  `label` names a result, so that it may be
    referred to.  `entries` names the entries of a matrix
    that is too wide to be laid out: a matrix of names, of its shape.  `also` are the labels of further
    results in the same display.  An `optional`
    formula is left out where its matrices do not fit the page side by side; `otherwise`
    stands in the place of one of which a matrix does not fit a terminal.
    """

    node: Node
    source: str = ""
    entries: tuple[tuple[Node, ...], ...] = ()
    optional: bool = False
    label: str = ""
    otherwise: tuple[Formula, ...] = ()
    also: tuple[str, ...] = ()


DEFINITIONS = "names-"
"""What the label of a display begins with that defines names."""


class Equations(Struct, frozen=True):
    """Short equations in one display, one under another and level at their equals signs.

    Many that do not follow from each other are set `in_columns` where there is room.  A `label`
    names them all, so that they may be referred to by one number, and so do the labels in `also`.
    """

    nodes: tuple[Node, ...]
    in_columns: bool = False
    label: str = ""
    also: tuple[str, ...] = ()


class Uses(Struct, frozen=True):
    """What goes into the next formula: labels of formulas that stand before it; `parts` leads on to it."""

    labels: tuple[str, ...]
    parts: Prose = ()


class Picture(Struct, frozen=True):
    """A drawing: SVG for what can show it, LaTeX's own `picture` for what sets type with LaTeX."""

    svg: str
    caption: str = ""
    latex: str = ""


class List(Struct, frozen=True):
    """Items, one under another."""

    items: tuple[Prose, ...]


class Note(Struct, frozen=True):
    """A remark beside the text: a pitfall that applies here."""

    parts: Prose


class Table(Struct, frozen=True):
    """Rows of cells under a header, each cell words or a formula."""

    header: tuple[Inline, ...]
    rows: tuple[tuple[Inline, ...], ...]


class Fold(Struct, frozen=True):
    """Blocks that belong together under a title and may be folded away, further folds among them."""

    title: str
    blocks: tuple[Block, ...]


Block = Heading | Text | Formula | Equations | Uses | List | Note | Table | Picture | Fold


class Document(Struct, frozen=True):
    """Blocks in order."""

    blocks: tuple[Block, ...]

    @property
    def is_titled(self) -> bool:
        """Whether it begins with a title."""
        return any(isinstance(block, Heading) and block.level == 1 for block in self.blocks[:1])


def _same(part: Any) -> Any:
    return part


def rewritten(
    document: Document,
    *,
    words: Callable[[str], str] = _same,
    displayed: Callable[[Node], Node] = _same,
    inline: Callable[[Node], Node] = _same,
) -> Document:
    """The document with its words, its displayed formulas and those among words changed.

    The sources of formulas are words, too.
    """

    def prose(parts: Prose) -> Prose:
        return tuple(map(part_of_prose, parts))

    def part_of_prose(part: Inline) -> Inline:
        if isinstance(part, str):
            return words(part)
        return inline(part) if isinstance(part, Node) else part

    def block(old: Block) -> Block:
        match old:
            case Text():
                return replace(old, parts=prose(old.parts), source=words(old.source))
            case Uses() | Note():
                return replace(old, parts=prose(old.parts))
            case Formula():
                return formula(old)
            case Equations():
                return replace(old, nodes=tuple(map(displayed, old.nodes)))
            case List():
                return replace(old, items=tuple(map(prose, old.items)))
            case Table():
                return replace(old, rows=tuple(map(prose, old.rows)))
            case Fold():
                return replace(old, blocks=tuple(map(block, old.blocks)))
        return old

    def formula(old: Formula) -> Formula:
        others = tuple(map(formula, old.otherwise))
        return replace(old, node=displayed(old.node), source=words(old.source), otherwise=others)

    return Document(tuple(map(block, document.blocks)))
