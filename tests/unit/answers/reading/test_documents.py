"""Documents of word processors and of other markup: what pandoc writes and reads again."""

from __future__ import annotations

import subprocess
from functools import cache
from itertools import product

import pytest

from dynsolve.answers.reading import files
from dynsolve.answers.reading.files import FORMATS, as_report, pandoc, read_submission
from dynsolve.answers.verdict import Submission
from dynsolve.errors import ReadError
from dynsolve.explain.context import style_of
from dynsolve.notation.markup import to_latex
from tests.unit.answers.hands import checker, problem
from tests.unit.answers.reading.test_yaml_libraries import trees

needs_pandoc = pytest.mark.skipif(pandoc() is None, reason="the extra `office` is not installed")


@cache
def document(text: str, ending: str) -> bytes:
    program = pandoc()
    assert program is not None
    arguments = [program, "-f", "markdown", "-t", FORMATS[ending], "-o", "-"]
    return subprocess.run(arguments, input=text.encode(), capture_output=True, check=True).stdout


def read(text: str, ending: str, stem: str = "planar-2r") -> Submission:
    return read_submission(problem(stem), document(text, ending), f"hand-in{ending}")


@needs_pandoc
@pytest.mark.parametrize(
    ("stem", "ending"), [*product(["planar-2r"], FORMATS), ("in3140-rp", ".docx"), ("numeric-2r", ".docx")]
)
def test_right_answers_are_right_and_wrong_ones_wrong(stem: str, ending: str) -> None:
    style = style_of(problem(stem).robot)
    for slip, wanted in (("", "correct"), (" + 7", "wrong")):
        text = "# The robot\n\n" + "\n\n".join(
            f"Here is one more.\n\n$${name} = {to_latex(tree, style)}{slip if name == 'K' else ''}$$"
            for name, tree in trees(stem).items()
        )
        report = checker(stem)(checker(stem).reader(document(text, ending), f"hand-in{ending}"))
        found = {answer.name: str(answer.verdict) for answer in report.answers if answer.given}
        assert found["K"] == wanted
        assert {name for name in found if found[name] != "correct"} == ({"K"} if slip else set())
        assert found.keys() >= trees(stem).keys() - {"C"} | {"Cqd"}


@needs_pandoc
@pytest.mark.parametrize("ending", FORMATS)
def test_all_that_a_document_holds(ending: str) -> None:
    text = (
        "# Task\n\nThe energy is\n\n$$K_1 = h m_1 \\dot q_1^2$$\n\nwith $h = \\frac{1}{2}l_{c1}^2$.\n\n"
        "- $P_1 = m_1 g$\n- second\n\n| a | b |\n|---|---|\n| $P_2 = m_2 g$ | c |\n\nP = m~1~ l~c1~^2^ g\n"
    )
    found = {answer.name: (answer.read_as, answer.fault) for answer in read(text, ending).answers}
    assert found["K1"][1] == ""
    assert found["P"] == ("m₁ l_c1² g", "")
    assert found["P1"] == ("m₁ g", "")
    assert found["P2"] == ("m₂ g", "")


@needs_pandoc
def test_what_is_struck_through_is_not_read() -> None:
    found = read("$$K = m_1$$\n\n~~P = m2~~\n", ".docx")
    assert [answer.name for answer in found.answers] == ["K"]


@needs_pandoc
@pytest.mark.parametrize("ending", FORMATS)
@pytest.mark.parametrize("content", [b"", b"PK\x03\x04", b"\0" * 1000, b"[" * 100_000, b"$" * 10_001])
def test_what_is_no_document_is_a_fault_or_nothing(content: bytes, ending: str) -> None:
    assert read_submission(problem("planar-2r"), content, f"x{ending}").answers == ()


@needs_pandoc
def test_a_file_cannot_reach_for_others() -> None:
    text = b".. include:: /etc/hostname\n\n.. math:: K = m_1\n"
    found = read_submission(problem("planar-2r"), text, "x.rst")
    assert [answer.name for answer in found.answers] == ["K"]
    assert as_report(text, ".rst")[0].strip() == "$$K = m_1$$"


@needs_pandoc
def test_an_archive_that_unpacks_to_too_much_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(files, "_MAX_UNPACKED", 1000)
    with pytest.raises(ReadError, match="too large"):
        as_report(document("$$K = m_1$$", ".odt"), ".odt")


def test_without_the_extra_the_file_says_what_reads_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(files, "pandoc", lambda: None)
    (fault,) = read_submission(problem("planar-2r"), b"PK", "x.docx").faults
    assert "pandoc" in fault.message
    assert "dynsolve[office]" in fault.help
