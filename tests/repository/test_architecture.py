"""What dynsolve/README.md works out is what the program computes: a formula made compact, a line judged."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import dynsolve
from dynsolve.answers.reading.lexer import tokenize
from dynsolve.answers.reading.prepare import prepared
from dynsolve.notation import tree
from dynsolve.notation.unicode import to_unicode

PAGE = (Path(dynsolve.__file__).parent / "README.md").read_text(encoding="utf-8")
LINE = next(line.strip().strip("$") for line in PAGE.splitlines() if line.startswith(r"    $$d_{22}"))


@pytest.mark.parametrize("place", [(0, 0), (1, 1)])
def test_the_compact_form_that_is_worked_out_is_printed(place: tuple[int, int]) -> None:
    solution = dynsolve.solve("elbow-3r")
    D = solution.forms("D")
    assert isinstance(D, tree.Matrix)
    assert f"    {to_unicode(D.rows[place[0]][place[1]], solution.style)}\n" in PAGE


def test_the_normal_form_has_as_many_terms_as_it_says() -> None:
    found = re.search(r"d₂₂ has (\d+) terms", PAGE)
    assert found
    assert len(dynsolve.solve("elbow-3r").values["D"][1, 1].poly) == int(found[1])


@pytest.mark.parametrize(("file", "cut"), [("lexer", tokenize), ("prepare", prepared)])
def test_the_tokens_of_the_line_are_those_that_are_shown(file: str, cut: object) -> None:
    row = next(line for line in PAGE.splitlines() if line.startswith(f"| `answers/reading/{file}.py`"))
    shown = [token.lstrip("\\") for token in re.findall("`([^`]*)`", row)[1:]]
    assert callable(cut)
    assert [token.text for token in cut(LINE) if token.text] == shown


def test_the_line_is_judged_as_it_says(tmp_path: Path) -> None:
    hand_in = tmp_path / "report.md"
    hand_in.write_text(f"$${LINE}$$\n", encoding="utf-8")
    (answer,) = (a for a in dynsolve.check("planar-2r", hand_in).answers if a.name == "d22")
    assert answer.verdict == "wrong"
    assert [d.message for d in answer.diagnosis if "½ in front where 1 belongs" in d.message]
    assert "m₂ l_c2² has ½ in front where 1 belongs" in PAGE
