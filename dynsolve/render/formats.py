"""The forms that results have, and the suffixes of files that say them."""

from __future__ import annotations

from enum import StrEnum


class Format(StrEnum):
    """The forms of a solution."""

    TEXT = "text"
    JSON = "json"
    LATEX = "latex"
    PDF = "pdf"
    HTML = "html"
    MARKDOWN = "markdown"


SUFFIXES = {
    ".txt": Format.TEXT,
    ".json": Format.JSON,
    ".tex": Format.LATEX,
    ".pdf": Format.PDF,
    ".html": Format.HTML,
    ".htm": Format.HTML,
    ".md": Format.MARKDOWN,
    ".markdown": Format.MARKDOWN,
}
"""What the suffix of a file says; the first of a form is the one that is written."""


def suffix_of(format: Format) -> str:
    """The suffix of a form's files."""
    return next(suffix for suffix, named in SUFFIXES.items() if named is format)
