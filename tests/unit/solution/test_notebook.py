"""What a notebook shows of a solution, and the pages it gives to Python."""

from __future__ import annotations

from html.parser import HTMLParser

import pytest

import dynsolve
from dynsolve.errors import UsageError


class _Tags(HTMLParser):
    """The tags that are open, and whether each was closed in its turn."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.seen: list[str] = []

    def handle_starttag(self, tag: str, attrs: object) -> None:
        if tag not in ("br", "wbr", "input"):
            self.open.append(tag)
            self.seen.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


@pytest.fixture(scope="module")
def solution() -> dynsolve.Solution:
    return dynsolve.solve("in3140-rp")


def test_a_solution_is_named_in_a_line(solution: dynsolve.Solution) -> None:
    assert repr(solution).startswith("<Solution of RP manipulator, verified")
    assert len(repr(solution)) < 100


def test_a_notebook_shows_the_results_before_the_steps(solution: dynsolve.Solution) -> None:
    page = _Tags()
    shown = solution._repr_html_()
    page.feed(shown)
    assert not page.open
    assert not {"html", "style", "script"} & set(page.seen)
    assert shown.index("Summary") < shown.index("Worked solution") < shown.index("Denavit-Hartenberg table")
    text = solution._repr_markdown_()
    assert text.index("## Summary") < text.index("<summary>Worked solution</summary>") < text.index("1.1 ")
    formulas = solution._repr_latex_().splitlines()
    assert all(line.startswith("$$") and line.endswith("$$") for line in formulas)
    assert any("\\boldsymbol{\\tau}" in line for line in formulas)


def test_pages_at_a_depth(solution: dynsolve.Solution) -> None:
    brief, full = solution.to_markdown("brief"), solution.to_markdown("full")
    assert len(brief) < len(solution.to_markdown()) < len(full)
    assert solution.to_latex("results").startswith("\\documentclass")
    assert 'id="brief" checked' in solution.to_html("brief")
    with pytest.raises(UsageError, match="long is no depth"):
        solution.to_markdown("long")
