"""`poe strangers`: thousands of drawn mechanisms, each held to everything in `tests.strangers.held`.

Prints the seed, the share that is refused, and the faults by kind; what fails is shrunk to a file in
`tests/strangers/cases`, which is a test of its own from then on.
"""

from __future__ import annotations

import argparse
import time
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path
from signal import ITIMER_REAL, SIGALRM, setitimer, signal

from tests.strangers.generator import Problem, stranger, written
from tests.strangers.held import Fault, Refused, faults
from tests.strangers.shrink import shrunk

CASES = Path(__file__).parent / "cases"

PATIENCE = 120
"""Seconds after which a mechanism is given up."""


def looked_at(seed: int, patience: float = PATIENCE) -> tuple[int, str, list[Fault]]:
    """(seed, why it is refused, its faults)"""
    return seed, *judged(stranger(seed), seed, patience)


def judged(problem: Problem, seed: int, patience: float) -> tuple[str, list[Fault]]:
    """(why it is refused, its faults); one that takes longer than `patience` seconds is slow."""

    def give_up(*_: object) -> None:
        raise TimeoutError(f"more than {patience:.0f} s")

    signal(SIGALRM, give_up)
    setitimer(ITIMER_REAL, patience)
    try:
        return "", faults(written(problem), seed)
    except Refused as refused:
        return str(refused), []
    except TimeoutError as error:
        return "", [Fault("slow", str(error))]
    finally:
        setitimer(ITIMER_REAL, 0)


def kept(seed: int, fault: Fault, patience: float) -> Path:
    """The smallest file with a fault of this kind, written where it is a test of its own from then on."""

    def fails(problem: Problem) -> bool:
        return any(_alike(other, fault) for other in judged(problem, seed, patience)[1])

    path = CASES / f"{fault.kind.replace(' ', '-')}-{seed}.yaml"
    path.parent.mkdir(exist_ok=True)
    path.write_text(
        f"# {fault.kind}, found by seed {seed}\n" + written(shrunk(stranger(seed), fails)), "utf-8"
    )
    return path


def _alike(one: Fault, other: Fault) -> bool:
    """Whether two faults are of one kind: crashes at one place."""
    return one.kind == other.kind and (
        one.kind != "crash" or one.text.split(":")[:2] == other.text.split(":")[:2]
    )


def main() -> int:
    """Look at mechanisms, and say what was found."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("--count", type=int, default=1000, help="how many mechanisms are drawn")
    parser.add_argument("--seed", type=int, default=int(time.time()) % 10**6 * 10**4, help="the first seed")
    parser.add_argument("--jobs", type=int, default=2, help="how many processes look at them")
    parser.add_argument("--patience", type=float, default=PATIENCE, help="seconds for each")
    parser.add_argument(
        "--shrink", action=argparse.BooleanOptionalAction, default=True, help="keep what fails"
    )
    asked = parser.parse_args()
    print(f"seeds {asked.seed} to {asked.seed + asked.count - 1}")
    refused, kinds, failed = Counter[str](), Counter[str](), 0
    with ProcessPoolExecutor(asked.jobs) as pool:
        look = partial(looked_at, patience=asked.patience)
        for seed, why, found in pool.map(look, range(asked.seed, asked.seed + asked.count)):
            if why:
                refused[why.splitlines()[0].split(": ", 1)[-1]] += 1
            failed += bool(found)
            for fault in dict.fromkeys(found):
                kinds[fault.kind] += 1
                print(f"{seed}: {fault.kind}: {fault.text[:300]}", flush=True)
            if found and asked.shrink:
                print(f"{seed}: kept as {kept(seed, found[0], asked.patience)}", flush=True)
    print(f"refused: {sum(refused.values())} of {asked.count}")
    for why, count in refused.most_common():
        print(f"  {count}: {why[:160]}")
    print(f"faulty: {failed} of {asked.count}", dict(kinds))
    return bool(failed)


if __name__ == "__main__":
    raise SystemExit(main())
