"""What a user gets who made a mistake, and the exit codes."""

from __future__ import annotations

import fcntl
import signal
import subprocess
import sys
import termios
import time
from pathlib import Path
from typing import IO

import pytest

from tests.cli.running import dynsolve, environment, started
from tests.support import ROOT

FAULTY = """\
title: faulty
dh:
  - {theta: theta1* + 90, d: L1}
mases:
  - {mass: m1, link: 1}
"""

STILL_FRAME = """\
dh: [{theta: q1*, d: L, alpha: 90deg}, {theta: q2*, a: l2}]
masses:
  - {mass: m1, link: 2, center: tip, inertia: {xx: Ix, zz: Iz}, axes: {base: Rz(0)}}
"""

HARMLESS = """\
dh: [{theta: q1*, d: L}]
masses:
  - {mass: m1, link: 1, center: tip, inertia: {xx: Ix, zz: Iz}, axes: {base: Rz(0)}}
"""


def test_all_errors_of_a_file_at_once_each_with_place_caret_and_help(tmp_path: Path) -> None:
    file = tmp_path / "faulty.yaml"
    file.write_text(FAULTY)
    ran = dynsolve("solve", str(file))
    assert ran.code == 2 and not ran.out
    assert ran.err == (
        f"{file}:3:23: the bare number 90 stands as an angle\n"
        "    - {theta: theta1* + 90, d: L1}\n"
        "                        ^^\n"
        "help: did you mean 90deg? Angles are written in degrees (90deg) or with pi (pi/2)\n"
        f"{file}:4:1: unknown key `mases` in a problem file\n"
        "  mases:\n"
        "  ^^^^^\n"
        "help: did you mean `masses`?\n"
    )


def test_standard_input_has_a_name_in_errors() -> None:
    ran = dynsolve("solve", "-", stdin=FAULTY)
    assert ran.code == 2 and ran.err.startswith("<stdin>:3:23: ")


def test_a_file_that_is_not_there(tmp_path: Path) -> None:
    ran = dynsolve("solve", str(tmp_path / "none.yaml"))
    assert ran.code == 2 and "cannot be read" in ran.err and "Traceback" not in ran.err


def test_a_stem_that_is_almost_one() -> None:
    ran = dynsolve("solve", "planar2r")
    assert ran.code == 2 and "did you mean `planar-2r" in ran.err


def test_of_several_problems_the_good_ones_are_solved(tmp_path: Path) -> None:
    file = tmp_path / "faulty.yaml"
    file.write_text(FAULTY)
    ran = dynsolve("solve", str(file), "planar-2r", "--json")
    assert ran.code == 2 and ran.out.count("\n") == 1 and "bare number" in ran.err


def test_a_given_frame_that_gives_a_wrong_energy_is_an_error_at_its_place() -> None:
    ran = dynsolve("solve", "-", stdin=STILL_FRAME)
    assert ran.code == 2
    assert ran.err.startswith("<stdin>:3:") and "does not turn with link 2" in ran.err and "help: " in ran.err


def test_a_given_frame_that_does_no_harm_is_a_warning() -> None:
    ran = dynsolve("solve", "-", "--detail", "brief", stdin=HARMLESS)
    assert ran.code == 0 and "warning: the given rotation of body 1 does not turn" in ran.err
    assert not dynsolve("solve", "-", "--quiet", "--detail", "brief", stdin=HARMLESS).err
    linted = dynsolve("lint", "-", stdin=HARMLESS)
    assert linted.code == 1 and "warning: the given rotation" in linted.out


def test_lint_ends_with_two_for_a_faulty_file() -> None:
    ran = dynsolve("lint", "-", stdin=FAULTY)
    assert ran.code == 2 and "<stdin>:4:1" in ran.err


@pytest.mark.parametrize(
    "words",
    [
        ["solve"],
        ["solve", "planar-2r", "--detail", "much"],
        ["solve", "planar-2r", "--stage", "nothing"],
        ["solve", "planar-2r", "--stage", "torque", "--from", "energy"],
        ["solve", "planar-2r", "--from", "torque", "--to", "energy"],
        ["nothing"],
        ["solve", "--nothing"],
        [],
    ],
    ids=" ".join,
)
def test_usage_errors(words: list[str]) -> None:
    ran = dynsolve(*words)
    assert ran.code == 2
    assert "Traceback" not in ran.err and "Usage: dynsolve" in ran.err + ran.out


def failing(kind: str, *words: str) -> subprocess.CompletedProcess[str]:
    """The program with a solver that raises."""
    code = (
        "import sys, dynsolve.solution.solution as s, dynsolve.errors as e\n"
        "def fail(*a, **k): raise " + kind + "\n"
        "s.solve = fail\n"
        "from dynsolve.cli.main import main; main(sys.argv[1:])\n"
    )
    return subprocess.run(
        [sys.executable, "-c", code, "solve", "planar-2r", *words],
        capture_output=True, text=True, cwd=ROOT, env=environment(), check=False,
    )  # fmt: skip


def test_a_choice_that_is_none_is_told_in_plain_words() -> None:
    ran = dynsolve("solve", "in3140-rp", "--stage", "torqe")
    assert ran.code == 2
    assert "Invalid value for '--stage': 'torqe' is not one of 'frames', 'kinematics'" in ran.err
    assert ran.err.rstrip().endswith("did you mean `torque`?")


def test_a_failed_verification_ends_with_three() -> None:
    done = failing("e.VerificationError('tau differs')")
    assert done.returncode == 3 and done.stderr == "error: tau differs\n"


def test_what_nobody_expected_is_one_line_and_with_traceback_more() -> None:
    done = failing("RuntimeError('out of\\nluck')")
    assert done.returncode == 3
    assert (
        done.stderr == "internal error: RuntimeError: out of luck (run again with --traceback to see where)\n"
    )
    done = failing("RuntimeError('out of luck')", "--traceback")
    assert done.returncode != 0 and "Traceback (most recent call last)" in done.stderr


def test_an_interruption_ends_with_130() -> None:
    done = failing("KeyboardInterrupt")
    assert done.returncode == 130 and done.stderr == "interrupted\n"


def _unread(pipe: IO[bytes]) -> int:
    """How many bytes of a pipe its reader has not taken yet."""
    return int.from_bytes(fcntl.ioctl(pipe, termios.FIONREAD, bytes(4)), sys.byteorder)


@pytest.mark.skipif(sys.platform != "linux", reason="asks a pipe as Linux lets one ask")
def test_ctrl_c_while_it_waits_for_input() -> None:
    with started("solve", "-") as process:
        assert process.stdin is not None
        process.stdin.write(b"title: unfinished\n")
        process.stdin.flush()
        deadline = time.monotonic() + 60
        while _unread(process.stdin):  # it starts; then it waits for the rest
            assert time.monotonic() < deadline
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=60)
    assert process.returncode == 130 and err == b"interrupted\n"
