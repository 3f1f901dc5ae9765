"""Students' pages as they travel and are kept: packed, with a place for the marks."""

from __future__ import annotations

import base64
import zlib

from dynsolve.answers.feedback import FeedbackView, not_recognized, opening, readings, slips
from dynsolve.answers.verdict import Report
from dynsolve.document import Block, Document, Note, Text
from dynsolve.explain.context import style_of
from dynsolve.notation.printing import PLAIN, Style
from dynsolve.problem.model import Problem
from dynsolve.render.html import stylesheet

HEAD_HERE = "Whose it is, and the marks"
"""Where the page gets its head when it is written: names may be learnt, and marks set, later."""


STYLES_HERE = "/* The styles stand here */"
"""Where a page gets its styles when it is written, for they are the same in all of them."""


def pack(text: str) -> str:
    """A page compressed, for the way from the worker and for the record."""
    text = text.replace(stylesheet(), STYLES_HERE)
    return base64.b64encode(zlib.compress(text.encode("utf-8", errors="replace"), 6)).decode()


def unpack(packed: bytes) -> str:
    """A page out of the record."""
    return zlib.decompress(packed).decode().replace(STYLES_HERE, stylesheet(), 1)


def student_page(report: Report, problem: Problem, hints: int) -> tuple[str, str]:
    """A student's page in HTML and Markdown, packed, but for its head."""
    view = FeedbackView(hints, readings=True)
    blocks = (
        *(Note((fault.message,)) for fault in report.faults),
        *opening(report),
        *slips(report, view),
        *readings(report, view),
        *not_recognized(report),
    )
    return _packed(_rendered(blocks, style_of(problem.robot)))


def bare_page(reason: str) -> tuple[str, str]:
    """The page of a hand-in that could not be judged."""
    said = f"The program could not judge this hand-in: {reason}. It is on your teacher's list."
    return _packed(_only_said(said))


def absent_page() -> tuple[str, str]:
    """The page of what was not handed in, for which a teacher gives marks; as it is, not packed."""
    return _only_said("Nothing was handed in here that the program could judge.")


def _only_said(said: str) -> tuple[str, str]:
    return _rendered((Text((said,)),), PLAIN)


def _packed(pages: tuple[str, str]) -> tuple[str, str]:
    html, markdown = pages
    return pack(html), pack(markdown)


def _rendered(blocks: tuple[Block, ...], style: Style) -> tuple[str, str]:
    from dynsolve.render.html import render as render_html
    from dynsolve.render.markdown import render as render_markdown

    document = Document((Text((HEAD_HERE,)), *blocks))
    return render_html(document, style), render_markdown(document, style)
