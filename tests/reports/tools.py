"""The programs that look at reports: pdflatex, pdftotext, Chromium.

CI installs them, and there a test without its program fails; elsewhere it is skipped, and says so.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import pytest

from dynsolve.explain.step import Detail
from dynsolve.solution.reports import Format, report
from tests.support import solved

HOSTILE = (
    r"50% of a_1 & b #2 $x^2$ ~ <script>document.title='taken'</script> \input{/etc/passwd} {x} "
    "\u202egnirts\u202c \u200fend-- `q` |r| [s](t) *u* \"v\" 'w' ?!`y"
)
"""A title that every notation would take for its own, were it not text."""

SEEN = ("50% of a_1 & b #2 $x^2$", "<script>", r"\input{/etc/passwd} {x}", "gnirts", "[s](t)")
"""What a reader must see of it."""

HOSTILE_PROBLEM = f"""
title: {json.dumps(HOSTILE)}
source: "100% <img src=x onerror=alert(1)> \\\\end{{document}} \\u05d0\\u4e2d"
dh:
  - {{theta: theta1*, d: 0, a: l1, alpha: 0}}
masses:
  - {{mass: m1, link: 1, shape: point, center: tip}}
"""


def needed(tool: str) -> str:
    """The path of a program."""
    found = shutil.which(tool)
    if found is None:
        if os.environ.get("CI"):
            pytest.fail(f"{tool} is not installed, and CI must have it")
        pytest.skip(f"{tool} is not installed: apt-get install texlive-latex-extra chromium poppler-utils")
    return found


@cache
def made(
    problem: Path | str,
    format: Format,
    star: bool = False,
    fragment: bool = False,
    detail: Detail = Detail.NORMAL,
) -> bytes:
    """A report; `problem` is a path, or the text of a problem file."""
    return report(solved(problem), format, star=star, fragment=fragment, detail=detail)


CHANGED = ("Label(s) may have changed",)
OPEN = ("Reference `", "There were undefined references")


@dataclass(frozen=True)
class Typeset:
    """What pdflatex made of a source."""

    code: int
    log: str
    pdf: Path
    settled: bool = True
    """Whether a further run would find the references where they are."""
    waiting: tuple[str, ...] = CHANGED
    """Warnings of what a further run settles."""

    @property
    def pages(self) -> int:
        """How many pages there are."""
        found = re.search(r"Output written on .*? \((\d+) pages?", self.log, re.DOTALL)
        return int(found[1]) if found else 0

    @property
    def complaints(self) -> list[str]:
        """Errors and warnings of substance."""
        marks = ("!", "Overfull", "LaTeX Warning", "Package amsmath Warning", "Missing character", "Runaway")
        found = [line for line in self.log.splitlines() if line.startswith(marks)]
        return [line for line in found if not any(waiting in line for waiting in self.waiting)]


def typeset(source: str, folder: Path, once: bool = False) -> Typeset:
    """Run pdflatex twice, as references need; or `once`, where each reference is to a label that is there."""
    program = needed("pdflatex")
    (folder / "report.tex").write_text(source, encoding="utf-8")
    options = ["-interaction=nonstopmode", "-halt-on-error", "-no-shell-escape"]
    command = [program, *options, *(() if once else ("-draftmode",)), "report.tex"]
    done = subprocess.run(command, cwd=folder, capture_output=True, check=False)
    first = _references(folder, source) if done.returncode == 0 else {}
    if done.returncode == 0 and not once:
        done = subprocess.run([program, *options, "report.tex"], cwd=folder, capture_output=True, check=False)
    log = (folder / "report.log").read_text(encoding="utf-8", errors="replace")
    if once:
        _, _, text = source.partition("\\begin{document}")
        referred = re.findall(r"\\(?:eqref|contentsrow\{.*\})\{(.*?)\}", text)
        settled = bool(first) and set(referred) <= first.keys()
        return Typeset(done.returncode, log, folder / "report.pdf", settled, (*CHANGED, *OPEN))
    settled = done.returncode == 0 and _references(folder, source) == first
    return Typeset(done.returncode, log, folder / "report.pdf", settled)


def _references(folder: Path, source: str) -> dict[str, tuple[str, str]]:
    """What a run found for the next to print: the number of each label, and the pages of the contents."""
    found = re.findall(
        r"\\newlabel\{(.*?)\}\{\{(.*?)\}\{(.*?)\}\}", (folder / "report.aux").read_text(encoding="utf-8")
    )
    paged = set(re.findall(r"\\contentsrow\{.*\}\{(.*?)\}", source))
    return {label: (number, page if label in paged else "") for label, number, page in found}


def text_of(pdf: Path) -> str:
    """What a PDF says, its white space evened."""
    done = subprocess.run([needed("pdftotext"), str(pdf), "-"], capture_output=True, check=True)
    return re.sub(r"\s+", " ", done.stdout.decode())


def lines_of(pdf: Path) -> list[list[str]]:
    """The lines of each page, as they are laid out."""
    done = subprocess.run([needed("pdftotext"), "-layout", str(pdf), "-"], capture_output=True, check=True)
    pages = done.stdout.decode().split("\f")[:-1]
    return [[line for line in page.splitlines() if line.strip()] for page in pages]


def words_of(pdf: Path) -> list[tuple[str, float]]:
    """Every word of a PDF in the order of the page, and how far from the top of its page it stands."""
    done = subprocess.run([needed("pdftotext"), "-bbox", str(pdf), "-"], capture_output=True, check=True)
    found = re.findall(r'<word [^>]*yMin="([\d.]+)"[^>]*>([^<]*)</word>', done.stdout.decode())
    return [(word, float(top)) for top, word in found]


FEWEST_LINES = 8
"""A page with fewer, the one above it with its title and number among them, is nearly empty."""
