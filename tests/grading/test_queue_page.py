"""The page of the queue in a real browser: filled in, kept, saved, and taken back by `override --from`."""

from __future__ import annotations

import csv
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

import dynsolve
from dynsolve.grading.public import override_all
from dynsolve.problem.reader import find
from tests.reports.browser import Page, chromium
from tests.support import with_files

pytestmark = pytest.mark.browser

HOSTILE = "=Eve <script>document.title='taken'<"
ATTACK = "</pre><script>document.title='taken'</script><img src=x onerror=\"document.title='taken'\">"
REPORT = f"""# {ATTACK}

$$K = \\frac12 I_{{1,zz}} \\dot\\theta_1^2 + ( {ATTACK} $$

text \u202e of the student
"""
SCAN = bytes.fromhex(
    "89504e470d0a1a0a0000000d4948445200000001000000010806000000"
    "1f15c4890000000d49444154789c6360000002000001e221bc330000000049454e44ae426082"
)


@pytest.fixture(scope="module")
def course(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("course")
    for name in ("in3140-rp", "planar-2r"):
        with_files(folder / "set", {f"{name}.yaml": find(name).read_bytes()})
    marks = "marks: {in3140-rp: {K: 4, tau1: 2}, planar-2r: {d12: 1}}\n"
    with_files(folder / "set", {"set.yaml": f"title: <b>Set</b>\n{marks}"})
    hand_ins: dict[str, str | bytes] = {
        f"{HOSTILE}/in3140-rp.md": REPORT,
        "bob/planar-2r.png": SCAN,
        "bob/in3140-rp.yaml": "answers:\n  K: I1zz*theta1'^2/2 + m2*(L2'^2 + L2^2*theta1'^2)/2\n  tau1: 0\n",
        "bob/in3140-rp notes.pdf": b"%PDF",
    }
    with_files(folder / "in", hand_ins)
    dynsolve.grade(folder / "set", folder / "in", folder / "out", jobs=1)
    return folder


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Page]:
    with chromium(tmp_path_factory.mktemp("profile")) as opened:
        yield opened


def _rows(path: Path) -> list[dict[str, str]]:
    with path.open(newline="") as stream:
        return list(csv.DictReader(stream))


def _choose(page: Page, answer: str, student: str) -> None:
    which = f"f.dataset.answer === '{answer}' && f.dataset.row.includes('{student}')"
    page.ask(f"window.chosen = answers.find(f => {which}); 0")


def _fill(page: Page, answer: str, student: str, marks: str, comment: str = "") -> None:
    """Type marks and a comment for an answer."""
    _choose(page, answer, student)
    for part, text in (("input", marks), ("textarea", comment)):
        page.ask(f"chosen.querySelector('{part}').select() ?? chosen.querySelector('{part}').focus()")
        page.call("Input.insertText", text=text)


def _key(page: Page, key: str, modifiers: int = 0) -> None:
    for kind in ("rawKeyDown", "keyUp"):
        page.call("Input.dispatchKeyEvent", type=kind, key=key, code=key, modifiers=modifiers)


def _status(page: Page) -> str:
    return str(page.ask("status.textContent"))


def test_it_fits_fetches_nothing_else_and_runs_nothing_of_a_students(page: Page, course: Path) -> None:
    out = course / "out"
    scans = [path.as_uri() for path in (out / "hand-ins").glob("*.png")]
    for width in (400, 1000):
        page.open(out / "queue.html", width)
        assert set(page.requests) <= {(out / "queue.html").as_uri(), *scans}
        assert page.complaints == []
        assert page.ask("document.documentElement.scrollWidth <= innerWidth") is True
    assert page.ask("document.title") == "<b>Set</b>: what waits for a human"
    assert page.ask("document.querySelectorAll('script').length") == 1
    assert page.ask("[...document.images].map(image => image.alt)") == ["What was handed in"]
    assert "\u202e" not in page.ask("document.documentElement.outerHTML")
    named = "[...document.querySelectorAll('input, textarea, select')].every(one => one.labels.length === 1)"
    assert page.ask(named) is True


def test_the_line_is_marked_beside_the_key(page: Page, course: Path) -> None:
    page.open(course / "out" / "queue.html", 1000)
    entry = "answers.find(f => f.dataset.answer === 'K' && f.dataset.row.includes('Eve')).closest('article')"
    assert page.ask(f"{entry}.querySelector('mark').textContent") == REPORT.split("\n")[2]
    page.ask(f"{entry}.scrollIntoView()")
    for _ in range(100):
        if page.ask(f"{entry}.querySelectorAll('.key math').length"):
            break
    assert "L" in page.ask(f"{entry}.querySelector('.key math').textContent")
    left, right = (
        page.ask(f"{entry}.querySelector('{one}').getBoundingClientRect().x") for one in ("pre", "input")
    )
    assert left < right


def test_what_is_saved_untouched_is_the_queue(page: Page, course: Path) -> None:
    page.open(course / "out" / "queue.html", 1000)
    assert page.ask("queueCsv()") == (course / "out" / "queue.csv").read_text()


def test_filters_and_keys_lead_to_entries(page: Page, course: Path) -> None:
    page.open(course / "out" / "queue.html", 1000)
    shown = "entries.filter(e => e.checkVisibility()).length"
    every = page.ask(shown)
    page.ask("filters.elements.problem.value = 'planar-2r'; refresh()")
    assert page.ask(shown) == 1 < every
    page.ask("filters.elements.problem.value = ''; filters.elements.text.value = 'eve'; refresh()")
    assert 0 < page.ask(shown) < every
    page.ask("filters.reset(); refresh()")
    places = []
    for key, modifiers in (("j", 0), ("ArrowDown", 1), ("ArrowUp", 1)):
        _key(page, key, modifiers)
        places.append(page.ask("entries.findIndex(e => e.contains(document.activeElement))"))
    assert places == [0, 1, 0]


def test_filled_in_kept_saved_and_taken_back(page: Page, course: Path, tmp_path: Path) -> None:
    out = course / "out"
    page.open(out / "queue.html", 1000)
    assert "0 of " in _status(page)
    comment = '=1+1, "nearly" <b>right</b>'
    _fill(page, "K", "Eve", "9")
    assert page.ask("chosen.querySelector('input').getAttribute('aria-invalid')") == "true"
    page.ask("save()")
    assert "Not saved: these marks are no number from 0 to 4." in _status(page)
    _fill(page, "K", "Eve", "2,5", comment)
    page.open(out / "queue.html", 1000)
    _choose(page, "K", "Eve")
    assert page.ask("chosen.querySelector('textarea').value") == comment
    _fill(page, "d12", "bob", "1/2", "on paper")
    _fill(page, "K", "bob", "", "your notes are fine")
    page.call("Page.setDownloadBehavior", behavior="allow", downloadPath=str(tmp_path))
    page.ask("document.getElementById('save').click()")
    saved = tmp_path / "queue.csv"
    end = time.monotonic() + 20
    while not saved.is_file() and time.monotonic() < end:
        time.sleep(0.02)
    before = {row["student"]: row["total"] for row in _rows(out / "grades.csv")}
    assert override_all(out, saved) == 3
    after = {row["student"]: row["total"] for row in _rows(out / "grades.csv")}
    assert (before["bob"], after["bob"]) == ("4", "4.5")
    (eve,) = {student for student in after if "Eve" in student}
    assert (before[eve], after[eve]) == ("0", "2.5")
    pages = "".join(path.read_text() for path in (out / "feedback").rglob("*.html"))
    assert "set by the teacher: =1+1, &quot;nearly&quot; &lt;b&gt;right&lt;/b&gt;" in pages
    assert "the teacher: your notes are fine" in pages
    assert not _rows(out / "queue.csv")
    page.open(out / "queue.html", 1000)
    assert page.ask("entries.length") == 0
