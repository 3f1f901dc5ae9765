"""Students' pages as they travel and are kept: packed, with a place for the marks."""

from __future__ import annotations

import base64
import zlib

from dynsolve.document import Document, Heading, Text

MARKS_HERE = "The marks stand here"
"""Where the page gets its marks when it is written: a teacher may override them later."""


def pack(text: str) -> str:
    """A page as it travels and is kept."""
    return base64.b64encode(zlib.compress(text.encode("utf-8", errors="replace"), 6)).decode()


def unpack(packed: bytes) -> str:
    """A page out of the record."""
    return zlib.decompress(packed).decode()


def bare_page(title: str, student: str, reason: str) -> tuple[str, str]:
    """The page of a hand-in that could not be judged."""
    from dynsolve.render.html import render as render_html
    from dynsolve.render.markdown import render as render_markdown

    said = f"This hand-in could not be judged by the program: {reason}. Your teacher has been told."
    blocks = (Heading(f"{title}: {student}", 1), Text((MARKS_HERE,)), Text((said,)))
    document = Document(blocks)
    return pack(render_html(document)), pack(render_markdown(document))
