r"""A scene as LaTeX that needs no package: paths as PDF operators, labels set by LaTeX itself.

The paths go into the page as they are (`\pdfliteral` and what other engines call it),
in a `picture` environment that gives them and the labels their places.
"""

from __future__ import annotations

from collections.abc import Iterator

from dynsolve.draw.labels import Label
from dynsolve.draw.paths import Commands, Path
from dynsolve.draw.scene import Scene
from dynsolve.draw.svg import number
from dynsolve.draw.typography import SIZE
from dynsolve.notation.latex import LatexPrinter
from dynsolve.notation.printing import Style
from dynsolve.notation.tree import Node, Product, Quotient, Row, Sum, Words

WIDEST = 345.0
"""The width of a page's text, in big points."""

_UNIT = 0.6
_BIG_POINT = 72.27 / 72  # in points
_OPERATORS = {"M": "m", "L": "l", "C": "c", "Z": "h"}
_SIZES = (10, 9, 8, 7, 6, 5)
"""The sizes in which TeX has its letters, in points."""

_LITERAL = r"""\ifx\dynsolveink\undefined
\def\dynsolveink#1{\special{pdf:content #1}}
\ifx\pdfextension\undefined\else\def\dynsolveink#1{\pdfextension literal{#1}}\fi
\ifx\pdfliteral\undefined\else\ifnum\pdfoutput>0 \def\dynsolveink#1{\pdfliteral{#1}}\fi\fi
\fi"""
"""pdfTeX, LuaTeX, and engines with a separate driver."""


def to_latex_picture(scene: Scene) -> str:
    """The picture as a group of LaTeX."""
    box = scene.frame
    wide, high = box.right - box.left, box.bottom - box.top
    unit = min(_UNIT, WIDEST / wide)
    lines = [
        rf"{{\fontsize{{{font_size(unit)}}}{{12}}\selectfont",
        _LITERAL,
        rf"\setlength{{\unitlength}}{{{unit:.3f}bp}}%",
        rf"\begin{{picture}}({number(wide)},{number(high)})%",
        rf"\put(0,0){{\dynsolveink{{q {unit:.3f} 0 0 {unit:.3f} 0 0 cm 1 j 1 J",
        *(operators for path in scene.paths for operators in _path(path, box.left, box.bottom)),
        "Q}}%",
        *(_label(label, scene) for label in scene.labels),
        r"\end{picture}}",
    ]
    return "\n".join(lines)


def font_size(unit: float) -> int:
    """The largest letters, in points, that are no larger than a picture with this unit has room for."""
    room = SIZE * unit * _BIG_POINT
    return next((size for size in _SIZES if size <= room), _SIZES[-1])


def _path(path: Path, left: float, bottom: float) -> Iterator[str]:
    """The operators of a path; y grows upwards on a page of PDF."""
    state = []
    if path.stroke:
        state.append(f"{_colour(path.stroke)} RG {number(path.width)} w")
    if path.fill:
        state.append(f"{_colour(path.fill)} rg")
    state.append("[4 3] 0 d" if path.dashed else "[] 0 d")
    yield " ".join(state)
    yield from _commands(path.commands, left, bottom)
    yield {(True, True): "B", (True, False): "S", (False, True): "f"}.get(
        (path.stroke is not None, path.fill is not None), "n"
    )


def _commands(commands: Commands, left: float, bottom: float) -> Iterator[str]:
    for letter, points in commands:
        places = " ".join(f"{number(x - left)} {number(bottom - y)}" for x, y in points)
        yield f"{places} {_OPERATORS[letter]}".strip()


def _colour(colour: str) -> str:
    """`#ff0000` as 1 0 0."""
    return " ".join(f"{int(colour[k : k + 2], 16) / 255:.3f}" for k in (1, 3, 5))


class _Printer(LatexPrinter):
    """LaTeX that needs no package for a word, with fractions on the line, where their digits stay large."""

    def _words(self, node: Words) -> str:
        return rf"\mathrm{{{node.text}}}"

    def _quotient(self, node: Quotient) -> str:
        if isinstance(node.numerator, Sum) or isinstance(node.denominator, Sum | Product):
            return super()._quotient(node)
        return f"{self.text(node.numerator)}/{self.text(node.denominator)}"


def _formula(node: Node, style: Style) -> str:
    """A label's formula; a list of names needs no package for its commas."""
    if isinstance(node, Row):
        return r",\,".join(_formula(part, style) for part in node.parts if not isinstance(part, Words))
    return _Printer(style).text(node)


def _label(label: Label, scene: Scene) -> str:
    x, y = label.box.center
    place = f"{number(x - scene.frame.left)},{number(scene.frame.bottom - y)}"
    formula = _formula(label.node, scene.style)
    return (
        rf"\put({place}){{\makebox(0,0){{\dynsolveink{{{_colour(label.colour)} rg}}"
        rf"${formula}$\dynsolveink{{0 g}}}}}}%"
    )
