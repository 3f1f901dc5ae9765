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
from signal import ITIMER_REAL, SIGALRM, setitimer, signal

from tests.strangers.generator import stranger, written
from tests.strangers.held import Fault, Refused, faults

PATIENCE = 120
"""Seconds after which a mechanism is given up."""


def looked_at(seed: int, patience: float = PATIENCE) -> tuple[int, str, list[Fault]]:
    """(seed, why it is refused, its faults)"""

    def give_up(*_: object) -> None:
        raise TimeoutError(f"more than {patience:.0f} s")

    signal(SIGALRM, give_up)
    setitimer(ITIMER_REAL, patience)
    try:
        return seed, "", faults(written(stranger(seed)), seed)
    except Refused as refused:
        return seed, str(refused), []
    except TimeoutError as error:
        return seed, "", [Fault("slow", str(error))]
    finally:
        setitimer(ITIMER_REAL, 0)


def main() -> int:
    """Look at mechanisms, and say what was found."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("--count", type=int, default=1000, help="how many mechanisms are drawn")
    parser.add_argument("--seed", type=int, default=int(time.time()) % 10**6 * 10**4, help="the first seed")
    parser.add_argument("--jobs", type=int, default=2, help="how many processes look at them")
    parser.add_argument("--patience", type=float, default=PATIENCE, help="seconds for each")
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
    print(f"refused: {sum(refused.values())} of {asked.count}")
    for why, count in refused.most_common():
        print(f"  {count}: {why[:160]}")
    print(f"faulty: {failed} of {asked.count}", dict(kinds))
    return bool(failed)


if __name__ == "__main__":
    raise SystemExit(main())
