"""Notebooks: the equations of their Markdown cells."""

from __future__ import annotations

import json

from tests.unit.answers.reading.submissions import named, report


def test_a_notebook_is_read_by_its_markdown_cells() -> None:
    cells = [
        {"cell_type": "markdown", "source": ["# Title\n", "$$K = m_1$$\n", "text"]},
        {"cell_type": "code", "source": ["K = 3"], "outputs": []},
        {"cell_type": "markdown", "source": "\\begin{equation}\nP = m_2 g\n\\end{equation}"},
    ]
    text = json.dumps({"cells": cells, "nbformat": 4}, indent=1)
    found = report(text, "report.ipynb")
    assert named(found) == [("K", ""), ("P", "")]
    place = found.answers[0].place
    assert "$$K = m_1$$" in text.splitlines()[place.line - 1]
