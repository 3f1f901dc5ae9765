"""Hand-ins a second, and memory: `python -m tests.benchmarks.grading [COUNT]` (2,000 unless given).

A third each of three robots, ten answers, half of them in LaTeX, three in ten with a
slip.  Nothing here asserts anything: the numbers depend on the machine.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from tests.grading.generate import course, problem_set
from tests.support import ROOT


def main(count: int) -> None:
    """Grade a generated course, and print what it took."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        problem_set(folder / "set")
        course(folder / "in", count)
        words = ["grade", str(folder / "set"), str(folder / "in"), "-o", str(folder / "out"), "--quiet"]
        command = [sys.executable, "-m", "dynsolve", *words]
        for what in ("from nothing", "again, nothing changed"):
            start = time.monotonic()
            process = subprocess.Popen(command, cwd=ROOT)
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            seconds = time.monotonic() - start
            used = usage.ru_utime + usage.ru_stime
            rate, peak = count / used, usage.ru_maxrss / 1024
            print(f"{what}: {count} hand-ins in {seconds:.1f} s, {used:.1f} s of processor")
            print(f"  {rate:.0f} a second a core; peak {peak:.0f} MiB a process; exit {process.returncode}")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 2000)
