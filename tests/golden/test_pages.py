"""Three worked solutions as a book would print them, read line by line; a change of one is seen as text.

The files in `pages` are what `dynsolve solve NAME` prints.  After a change that is meant, read the new page
before it takes the place of the old one: `dynsolve solve NAME -o tests/golden/pages/NAME.txt`.
"""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from dynsolve.render import terminal
from dynsolve.solution.documents import solution_document
from tests.support import solved

PAGES = Path(__file__).parent / "pages"

_ERROR = re.compile(r"\(relative\s+error [^)]*\)")
"""What differs from machine to machine."""


@pytest.mark.parametrize("problem", ["in3140-rp", "planar-2r", "elbow-3r"])
def test_a_solution_is_the_page_that_was_read(problem: str) -> None:
    solution = solved(problem)
    lines = terminal.render(solution_document(solution), style=solution.style)
    text = "".join(f"{line.text}\n" for line in lines)
    expected = (PAGES / f"{problem}.txt").read_text(encoding="utf-8")
    assert _ERROR.sub("", text) == _ERROR.sub("", expected)
