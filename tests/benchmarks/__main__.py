"""Time, memory and length of what dynsolve prints: `python -m tests.benchmarks`.

Time is user + system seconds of a whole process, as a ratio to
`python -c "import sympy"` in the same environment, the best of several runs.
Nothing here asserts anything: the numbers depend on the machine.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from dataclasses import dataclass

from tests.counting import operations
from tests.support import ROOT

RUNS = 3
DYNSOLVE = [sys.executable, "-m", "dynsolve"]


@dataclass(frozen=True)
class Cost:
    """What a process used: user + system seconds, and its peak memory in MiB."""

    seconds: float
    mebibytes: float


def cost(command: list[str], runs: int = RUNS) -> Cost:
    """The least that any of `runs` runs of a command used."""
    costs = []
    for _ in range(runs):
        process = subprocess.Popen(command, cwd=ROOT, stdout=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode:
            raise SystemExit(f"{' '.join(command)} ended with {process.returncode}")
        costs.append(Cost(usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024))
    return min(costs, key=lambda cost: cost.seconds)


def problem(name: str) -> str:
    """The path of a library problem."""
    return str(ROOT / "problems" / f"{name}.yaml")


def times() -> None:
    """The ratios, each beside what it should not pass."""
    sympy = cost([sys.executable, "-c", "import sympy"], runs=2 * RUNS)
    print(f"python -c 'import sympy': {sympy.seconds:.2f} s")
    cases = [
        ("--help", ["--help"], 0.3),
        ("lint in3140-rp", ["lint", problem("in3140-rp")], 0.5),
        ("solve in3140-rp", ["solve", problem("in3140-rp")], 0.8),
        ("solve puma560-first3", ["solve", problem("puma560-first3")], None),
        ("solve puma560 --json", ["solve", problem("puma560"), "--json"], 6),
        ("solve puma560 --latex", ["solve", problem("puma560"), "--latex"], 20),
        ("solve panda-7r --json", ["solve", problem("panda-7r"), "--json"], 16),
    ]
    print(f"{'command':<24}{'seconds':>9}{'ratio':>8}{'at most':>9}{'peak MiB':>10}")
    for name, arguments, most in cases:
        used = cost([*DYNSOLVE, *arguments], runs=1 if most == 16 else RUNS)
        ratio, bound = used.seconds / sympy.seconds, "" if most is None else f"{most:g}"
        print(f"{name:<24}{used.seconds:>9.2f}{ratio:>8.2f}{bound:>9}{used.mebibytes:>10.0f}")


def lengths() -> None:
    """The operations in the printed D and C; every + - * /, power, sign and function call counts."""
    cases = [("elbow-3r", 67, 160), ("puma560-first3", 260, 380), ("puma560", 13_000, 60_000)]
    print(f"\n{'operations printed':<24}{'D':>9}{'at most':>9}{'C':>9}{'at most':>9}")
    for name, most_in_D, most_in_C in cases:
        done = subprocess.run([*DYNSOLVE, "solve", problem(name), "--json"], capture_output=True, check=True)
        results = json.loads(done.stdout)["results"]
        D, C = operations(results["D"]), operations(results["C"])
        print(f"{name:<24}{D:>9}{most_in_D:>9}{C:>9}{most_in_C:>9}")


if __name__ == "__main__":
    times()
    lengths()
