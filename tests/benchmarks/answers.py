"""What judging an answer costs: `python -m tests.benchmarks.answers`.

A pair is an answer, read from its file and held against the key of a problem that
is already derived; beside it stand `sympy.simplify(a - b) == 0` and `Expr.equals`
on the same pair.  Nothing here asserts anything: the numbers depend on the machine.
"""

from __future__ import annotations

import multiprocessing
import time
from collections.abc import Callable
from typing import Any

import sympy
from sympy.simplify.fu import TR8

import dynsolve
from dynsolve.answers.judge import Checker
from dynsolve.answers.reading.files import read_submission

RUNS = 5
PATIENCE = 120
"""Seconds after which SymPy is not waited for."""


def best(work: Callable[[], object], runs: int = RUNS) -> float:
    """The least time of several runs, in milliseconds."""
    times = []
    for _ in range(runs):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return 1000 * min(times)


def within(work: Callable[[], object], seconds: float) -> str:
    """The time of one run in a process of its own, and what came out; or that it was stopped."""
    context = multiprocessing.get_context("fork")
    results = context.SimpleQueue()

    def run() -> None:
        start = time.perf_counter()
        found = work()
        results.put((time.perf_counter() - start, found))

    process = context.Process(target=run)
    process.start()
    process.join(seconds)
    if process.is_alive():
        process.terminate()
        process.join()
        return f"stopped after {seconds:g} s"
    took, found = results.get()
    return f"{1000 * took:.0f} ms ({found})"


def pairs() -> list[tuple[str, str, str, Any, Any, float]]:
    """(what, problem, name, key, answer, at most ms)"""
    found = []
    for stem, k, most in (("planar-2r", 0, 5.0), ("elbow-3r", 0, 50.0), ("puma560-first3", 0, 50.0)):
        torque = dynsolve.solve(stem).tau[k]
        expanded = sympy.expand(sympy.expand_trig(torque))
        summed = sympy.expand(TR8(expanded))
        for answer in (expanded, summed):
            terms = len(sympy.Add.make_args(answer))
            found.append((f"{stem} tau{k + 1}, {terms} terms", stem, f"tau{k + 1}", torque, answer, most))
        wrong = expanded + sympy.Add.make_args(expanded)[3]
        found.append((f"{stem} tau{k + 1}, one term doubled", stem, f"tau{k + 1}", torque, wrong, most))
    return found


def main() -> None:
    """Print a line a pair."""
    print(f"{'pair':<44}{'verdict':>12}{'ms':>8}{'at most':>9}   simplify == 0 / equals")
    for what, stem, name, torque, answer, most in pairs():
        problem = dynsolve.load(stem)
        checker = Checker(problem, dynsolve.solve(stem).values)
        source = f"answers:\n  {name}: {str(answer).replace('**', '^')}\n"

        def judge(problem: Any = problem, source: str = source, checker: Any = checker) -> Any:
            return checker(read_submission(problem, source, "answers.yaml"))

        verdict = next(a.verdict for a in judge().answers if a.name == name)
        took = best(judge)
        difference = torque - answer
        simplified = within(lambda d=difference: sympy.simplify(d) == 0, PATIENCE)  # type: ignore[misc]
        equals = within(lambda d=difference: d.equals(0), PATIENCE)  # type: ignore[misc]
        print(f"{what:<44}{verdict:>12}{took:>8.1f}{most:>9.0f}   {simplified} / {equals}", flush=True)


if __name__ == "__main__":
    main()
