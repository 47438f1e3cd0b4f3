"""A worker process: imports and warms everything once, then does one job after another until its supervisor is gone."""

from __future__ import annotations

import logging
import os
import sqlite3
import sys
import threading
import time

import numpy as np
import redis
from pydantic import TypeAdapter

from vectortalker import decode
from vectortalker.errors import VectorTalkerError
from vectortalker.schema import VectorizeOptions
from vectortalker.server.logs import set_up_logs
from vectortalker.server.run import patiently
from vectortalker.server.services import Services, open_services
from vectortalker.server.settings import Settings
from vectortalker.server.work import do_next
from vectortalker.vectorize import vectorize

IDLE_SECONDS = 0.05
NICENESS = 5  # a third of the weight of the server, so that pages and uploads need not wait for jobs
LOOK_SECONDS = 2.0  # a worker that was not called looks for jobs by itself, since a call may be lost
OUTAGE_SECONDS = 1.0
OUTAGES = (sqlite3.Error, redis.RedisError, OSError)
WARM_UP = VectorizeOptions(paths=8, levels=1, iterations=1, final_iterations=1, working_size=64)

log = logging.getLogger("vectortalker.worker")


def main() -> None:
    """`python -m vectortalker.server.worker NAME`; the first line of stdin holds the settings, then it stays open."""
    name, settings = sys.argv[1], TypeAdapter(Settings).validate_json(sys.stdin.readline())
    threading.Thread(target=_exit_with_supervisor, daemon=True).start()
    set_up_logs(settings.json_logs)
    _stand_back()
    services = open_services(settings)
    _warm_up()
    patiently(lambda: services.jobs.enlist(name))
    log.info("ready", extra={"worker": name})
    looked = 0.0
    while True:
        try:
            if _called(services) or time.monotonic() - looked > LOOK_SECONDS:
                looked = time.monotonic()
                do_next(services, name)
        except OUTAGES:
            log.warning("the queue does not answer")
            time.sleep(OUTAGE_SECONDS)
        except VectorTalkerError as error:
            log.warning("%s", error.message)
            time.sleep(OUTAGE_SECONDS)


def _called(services: Services) -> bool:
    """Takes a call off the queue, if there is one, or waits a moment."""
    if services.queue.dequeue() is not None:
        return True
    time.sleep(IDLE_SECONDS)
    return False


def _warm_up() -> None:
    """Models, kernels and allocators are loaded by a first small picture, so that the first user need not wait."""
    grey = decode.Portrait(np.full((64, 64, 3), 128, np.uint8), None, "warm-up", ())
    for _ in vectorize(grey, None, WARM_UP, finish_early=lambda: False, resume=None):
        pass


def _stand_back() -> None:
    if hasattr(os, "nice"):
        os.nice(NICENESS)


def _exit_with_supervisor() -> None:
    """The supervisor writes no more: the end of stdin is the end of the supervisor."""
    sys.stdin.read()
    os._exit(0)


if __name__ == "__main__":
    main()
