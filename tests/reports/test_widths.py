"""The widths that lines are broken by, against those that TeX finds."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from dynsolve.notation.extent import Ruler
from dynsolve.notation.markup import LatexPrinter
from dynsolve.render.line_breaking import formulas
from tests.reports.tools import typeset
from tests.support import document, solved

pytestmark = pytest.mark.latex

EM = 10.95
LONGEST = 300  # what TeX can still measure as one box


@pytest.mark.parametrize(
    "name", ["in3140-rp", "elbow-3r", "numeric-2r", "planar-2r-remote", "puma560-first3"]
)
def test_nothing_is_wider_than_it_is_thought_to_be(name: str, tmp_path: Path) -> None:
    style = solved(name).style
    nodes = [formula.node for formula in formulas(document(name).blocks)]
    ruler, printer = Ruler(style), LatexPrinter(style)
    nodes = [node for node in nodes if ruler.width(node) < LONGEST]
    boxes = "\n".join(
        f"\\setbox0\\hbox{{$\\displaystyle {printer.text(node)}$}}\\typeout{{WIDTH \\the\\wd0}}"
        for node in nodes
    )
    source = (
        "\\documentclass[11pt]{article}\\usepackage{amsmath}\\begin{document}\n"
        f"{boxes}\nmeasured\n\\end{{document}}\n"
    )
    log = typeset(source, tmp_path).log
    found = [float(width) / EM for width in re.findall(r"^WIDTH ([\d.]+)pt$", log, re.MULTILINE)]
    assert len(found) == len(nodes) > 30
    thought = [ruler.width(node) for node in nodes]
    too_narrow = [
        (round(is_, 2), round(was, 2), printer.text(node)[:120])
        for node, is_, was in zip(nodes, found, thought, strict=True)
        if is_ > was + 0.05
    ]
    assert too_narrow == []
    assert sum(thought) < 1.25 * sum(found), "and not thought to be much wider either"
