"""What stands in a report and what does not; equations in plain text among prose and displays."""

from __future__ import annotations

import pytest

from dynsolve.answers.reading.report_text import visible
from tests.unit.answers.reading.submissions import last, report, shown_last

HIDDEN = [
    ("\\begin{comment}\n\\[ K = m_2 \\]\n\\end{comment}\n", "report.tex"),
    ("\\iffalse\n\\[ K = m_2 \\]\n\\fi\n", "report.tex"),
    ("\\iffalse \\ifx\\a\\b \\[ K = m_2 \\] \\fi \\[ K = m_2 \\] \\fi\n", "report.tex"),
    ("\\iffalse\n\\[ K = m_2 \\]\n\\else\\fi\n", "report.tex"),
    ("% \\[ K = m_2 \\]\n", "report.tex"),
    ("a \\\\% \\[ K = m_2 \\]\n", "report.tex"),
    ("<!-- $$K = m_2$$ -->\n", "report.md"),
    ("<!--\n$$K = m_2$$\n-->\n", "report.md"),
    ("~~$$K = m_2$$~~\n", "report.md"),
    ("~~ $$K = m_2$$ ~~\n", "report.md"),
    ("<del>$$K = m_2$$</del>\n", "report.md"),
    ("<s>K = m2</s>\n", "report.html"),
    ("<del>$$K = m_2$$</del>\n", "report.html"),
    ("<!-- K = m2 -->\n", "report.html"),
]


@pytest.mark.parametrize(("hidden", "file"), HIDDEN)
def test_what_is_not_shown_is_not_read(hidden: str, file: str) -> None:
    shown = "\\[ K = m_1 \\]\n" if file != "report.html" else "<p>\\[ K = m_1 \\]</p>\n"
    for text in (shown + hidden, hidden + shown):
        assert [answer.read_as for answer in report(text, file).answers] == ["m₁"], text


def test_what_stands_after_the_end_of_the_document_is_not_read() -> None:
    text = "\\begin{document}\n\\[ K = m_1 \\]\n\\end{document}\n\\[ K = m_2 \\]\n"
    assert [answer.read_as for answer in report(text, "report.tex").answers] == ["m₁"]


@pytest.mark.parametrize(
    "text",
    [
        "$$K = m_1 ~~ g ~~ l_1$$",
        "$K = m_1 ~~ g$\n\n$P = m_1 ~~ g$",
        "\\[ K \\iff m_1 \\] 100 \\% of",
        "~~~\nK = m1\n~~~",
    ],
)
def test_what_is_shown_stays(text: str) -> None:
    assert visible(text, latex=True) == visible(text, latex=False) == text


def test_every_character_stays_at_its_place() -> None:
    for hidden, _ in HIDDEN:
        text = f"a\n{hidden}\nm<sub>c1</sub> q<sup>2</sup>"
        for latex in (True, False):
            assert len(visible(text, latex)) == len(text)
            assert visible(text, latex).count("\n") == text.count("\n")


LINES = [
    ("K = m1*g", "m₁ g"),
    ("- K = m1*g", "m₁ g"),
    ("* K = m1*g", "m₁ g"),
    ("1. K = m1*g", "m₁ g"),
    (">>> K = m1*g", "m₁ g"),
    ("K: m1*g", "m₁ g"),
    ("- K: m1*g", "m₁ g"),
    ("Kinetic energy: K = m1*g", "m₁ g"),
    ("The kinetic energy is K = m1*g", "m₁ g"),
    ("We get P1 = m2 and K = m1*g", "m₁ g"),
    ("We get K = m1*g and P1 = m2", "m₁ g"),
    ("**K** = m1*g", "m₁ g"),
    ("- **K:** m1*g", "m₁ g"),
    ("`K = m1*g`", "m₁ g"),
    ("K = m1*g  # all of it", "m₁ g"),
    ("K = m1*g;  % all of it", "m₁ g"),
    ("K = m1*g // all of it", "m₁ g"),
    ("K = m1 ...\n  * g", "m₁ g"),
    ("K = m1*g + ... first\n  m2", None),
    ("K =\n \nm1*g\n ", "m₁ g"),
    ("K =\n\n    m1*g\n\nP =\n\n   m2\n", "m₁ g"),
    ("K = m1\n  + g", "m₁ + g"),
    ("K = m1*g\n- P = m2", "m₁ g"),
    ("K = m1*g\n- P: m2", "m₁ g"),
    ("K = m<sub>1</sub> l<sub>c1</sub><sup>2</sup>", "m₁ l_c1²"),
    ("K = m₁ l_{c1}² ½", "m₁ l_c1²·½"),
]


@pytest.mark.parametrize(("line", "expected"), LINES)
def test_a_line_in_plain_text(line: str, expected: str | None) -> None:
    for text, file in (
        (f"{line}\n", "report.txt"),
        (f"# Task\n\n{line}\n\n$$f_7 = 0$$\n\n$$L = m_2$$\n", "report.md"),
        (f"$$L = m_2$$\n\nBy $K = 0$ one means nothing.\n\n{line}\n", "report.md"),
    ):
        found = [answer for answer in report(text, file).answers if answer.name == "K"]
        if expected is None:
            assert all(answer.fault for answer in found)
        else:
            assert [(answer.read_as, answer.fault) for answer in found][-1] == (expected, ""), text


def test_a_printed_matrix_has_its_rows() -> None:
    text = "D =\n \n[ m1, m2]\n[ m2, g]\n \ng =\n \nm1\n"
    assert shown_last(report(text, "report.txt"), "D") == shown_last(
        report("D = [[m1, m2], [m2, g]]", "report.txt"), "D"
    )


@pytest.mark.parametrize(
    "prose",
    [
        "K = the kinetic energy of both links",
        "P = potential energy",
        "K: the kinetic energy is the sum below",
        "D = inertia matrix, C = Coriolis matrix",
    ],
)
def test_a_sentence_beside_displays_spoils_nothing(prose: str) -> None:
    for text in (f"$$K = m_1$$ \n\n{prose}\n", f"{prose}\n\n$$K = m_1$$\n"):
        found = report(text)
        assert [(a.name, a.read_as, a.fault) for a in found.answers] == [("K", "m₁", "")]
        assert found.not_recognized


def test_a_line_in_plain_text_knows_its_place() -> None:
    place = last(report("$$P = m_1$$\n\n- K: m1*<sub>x</sub>gx # wrong\n", "report.txt"), "P").place
    assert place.line == 1
    place = last(report("- K: m1*gx # wrong\n", "report.txt"), "K").place
    assert (place.line, place.column, place.excerpt) == (1, 9, "- K: m1*gx # wrong")


def test_indices_and_powers_of_a_page() -> None:
    text = "<p>K = m<sub>1</sub> l<sub>c1</sub><sup>2</sup> sin<sup>2</sup>(q<sub>1</sub>)</p>"
    assert shown_last(report(text, "report.html"), "K") == "m₁ l_c1² sin²(q₁)"


def test_a_formula_without_a_name_is_listed() -> None:
    text = "Kinetic energy of link 1 = m1*g\nso that 2 = the number of links\nP = m1\n"
    found = report(text, "report.txt")
    assert [answer.name for answer in found.answers] == ["P"]
    assert [refused.text for refused in found.not_recognized] == ["Kinetic energy of link 1 = m1*g"]
