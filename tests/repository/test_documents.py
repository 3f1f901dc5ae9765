"""What the documents of the repository point to is there: links, headings, and the paths that they name."""

from __future__ import annotations

import re
from pathlib import Path
from posixpath import dirname, join, normpath

import pytest

import dynsolve
from tests.support import ROOT

PACKAGE = Path(dynsolve.__file__).parent
"""The package; CI tests the installed one, which does not lie beside the tests."""

FOLDERS = ("dynsolve", "problems", "tests", ".ci", ".github")
ENDINGS = (".py", ".toml", ".css", ".js")
"""What begins or ends so, in backticks, is a path of the repository; other names may be the reader's."""


def located(path: str) -> Path:
    """A path of the repository, wherever the package lies."""
    return PACKAGE / path.removeprefix("dynsolve/") if path.startswith("dynsolve/") else ROOT / path


def prose(document: str) -> str:
    """A document without its blocks of code."""
    text = located(document).read_text(encoding="utf-8")
    return re.sub(r"^```.*?^```$", "", text, flags=re.MULTILINE | re.DOTALL)


def anchors(document: str) -> set[str]:
    """The headings of a document, as GitHub makes anchors of them."""
    headings = re.findall(r"^#+ (.*)$", prose(document), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def candidates(path: str, document: str) -> list[Path]:
    """Where a path that a document names may lie: seen from the top, the package, the document's folder."""
    found = [located(path), PACKAGE / path, located(join(dirname(document), path))]
    return found if "/" in path else found + list(PACKAGE.rglob(path))


DOCUMENTS = [
    name
    for name in (
        "README.md", "dynsolve/README.md", "problems/README.md", "problems/students.md",
        "problems/teachers.md", "problems/python.md", "tests/README.md", ".github/CONTRIBUTING.md",
    )
    if located(name).exists()
]  # fmt: skip


def test_the_documents_are_there() -> None:
    assert {"README.md", "tests/README.md", ".github/CONTRIBUTING.md"} <= set(DOCUMENTS)


@pytest.mark.parametrize("document", DOCUMENTS)
def test_links_lead_somewhere(document: str) -> None:
    for target in re.findall(r"\]\(([^)\s]+)\)", prose(document)):
        if re.match(r"https?:|mailto:", target):
            continue
        path, _, anchor = target.partition("#")
        page = normpath(join(dirname(document), path)) if path else document
        assert located(page).exists(), f"{document}: {target}"
        assert not anchor or anchor in anchors(page), f"{document}: {target}"


@pytest.mark.parametrize("document", DOCUMENTS)
def test_paths_that_are_named_exist(document: str) -> None:
    named = re.findall(r"`([\w.-]+(?:/[\w.-]+)*/?)`", prose(document))
    paths = [path for path in named if path.split("/")[0] in FOLDERS or path.endswith(ENDINGS)]
    assert [path for path in paths if not any(place.exists() for place in candidates(path, document))] == []
