"""A claimed job in a worker's hands: what it may still do, and how it speaks about itself."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TypeVar

from vectortalker.errors import VectorTalkerError
from vectortalker.server.services import Services

OUTAGE_SECONDS = 60.0  # for which a job waits for a store that cannot be reached
RETRY_SECONDS = 0.5

T = TypeVar("T")
log = logging.getLogger("vectortalker.worker")

MIN_FRACTION = 0.02  # below this an estimate of the remaining time is noise


class StoppedError(Exception):
    """The user cancelled the job, or its lease ran out and another worker has it."""


@dataclass(frozen=True)
class Run:
    services: Services
    job_id: str
    worker: str
    started: float = field(default_factory=time.monotonic)

    def key(self, name: str) -> str:
        """Where the job's file `name` is among the blobs."""
        return f"{folder(self.job_id)}/{name}"

    def wants_finish(self) -> bool:
        """Whether what there is is good enough for the user. Raises `StoppedError`."""
        wish = patiently(lambda: self.services.jobs.wish(self.job_id, self.worker))
        if wish == "stop":
            raise StoppedError
        return wish == "finish"

    def got_on(self) -> None:
        """A level is finished and stored: a new worker would go on from there."""
        patiently(lambda: self.services.jobs.got_on(self.job_id, self.worker))

    def report(self, **fields: object) -> None:
        """Store the next snapshot."""
        patiently(lambda: self.services.jobs.report(self.job_id, self.worker, **fields))

    def report_fraction(self, fraction: float, **fields: object) -> None:
        """Store the next snapshot with a progress in [0, 1] and the time that remains if it goes on as it went."""
        remaining = None
        if fraction >= MIN_FRACTION:
            remaining = round((time.monotonic() - self.started) * (1 - fraction) / fraction, 1)
        self.report(progress=fraction, remaining_seconds=remaining, **fields)


def folder(job_id: str) -> str:
    return f"jobs/{job_id}"


def patiently(ask: Callable[[], T]) -> T:
    """What `ask` returns, asked again for a while if the store is unavailable."""
    deadline = time.monotonic() + OUTAGE_SECONDS
    while True:
        try:
            return ask()
        except VectorTalkerError as error:
            if error.code != "unavailable" or time.monotonic() > deadline:
                raise
            log.warning("%s", error.message)
            time.sleep(RETRY_SECONDS)
