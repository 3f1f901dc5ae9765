"""Students' pages as they travel and are kept: packed, with a place for the marks."""

from __future__ import annotations

import base64
import zlib

from dynsolve.answers.feedback import FeedbackView, not_recognized, opening, readings, slips
from dynsolve.answers.verdict import Report
from dynsolve.document import Block, Document, Heading, Note, Text
from dynsolve.explain.style import style_of
from dynsolve.notation.printing import PLAIN, Style
from dynsolve.problem.model import Problem
from dynsolve.render.html import stylesheet

MARKS_HERE = "The marks stand here"
TABLE_HERE = "The marks of each answer stand here"
"""Where the page gets its marks when it is written: a teacher may override them later."""


STYLES_HERE = "/* The styles stand here */"
"""Where a page gets its styles when it is written, for they are the same in all of them."""


def pack(text: str) -> str:
    """A page compressed, for the way from the worker and for the record."""
    text = text.replace(stylesheet(), STYLES_HERE)
    return base64.b64encode(zlib.compress(text.encode("utf-8", errors="replace"), 6)).decode()


def unpack(packed: bytes) -> str:
    """A page out of the record."""
    return zlib.decompress(packed).decode().replace(STYLES_HERE, stylesheet(), 1)


def student_page(report: Report, problem: Problem, student: str, hints: int) -> tuple[str, str]:
    """A student's page in HTML and Markdown, packed; the marks are put in when it is written."""
    view = FeedbackView(hints, readings=True)
    blocks = (
        Text((MARKS_HERE,)),
        *(Note((fault.message,)) for fault in report.faults),
        *opening(report),
        *slips(report, view),
        Heading("Marks"),
        Text((TABLE_HERE,)),
        *readings(report, view),
        *not_recognized(report),
    )
    return _packed(_rendered(f"{problem.title}: {student}", blocks, style_of(problem.robot)))


def bare_page(title: str, student: str, reason: str) -> tuple[str, str]:
    """The page of a hand-in that could not be judged."""
    said = f"The program could not judge this hand-in: {reason}. It is on your teacher's list."
    return _packed(_only_said(title, student, said))


def absent_page(title: str, student: str) -> tuple[str, str]:
    """The page of what was not handed in, for which a teacher gives marks; as it is, not packed."""
    return _only_said(title, student, "Nothing was handed in here that the program could judge.")


def _only_said(title: str, student: str, said: str) -> tuple[str, str]:
    blocks = (Text((MARKS_HERE,)), Text((said,)), Text((TABLE_HERE,)))
    return _rendered(f"{title}: {student}", blocks, PLAIN)


def _packed(pages: tuple[str, str]) -> tuple[str, str]:
    html, markdown = pages
    return pack(html), pack(markdown)


def _rendered(title: str, blocks: tuple[Block, ...], style: Style) -> tuple[str, str]:
    from dynsolve.render.html import render as render_html
    from dynsolve.render.markdown import render as render_markdown

    document = Document((Heading(title, 1), *blocks))
    return render_html(document, style), render_markdown(document, style)
