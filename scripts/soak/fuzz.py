"""Many inputs for every target of tests/fuzz, each target in a process of limited memory and time.

`python -m scripts.soak.fuzz [INPUTS [TARGET…]]` from the repository's root prints a line a target, and ends with 1 if
any failed.
"""

from __future__ import annotations

import multiprocessing
import resource
import sys
import time
import traceback
from collections.abc import Callable
from random import Random
from typing import Any

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tests.fuzz.targets import TARGETS

INPUTS = 100_000
MEMORY_BYTES = 3_000_000_000  # of addresses, libraries included; a bomb that is unpacked would pass it
SECONDS_PER_INPUT = 0.2  # on a busy machine; a hang of any one input passes the sum


def main() -> int:
    total = int(sys.argv[1]) if len(sys.argv) > 1 else INPUTS
    names = sys.argv[2:] or list(TARGETS)
    shares = sum(TARGETS[name].share for name in names)
    failed, tried = [], 0
    for name in names:
        n_inputs = round(total * TARGETS[name].share / shares)
        process = multiprocessing.get_context("fork").Process(target=_try, args=(name, n_inputs))
        began = time.monotonic()
        process.start()
        process.join(60 + SECONDS_PER_INPUT * n_inputs)
        if process.is_alive():
            process.kill()
            process.join()
        seconds = time.monotonic() - began
        peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1000
        print(
            f"{name}: {n_inputs} inputs, {seconds:.0f} s, exit code {process.exitcode}, at most {peak:.0f} MB",
            flush=True,
        )
        tried += n_inputs
        if process.exitcode != 0:
            failed.append(name)
    print(f"fuzz: {tried} inputs, failed: {', '.join(failed) or 'none'}", flush=True)
    return 1 if failed else 0


def _try(name: str, n_inputs: int) -> None:
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY_BYTES, MEMORY_BYTES))
    target, seed = TARGETS[name], 0
    try:
        if isinstance(target.inputs, st.SearchStrategy):
            return _draw(target.inputs, target.run, n_inputs)
        for seed in range(n_inputs):
            target.run(target.inputs(Random(seed)))
    except BaseException:
        print(f"{name}: failed with seed {seed}", flush=True)
        traceback.print_exc()
        raise SystemExit(1) from None


def _draw(inputs: st.SearchStrategy[Any], run: Callable[[Any], None], n_inputs: int) -> None:
    @settings(max_examples=n_inputs, deadline=None, database=None, suppress_health_check=list(HealthCheck))
    @given(inputs)
    def property_holds(given_input: object) -> None:
        run(given_input)

    property_holds()


if __name__ == "__main__":
    sys.exit(main())
