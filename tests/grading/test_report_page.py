"""The teacher's page in a real browser: nothing is fetched, and a click on a header sorts."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest

from tests.cli.running import dynsolve
from tests.grading.generate import course, problem_set

BROWSER = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")

_CLICK = """<script>
const table = [...document.querySelectorAll("h2")].find(h => h.textContent === "Students")
  .nextElementSibling.querySelector("table");
const button = [...table.querySelectorAll("th button")].find(b => b.textContent === "total");
button.click();
document.title = [...table.tBodies[0].rows].map(r => r.cells[r.cells.length - 1].textContent).join(" ");
</script></body>"""


def _page(tmp_path: Path) -> str:
    problem_set(tmp_path / "set")
    course(tmp_path / "in", 9)
    words = (str(tmp_path / "set"), str(tmp_path / "in"), "-o", str(tmp_path / "out"))
    assert dynsolve("grade", *words).code == 0
    return (tmp_path / "out" / "report.html").read_text()


@pytest.mark.skipif(BROWSER is None, reason="there is no browser here")
def test_a_click_sorts_by_number(tmp_path: Path) -> None:
    assert BROWSER is not None
    page = _page(tmp_path)
    assert not re.search(r"(src|href)=\"(?!data:)", page)
    clicked = tmp_path / "clicked.html"
    clicked.write_text(page.replace("</body>", _CLICK))
    shown = subprocess.run(
        [
            BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=2000",
            f"--user-data-dir={tmp_path / 'profile'}", "--dump-dom", clicked.as_uri(),
        ],
        capture_output=True, text=True, timeout=60, check=True,
    ).stdout  # fmt: skip
    found = re.search(r"<title>([^<]*)</title>", shown)
    assert found is not None
    totals = [float(cell) for cell in found[1].split()]
    assert len(totals) == 9
    assert totals == sorted(totals)
