"""A worker process: imports and warms everything once, then does one job after another until its supervisor is gone."""

from __future__ import annotations

import os
import sys
import threading
import time
from pathlib import Path

import numpy as np

from vectortalker import decode
from vectortalker.schema import VectorizeOptions
from vectortalker.server.run import this_worker
from vectortalker.server.services import open_services
from vectortalker.server.settings import Settings
from vectortalker.vectorize import vectorize

IDLE_SECONDS = 0.05
WARM_UP = VectorizeOptions(paths=8, levels=1, iterations=1, final_iterations=1, working_size=64)


def main() -> None:
    """`python -m vectortalker.server.worker DATA`, with the supervisor at the other end of stdin."""
    threading.Thread(target=_exit_with_supervisor, daemon=True).start()
    services = open_services(Settings(data=Path(sys.argv[1])))
    _warm_up()
    services.jobs.enlist(this_worker())
    while True:
        task = services.queue.dequeue()
        if task is None:
            time.sleep(IDLE_SECONDS)
        else:
            services.queue.execute(task)


def _warm_up() -> None:
    """Models, kernels and allocators are loaded by a first small picture, so that the first user need not wait."""
    grey = decode.Portrait(np.full((64, 64, 3), 128, np.uint8), None, "warm-up", ())
    for _ in vectorize(grey, None, WARM_UP, finish_early=lambda: False, resume=None):
        pass


def _exit_with_supervisor() -> None:
    """The supervisor never writes: the end of stdin is the end of the supervisor."""
    sys.stdin.read()
    os._exit(0)


if __name__ == "__main__":
    main()
