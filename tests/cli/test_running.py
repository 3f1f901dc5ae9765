"""The runs that start where all is imported are those of an interpreter of their own."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.cli.running import dynsolve, dynsolve_afresh

PENDULUM = "dh: [{theta: q1*, a: l1}]\nmasses: [{mass: m1, link: 1}]\n"


@pytest.mark.parametrize(
    ("words", "stdin"),
    [
        (("--version",), ""),
        (("solve", "--nothing"), ""),
        (("solve", "-", "--json"), PENDULUM),
        (("lint", "in3140-rp", "nowhere"), ""),
        (("check", "in3140-rp", "-"), "answers: {P: 0, g: [0, 0]}"),
    ],
)
def test_output_and_exit_code_are_those_of_an_own_interpreter(words: tuple[str, ...], stdin: str) -> None:
    assert dynsolve(*words, stdin=stdin) == dynsolve_afresh(*words, stdin=stdin)


def test_a_run_leaves_nothing_to_the_next(tmp_path: Path) -> None:
    (tmp_path / "arm.yaml").write_text(PENDULUM)
    plain = dynsolve("solve", "--help")
    narrow = dynsolve("solve", "--help", COLUMNS="50")
    assert plain.out != narrow.out and dynsolve("solve", "--help") == plain
    assert dynsolve("lint", "arm.yaml", cwd=tmp_path).code == 0
    assert dynsolve("lint", "arm.yaml").code == 2
    assert dynsolve("lint", "-", stdin=PENDULUM).code == 0
    assert dynsolve("lint", "-").code == 2


def test_what_python_reads_as_it_starts_needs_an_own_interpreter() -> None:
    with pytest.raises(AssertionError, match="dynsolve_afresh"):
        dynsolve("--version", PYTHONHASHSEED="1")
