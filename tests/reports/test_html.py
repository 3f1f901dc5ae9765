"""HTML reports in a real browser: everything has a size, nothing overflows, nothing is fetched."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from dynsolve.explain.step import Detail
from dynsolve.solution.reports import Format
from tests.reports.browser import Page, chromium
from tests.reports.tools import HOSTILE_PROBLEM, SEEN, made
from tests.support import ALL_PROBLEMS, LIBRARY

pytestmark = pytest.mark.browser

WIDTHS = (400, 1200)
DEPTHS = ("results", "brief", "normal", "full")
CONSTRAINTS = Path(__file__).parents[1] / "golden" / "constraints"

# Elements without width or height, those in hidden parts apart.
EMPTY = """
[...document.querySelectorAll('math, mtable, mtd, mfrac, mover, msub, msup, msubsup, munderover')]
  .filter(e => e.checkVisibility())
  .filter(e => { const r = e.getBoundingClientRect(); return !(r.width > 0.5 && r.height > 0.5) })
  .map(e => e.outerHTML.slice(0, 120))
"""

OVERFLOWING = """
[document.documentElement,
  ...document.querySelectorAll('body, main, p, .line, .box, .scroll, figure, nav, summary')]
  .filter(e => e.checkVisibility() && e.scrollWidth > e.clientWidth + 1 && e.clientWidth > 0)
  .filter(e => !e.closest('.box, .scroll')?.querySelector('mtable, td'))  // a matrix and a table are scrolled
  .map(e => [e.scrollWidth, e.clientWidth, e.className, e.textContent.slice(0, 80)])
"""


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Page]:
    with chromium(tmp_path_factory.mktemp("profile")) as opened:
        yield opened


def saved(problem: Path | str, folder: Path) -> Path:
    path = folder / "report.html"
    path.write_bytes(made(problem, Format.HTML))
    return path


ALIKE = {
    "panda-7r",
    "stanford-6",
    "puma560-first3",
    "spherical-rrp",
    "cartesian-pp",
    "cylindrical-rpp",
    "scara-rrpr",
    "crustcrawler-2r",
    "planar-2r-remote",
    "planar-2r-friction",
}
"""Pages of what those of puma560, rp-vertical, planar-2r and planar-2r-motors have, or of less.

pdflatex is asked of these too.
"""


@pytest.mark.parametrize(
    "problem", [path for path in LIBRARY if path.stem not in ALIKE], ids=lambda path: path.stem
)
def test_everything_is_seen_and_nothing_overflows(problem: Path, page: Page, tmp_path: Path) -> None:
    path = saved(problem, tmp_path)
    page.open(path, WIDTHS[0])
    assert page.ask("document.querySelectorAll('math').length") > 50
    for depth, width in (("normal", WIDTHS[0]), ("normal", WIDTHS[1]), ("full", WIDTHS[0])):
        page.ask(f"document.querySelector('label[for={depth}]').click()")
        page.resize(width)
        assert page.ask("innerWidth") == width
        assert page.ask(EMPTY) == []
        assert page.ask(OVERFLOWING) == []
        assert page.requests == [path.as_uri()]
        assert page.complaints == []


def test_a_long_fraction_is_broken_on_a_phone(page: Page, tmp_path: Path) -> None:
    page.open(saved(CONSTRAINTS / "sapienza-2013-01-line.yaml", tmp_path), 400)
    assert page.ask("document.querySelectorAll('#normal-eq-lambda .line math').length") > 2
    assert page.ask(OVERFLOWING) == []


LEANING = """
convention: modified
base: {rotate: Ry(beta)}
gravity: [0, 0, -g]
dh:
  - {theta: q1*}
  - {theta: q2*, a: l1}
  - {a: l2}
masses:
  - {mass: m1, link: 1, center: midpoint, inertia: {zz: I1}}
  - {mass: m2, link: 2, center: midpoint, inertia: {zz: I2}}
"""

# Boxes that are broken although the rest of their line would hold them in one.
TORN = """
[...document.querySelectorAll('.line .whole')].filter(e => e.checkVisibility()).filter(e => {
  const boxes = [e, ...e.querySelectorAll('.whole')], high = e.offsetHeight, line = e.closest('.line');
  const begins = e.getBoundingClientRect().left - line.getBoundingClientRect().left;
  boxes.forEach(box => Object.assign(box.style, {maxWidth: 'none', whiteSpace: 'nowrap'}));
  const [wide, least] = [e.offsetWidth, e.offsetHeight];
  boxes.forEach(box => box.removeAttribute('style'));
  return high > least + 8 && wide < line.clientWidth - Math.max(begins, 0)
}).map(e => e.textContent.slice(0, 80))"""

# Boxes whose later lines do not begin to the right of those of the box that they begin.
STEPPED_BACK = """
[...document.querySelectorAll('.whole > .whole:first-child')].filter(e => e.checkVisibility()).filter(e => {
  const at = box => box.getBoundingClientRect().left + parseFloat(getComputedStyle(box).paddingLeft);
  return at(e) <= at(e.parentElement) + 1
}).map(e => e.textContent.slice(0, 80))"""


@pytest.mark.parametrize("robot", ["elbow-3r", "planar-2r", LEANING], ids=["elbow", "planar", "leaning"])
def test_a_term_is_broken_only_where_no_line_holds_it(robot: str, page: Page, tmp_path: Path) -> None:
    library = [path for path in LIBRARY if path.stem == robot]
    page.open(saved(library[0] if library else robot, tmp_path), WIDTHS[0])
    assert page.ask("document.querySelectorAll('.whole').length") > 20
    for width in (*WIDTHS, 700, 1000):
        page.resize(width)
        assert page.ask("innerWidth") == width
        assert page.ask(TORN) == []
        assert page.ask(STEPPED_BACK) == []


def test_matrices_accents_and_fractions_are_set(page: Page, tmp_path: Path) -> None:
    page.open(saved(next(p for p in LIBRARY if p.stem == "in3140-rp"), tmp_path), 1200)
    # a matrix is as high as its rows, a dot stands over its letter, a fraction is higher than a digit
    heights = page.ask(
        "['A1 mtable', 'A1 mtr', 'K mfrac', 'K mn'].map("
        "s => document.querySelector(`#normal-eq-${s}`).getBoundingClientRect().height)"
    )
    table, row, fraction, digit = heights
    assert table > 3.5 * row > 0
    assert fraction > 1.6 * digit > 0
    letter, dot = page.ask(
        "[...document.querySelector('#normal-eq-K mover').children].map(e => e.getBoundingClientRect()).map("
        "r => ({top: r.top, left: r.left, right: r.right}))"
    )
    assert dot["top"] < letter["top"] + 3
    assert letter["left"] - 3 < (dot["left"] + dot["right"]) / 2 < letter["right"] + 3


def test_a_matrix_stays_one_on_a_phone_and_is_scrolled(page: Page, tmp_path: Path) -> None:
    page.open(saved(next(p for p in LIBRARY if p.stem == "elbow-3r"), tmp_path), 400)
    page.ask("document.querySelector('label[for=full]').click()")
    box = "document.querySelector('#full-eq-J .box')"
    assert page.ask(f"{box}.querySelectorAll('mtr').length") == 3
    assert page.ask(f"{box}.scrollWidth > {box}.clientWidth && getComputedStyle({box}).overflowX") == "auto"


def test_a_matrix_beside_others_stands_on_the_line_of_its_name(page: Page, tmp_path: Path) -> None:
    """z_1 = [...], o_1 = [...]: a line ends between them, and within one only where it holds no more."""
    page.open(saved(next(p for p in LIBRARY if p.stem == "stanford-6"), tmp_path), WIDTHS[0])
    assert page.ask("document.querySelectorAll('.part mtable').length") > 0
    parted = """
    [...document.querySelectorAll('.part')].filter(e => e.checkVisibility()).filter(e => {
      const pieces = [...e.querySelectorAll('math')].map(m => m.getBoundingClientRect());
      const middles = pieces.map(r => (r.top + r.bottom) / 2);
      const needed = pieces.reduce((sum, r) => sum + r.width, 0);
      return needed < e.parentElement.clientWidth - 40 && Math.max(...middles) - Math.min(...middles) > 20
    }).map(e => e.textContent.slice(0, 80))"""
    for width in (*WIDTHS, 900):
        page.resize(width)
        assert page.ask("innerWidth") == width
        assert page.ask(parted) == []
        assert page.ask(OVERFLOWING) == []


@pytest.mark.parametrize("letters", ["q", "theta"])
def test_dots_stand_over_the_middle_of_their_letter(letters: str, page: Page, tmp_path: Path) -> None:
    """A little to the right of the middle of its box: the letter is slanted."""
    problem = f"dh: [{{theta: {letters}1*, a: l1}}]\nmasses: [{{mass: m1, link: 1, shape: point}}]\n"
    page.open(saved(problem, tmp_path), 1200)
    off = page.ask(
        "[...document.querySelectorAll('mover')].filter(e => e.checkVisibility()).map(e => {"
        " const [letter, dot] = [...e.children].map(c => c.getBoundingClientRect());"
        " const ink = parseFloat(getComputedStyle(e.lastElementChild).paddingLeft);"
        " return ((dot.left + ink + dot.right) / 2 - (letter.left + letter.right) / 2) / letter.width })"
    )
    assert len(off) > 3
    assert all(-0.01 < share < 0.2 for share in off)


def test_light_and_dark_differ_and_can_be_read(page: Page, tmp_path: Path) -> None:
    path = saved(LIBRARY[0], tmp_path)
    looks = {}
    for scheme in ("light", "dark"):
        page.open(path, 1200, scheme)
        looks[scheme] = page.ask(
            "(s => [s.color, s.backgroundColor].map(c => c.match(/[\\d.]+/g).slice(0, 3).map(Number)))"
            "(getComputedStyle(document.body))"
        )
    brightness = {scheme: [sum(colour) / 3 for colour in both] for scheme, both in looks.items()}
    assert brightness["light"][1] - brightness["light"][0] > 150
    assert brightness["dark"][0] - brightness["dark"][1] > 150


def test_depths_and_folds_work_without_a_script(page: Page, tmp_path: Path) -> None:
    page.open(saved(next(p for p in LIBRARY if p.stem == "in3140-rp"), tmp_path), 1200)
    shown = "[...document.querySelectorAll('details.step')].filter(e => e.checkVisibility()).length"
    reasons = "[...document.querySelectorAll('.step .why')].filter(e => e.checkVisibility()).length"
    steps, said = [], []
    for depth in DEPTHS:
        page.ask(f"document.querySelector('label[for={depth}]').click()")
        seen = "[...document.querySelectorAll('h1')].filter(e => e.checkVisibility())"
        assert page.ask(f"{seen}.map(e => e.closest('article').className)") == [depth]
        steps.append(page.ask(shown))
        said.append(page.ask(reasons))
    assert 0 == steps[0] == steps[1] < steps[2] < steps[3]
    assert 0 == said[0] == said[1] < 10 < said[2] < said[3]
    for fold in (".full .step", ".full section:last-of-type > details"):
        closed = f"document.querySelector('{fold}')"
        page.ask(f"[...document.querySelectorAll('{fold}')].forEach(e => e.open = true)")
        page.ask(f"{closed}.firstElementChild.click()")
        assert page.ask(f"{closed}.open") is False
    assert page.ask("document.querySelectorAll('script').length") == 0


def test_the_list_of_notation_is_folded(page: Page, tmp_path: Path) -> None:
    page.open(saved(next(p for p in LIBRARY if p.stem == "in3140-rp"), tmp_path), 1200)
    page.ask("document.querySelector('label[for=full]').click()")
    folded = "document.querySelector('.full section:last-of-type > details:not([open])')"
    assert page.ask(f"{folded}.querySelector('summary').textContent.trim()") == "Notation"
    assert page.ask(f"{folded}.querySelector('table').checkVisibility()") is False
    assert page.ask(f"{folded}.querySelector('summary').click(), {folded} === null")
    assert page.ask("document.querySelector('.full section:last-of-type table').checkVisibility()")


@pytest.mark.parametrize("depth", list(Detail))
def test_the_page_opens_at_the_depth_that_was_asked_for(depth: Detail, page: Page, tmp_path: Path) -> None:
    path = tmp_path / "report.html"
    path.write_bytes(made(next(p for p in LIBRARY if p.stem == "in3140-rp"), Format.HTML, detail=depth))
    page.open(path, 1200)
    assert page.ask("document.querySelector(':checked').id") == depth.name.lower()


SEEN_NUMBERS = """
[...document.querySelectorAll('.n')].filter(e => e.checkVisibility()).map(e => e.textContent)
"""
SEEN_REFERENCES = """
[...document.querySelectorAll('article a:not(nav a)')].filter(e => e.checkVisibility()).map(e => {
  const target = document.querySelector(e.getAttribute('href'));
  const beside = [...target.querySelectorAll('.n')].filter(n => n.checkVisibility());
  return [e.textContent, beside.map(n => n.textContent).join()] })
"""


@pytest.mark.parametrize("name", ["planar-2r", "elbow-3r"])
def test_at_each_depth_numbers_have_no_gaps_and_references_are_to_what_is_seen(
    name: str, page: Page, tmp_path: Path
) -> None:
    page.open(saved(next(p for p in ALL_PROBLEMS if p.stem == name), tmp_path), 1200)
    counts, referred = [], []
    for depth in DEPTHS:
        page.ask(f"document.querySelector('label[for={depth}]').click()")
        numbers = page.ask(SEEN_NUMBERS)
        assert numbers == [f"({k})" for k in range(1, len(numbers) + 1)]
        counts.append(len(numbers))
        references = page.ask(SEEN_REFERENCES)
        assert [said for said, beside in references if said != beside] == []
        referred.append(len(references))
    assert 0 == counts[0] < counts[1] < counts[2] < counts[3] and counts[2] > 5
    assert 0 == referred[0] == referred[1] < referred[2] and referred[3] > 10


def test_every_link_leads_somewhere_on_the_page(page: Page, tmp_path: Path) -> None:
    page.open(saved(next(p for p in LIBRARY if p.stem == "elbow-3r"), tmp_path), 1200)
    lost = "[...document.querySelectorAll('a')].filter(a => !document.querySelector(a.getAttribute('href')))"
    assert page.ask("document.querySelectorAll('nav a').length") > 20
    assert page.ask(f"{lost}.map(a => a.outerHTML)") == []
    ids = "[...document.querySelectorAll('[id]')].map(e => e.id)"
    assert page.ask(f"{ids}.length - new Set({ids}).size") == 0


def test_printed_pages_show_every_step(page: Page, tmp_path: Path) -> None:
    page.open(saved(LIBRARY[0], tmp_path), 1200)
    page.ask("document.querySelectorAll('details.step').forEach(e => e.open = false)")
    page.call("Emulation.setEmulatedMedia", media="print", features=[])
    assert (
        page.ask("[...document.querySelectorAll('nav, label')].filter(e => e.checkVisibility()).length") == 0
    )
    assert page.ask("document.querySelector('details.step math').getBoundingClientRect().height") > 5
    assert len(page.call("Page.printToPDF")["data"]) > 10_000


def test_a_hostile_title_is_text(page: Page, tmp_path: Path) -> None:
    page.open(saved(HOSTILE_PROBLEM, tmp_path), 400)
    title = page.ask("document.querySelector('h1').textContent")
    for part in SEEN:
        assert part in title
        assert part in page.ask("document.title")
    assert page.ask("document.querySelectorAll('script, img').length") == 0
    assert not set("\u202e\u202c\u200f") & set(page.ask("document.documentElement.outerHTML"))
    assert "<img src=x" in page.ask("document.body.textContent")
    assert len(page.requests) == 1
    assert page.ask(OVERFLOWING) == []


def test_the_title_is_above_the_contents_and_these_above_the_sections(page: Page, tmp_path: Path) -> None:
    page.open(saved(next(p for p in LIBRARY if p.stem == "in3140-rp"), tmp_path), 1000)
    tops = page.ask(
        "['h1', 'figure', 'nav', 'section'].map(s => document.querySelector(`.normal ${s}`).offsetTop)"
    )
    assert tops == sorted(tops)
    assert len(set(tops)) == 4


def test_parentheses_fractions_in_matrices_and_squares_are_readable(page: Page, tmp_path: Path) -> None:
    page.open(saved(next(p for p in LIBRARY if p.stem == "box-cylinder-rod-sphere"), tmp_path), 1000)
    outer = '[minsize="1.35em"]'
    low, around, *tall = page.ask(
        f"['[stretchy=false]', '{outer}', '[minsize]:not({outer})']"
        ".map(kind => [...document.querySelectorAll('.line mo' + kind)].filter(e => e.checkVisibility()))"
        ".flatMap((found, k) => k < 2 ? found.slice(0, 1) : found).map(e => e.getBoundingClientRect().height)"
    )
    assert len(tall) > 10
    assert min(tall) > 1.7 * low
    assert around > 1.3 * low, "around others"
    sizes = page.ask(
        "[...document.querySelectorAll('mtd > mfrac mi')].filter(e => !e.closest('msub, msup, msubsup'))"
        ".map(e => [parseFloat(getComputedStyle(e).fontSize),"
        " parseFloat(getComputedStyle(e.closest('mtd')).fontSize)])"
    )
    assert sizes
    assert all(inner == outer for inner, outer in sizes)
    leaning = page.ask(
        "[...document.querySelectorAll('.slanted')].filter(e => e.checkVisibility())"
        ".map(e => parseFloat(getComputedStyle(e).paddingRight))"
    )
    assert leaning
    assert min(leaning) > 1
