"""A claimed job in a worker's hands: what it may still do, and how it speaks about itself."""

from __future__ import annotations

import os
import socket
import time
from dataclasses import dataclass, field

from vectortalker.server.services import Services

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
        wish = self.services.jobs.wish(self.job_id, self.worker)
        if wish == "stop":
            raise StoppedError
        return wish == "finish"

    def report(self, **fields: object) -> None:
        """Store the next snapshot."""
        self.services.jobs.report(self.job_id, self.worker, **fields)

    def report_fraction(self, fraction: float, **fields: object) -> None:
        """Store the next snapshot with a progress in [0, 1] and the time that remains if it goes on as it went."""
        remaining = None
        if fraction >= MIN_FRACTION:
            remaining = round((time.monotonic() - self.started) * (1 - fraction) / fraction, 1)
        self.report(progress=fraction, remaining_seconds=remaining, **fields)


def folder(job_id: str) -> str:
    return f"jobs/{job_id}"


def worker_name(pid: int) -> str:
    return f"{socket.gethostname()}-{pid}"


def this_worker() -> str:
    return worker_name(os.getpid())
