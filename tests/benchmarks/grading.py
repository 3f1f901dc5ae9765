"""Hand-ins a second, and memory: `python -m tests.benchmarks.grading [COUNT]` (2,000 unless given).

A third each of three robots, ten answers, half of them in LaTeX, three in ten with a
slip: once as the key is printed, as a cohort that copies would hand in, and once with
the terms and factors of every answer in an order of its own.  A rate is after the
first: what the processes need until they have judged one hand-in of each problem is
taken off.  Beside it stands what SymPy needs for the same: reading an answer with
`parse_expr` and asking `simplify(answer - key) == 0`.  Nothing here asserts anything:
the numbers depend on the machine.
"""

from __future__ import annotations

import os
import random
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

import sympy
from sympy.parsing.sympy_parser import parse_expr

from tests.grading.generate import PROBLEMS, course, key, problem_set, reordered
from tests.support import ROOT


@dataclass(frozen=True)
class Used:
    """What a run used: seconds by the clock, of the processor, and the peak memory of a process in MiB."""

    clock: float
    processor: float
    mebibytes: float


def graded(problems: Path, hand_ins: Path, out: Path) -> Used:
    """Grade a folder."""
    words = ["grade", str(problems), str(hand_ins), "-o", str(out), "--quiet"]
    start = time.monotonic()
    process = subprocess.Popen([sys.executable, "-m", "dynsolve", *words], cwd=ROOT)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        raise SystemExit(f"dynsolve {' '.join(words)} ended with {process.returncode}")
    clock = time.monotonic() - start
    return Used(clock, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024)


def by_sympy() -> float:
    """Seconds of the processor that SymPy needs for the ten answers of one hand-in to each problem."""
    chance = random.Random(1)
    start = time.process_time()
    for problem in PROBLEMS:
        for value in key(problem).values():
            rows = value if isinstance(value, list) else [value]
            for text in [entry for row in rows for entry in (row if isinstance(row, list) else [row])]:
                answer, expected = reordered(text, chance), text
                assert sympy.simplify(_read(answer) - _read(expected)) == 0
    return time.process_time() - start


def _read(text: str) -> sympy.Expr:
    return parse_expr(text, local_dict={"g": sympy.Symbol("g")})


def main(count: int) -> None:
    """Grade generated courses, and print what it took."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        problem_set(folder / "set")
        course(folder / "first", len(PROBLEMS))
        first = graded(folder / "set", folder / "first", folder / "out-first").processor
        for what, own_order in (("as the key is printed", False), ("in an order of their own", True)):
            hand_ins, out = folder / f"in-{own_order}", folder / f"out-{own_order}"
            course(hand_ins, count, own_order=own_order)
            for how, before in (("from nothing", first), ("again, nothing changed", 0.0)):
                used = graded(folder / "set", hand_ins, out)
                rate = count / (used.processor - before)
                print(f"{count} hand-ins {what}, {how}: {used.clock:.1f} s", end="")
                print(f", {rate:.0f} a second a core, peak {used.mebibytes:.0f} MiB a process")
                if before:
                    each = (used.processor - before) / count
        print(f"SymPy: {by_sympy() / len(PROBLEMS) / each:.0f} times as long a hand-in")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 2000)
