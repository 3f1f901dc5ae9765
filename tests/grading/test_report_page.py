"""The teacher's page in a real browser: it fetches nothing, sorts, links, and is read in light and dark."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import unquote

import pytest

import dynsolve
from tests.grading.generate import course, problem_set
from tests.reports.browser import Page, chromium

pytestmark = pytest.mark.browser

NAME = '<img src=x onerror="document.title=1">"\'=1+1'
HIDDEN = "gnp\u202e.yaml"
SLIP = "answers:\n  K: I1zz*theta1'^2/2 + m2*(L2'^2 + L2*theta1'^2)/2\n  P: m1*g*L1 + m2*g*L1\n"


@pytest.fixture(scope="module")
def out(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Nine generated students, three with the same slip, one of them of an odd name, a PDF, a hidden name."""
    folder = tmp_path_factory.mktemp("course")
    problem_set(folder / "set")
    course(folder / "in", 9)
    for student in ("twin1", "twin2", NAME):
        place = folder / "in" / student.replace("/", "_") / "in3140-rp.yaml"
        place.parent.mkdir(parents=True)
        place.write_text(SLIP)
    (folder / "in" / HIDDEN).write_text(SLIP)
    (folder / "in" / "scanned").mkdir()
    (folder / "in" / "scanned" / "planar-2r.pdf").write_bytes(b"%PDF-1.7")
    dynsolve.grade(folder / "set", folder / "in", folder / "out")
    dynsolve.override(folder / "out", "twin1", "in3140-rp", "K", marks="3.25", why="<b>nearly</b>")
    dynsolve.override(folder / "out", "twin2", "in3140-rp", "K", marks="3.5", why="nearly")
    return folder / "out"


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Page]:
    with chromium(tmp_path_factory.mktemp("profile")) as opened:
        yield opened


def _rows(page: Page, section: str) -> list[list[str]]:
    """The cells of the table of a section."""
    table = f"document.getElementById({json.dumps(section)}).nextElementSibling"
    wrapped = f"({table}.tagName === 'P' ? {table}.nextElementSibling : {table}).querySelector('tbody')"
    return page.ask(f"[...{wrapped}.rows].map(r => [...r.cells].map(c => c.textContent))")


def test_nothing_is_fetched_and_nothing_overflows(page: Page, out: Path) -> None:
    for width in (400, 1000, 1200):
        page.open(out / "report.html", width)
        assert page.requests == [(out / "report.html").as_uri()]
        tables = "[...document.querySelectorAll('.wide')]"
        assert width < 1000 or page.ask(f"{tables}.every(t => t.scrollWidth <= t.clientWidth)") is True
        assert page.complaints == []
        assert page.ask("document.documentElement.scrollWidth <= innerWidth") is True


def test_every_link_leads_to_a_page_that_is_there(page: Page, out: Path) -> None:
    page.open(out / "report.html", 1200)
    links = page.ask("[...document.querySelectorAll('a')].map(a => a.getAttribute('href'))")
    inside = [link for link in links if link.startswith("#")]
    assert len(inside) == 7
    lost = (
        "[...document.querySelectorAll('nav a')].filter(a => !document.querySelector(a.getAttribute('href')))"
    )
    assert page.ask(f"{lost}.length") == 0
    outside = {unquote(link) for link in links if not link.startswith("#")}
    pages, copies = (out / "feedback").glob("*/*.html"), (out / "hand-ins").glob("*")
    assert outside == {str(path.relative_to(out)) for path in (*pages, *copies, out / "queue.html")}


def test_every_table_and_every_histogram_says_what_it_is(page: Page, out: Path) -> None:
    page.open(out / "report.html", 1200)
    assert page.ask("[...document.querySelectorAll('table')].every(t => t.caption?.textContent)") is True
    said = page.ask("[...document.querySelectorAll('figure figcaption')].map(f => f.textContent)")
    assert [one.partition(":")[0] for one in said] == ["All problems", "in3140-rp", "planar-2r", "elbow-3r"]
    labels = "[...document.querySelectorAll('svg[role=img]')].map(s => s.getAttribute('aria-label'))"
    assert [label.startswith(one) for label, one in zip(page.ask(labels), said, strict=True)] == [True] * 4
    counts = "[...document.querySelectorAll('svg')].map(s => [...s.querySelectorAll('g text:first-of-type')])"
    assert page.ask(f"{counts}[0].reduce((sum, t) => sum + Number(t.textContent), 0)") == 12  # scanned waits


def test_a_header_sorts_numbers_as_numbers_by_mouse_and_keyboard(page: Page, out: Path) -> None:
    page.open(out / "report.html", 1200)
    button = (
        "[...document.getElementById('students').nextElementSibling.querySelectorAll('th button')]"
        ".find(b => b.textContent === 'in3140-rp')"
    )
    page.ask(f"{button}.click()")
    marks = [float(row[1]) for row in _rows(page, "students")]
    assert marks == sorted(marks) and {3.25, 3.5} <= set(marks)  # 3.25 before 3.5, though 25 is more than 5
    page.ask(f"{button}.focus()")
    for kind in ("keyDown", "keyUp"):
        page.call(
            "Input.dispatchKeyEvent",
            type=kind,
            key="Enter",
            code="Enter",
            text="\r",
            windowsVirtualKeyCode=13,
        )
    marks = [float(row[1]) for row in _rows(page, "students")]
    assert marks == sorted(marks, reverse=True)
    assert page.ask(f"{button}.parentElement.getAttribute('aria-sort')") == "descending"


def test_what_a_teacher_looks_for_is_told(page: Page, out: Path) -> None:
    page.open(out / "report.html", 1200)
    alike = [row for row in _rows(page, "the-same-wrong-expression") if row[:2] == ["in3140-rp", "K"]]
    assert [row[2] for row in alike] == ["3"]
    assert "twin1, twin2" in alike[0][4]
    slips = {(row[1], row[2]): row[5] for row in _rows(page, "commonest-slips") if row[4] == NAME}
    assert slips["K", "a square left out"] == "In m₂ L₂ θ̇₁²/2 the L₂ should be squared."
    assert slips["P", "a factor such as ½"] == "m₁ g L₁ has 1 in front where ½ belongs."
    waiting = [row for row in _rows(page, "for-a-human") if row[0] == "scanned"]
    why = ["scanned/planar-2r.pdf", "a PDF: a human reads it"]
    assert waiting == [["scanned", "planar-2r", name, *why] for name in ("P", "K", "D", "C", "g", "tau")]
    hand = _rows(page, "set-by-hand")
    assert hand[0][:4] == ["twin1", "in3140-rp", "K", "3.25 of 4"]
    assert hand[0][4] == "set by the teacher: <b>nearly</b> (the program: wrong: 0 of 4)"


def test_a_name_is_text(page: Page, out: Path) -> None:
    page.open(out / "report.html", 1200)
    assert page.ask("document.querySelectorAll('img, b').length") == 0
    assert page.ask("document.title") == "Three robots"
    assert "\u202e" not in page.ask("document.documentElement.outerHTML")
    for path in out.rglob("*.*"):
        if path.suffix in (".html", ".md", ".csv"):
            text = path.read_text()
            assert "\u202e" not in text, path
            assert "<img" not in text or path.suffix == ".csv", path
    assert '"<img src=x onerror=""document.title=1"">""\'=1+1",' in (out / "grades.csv").read_text()
    assert any(row[3] == "gnp\\u202e.yaml" for row in _rows(page, "for-a-human"))


def test_light_and_dark_can_be_read(page: Page, out: Path) -> None:
    for scheme, dark in (("light", False), ("dark", True)):
        page.open(out / "report.html", 1200, scheme)
        ink = page.ask("getComputedStyle(document.querySelector('td')).color.match(/\\d+/g).map(Number)")
        assert (sum(ink[:3]) > 380) is dark
        link = page.ask("getComputedStyle(document.querySelector('a')).color.match(/\\d+/g).map(Number)")
        assert (sum(link[:3]) > 380) is dark


def test_students_pages_fit_a_phone_and_fetch_nothing(page: Page, out: Path) -> None:
    pages = sorted((out / "feedback").glob("*/*.html"))
    for path in (*pages[:4], *(out / "feedback" / "twin1").glob("*.html")):
        for width in (400, 1200):
            page.open(path, width, "dark")
            assert page.requests == [path.as_uri()]
            assert page.complaints == []
            assert page.ask("document.documentElement.scrollWidth <= innerWidth") is True, path
            assert page.ask("document.querySelectorAll('script').length") == 0
    assert page.ask("document.querySelector('.marks').textContent").count("set by the teacher") == 1
    assert page.ask("document.querySelectorAll('b').length") == 0
