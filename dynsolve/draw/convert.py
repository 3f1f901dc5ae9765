"""SVG as PDF and PNG, by typst, with its own fonts: the same bytes on every machine."""

from __future__ import annotations

from typing import Literal

from dynsolve.errors import UsageError
from dynsolve.notation.typst import quoted

RESOLUTION = 192.0
"""Picture elements an inch, of a PNG."""

_PAGE = """#set document(title: {title}, date: none)
#set page(width: auto, height: auto, margin: 0pt)
#image(bytes({svg}), format: "svg", alt: {alt})
"""


def to_pdf(svg: str, title: str = "", alt: str = "") -> bytes:
    """A page of PDF, the same bytes for the same picture.

    Raises UsageError where the extra `pdf` is not installed.
    """
    return _compiled(svg, title, alt, "pdf")


def to_png(svg: str) -> bytes:
    """A PNG.  Raises UsageError where the extra `pdf` is not installed."""
    return _compiled(svg, "", "", "png")


def _compiled(svg: str, title: str, alt: str, format: Literal["pdf", "png"]) -> bytes:
    try:
        import typst
    except ImportError:
        raise UsageError(f"{format.upper()} needs the extra [pdf]: pip install 'dynsolve[pdf]'") from None
    page = _PAGE.format(title=quoted(title), svg=quoted(svg), alt=quoted(alt))
    made: bytes = typst.compile(
        page.encode(), format=format, ppi=RESOLUTION, ignore_system_fonts=True, timestamp=0
    )
    return made
