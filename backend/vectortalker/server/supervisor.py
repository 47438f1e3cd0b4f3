"""Keeps worker processes alive, kills those that do not let go of a cancelled job, and queues the jobs of dead ones."""

from __future__ import annotations

import logging
import sqlite3
import subprocess
import sys
import threading
import time
from dataclasses import dataclass

from vectortalker.server.run import folder, worker_name
from vectortalker.server.services import Services

TICK_SECONDS = 0.25
RENEW_SECONDS = 1.0
PATIENCE_SECONDS = 2.0  # between a cancel and the end of the worker that ignores it
RESTART_SECONDS = 5.0  # between two starts in the same place, so that a worker that cannot start burns no processor

log = logging.getLogger("vectortalker.supervisor")


@dataclass
class _Place:
    """A seat for one worker process after the other."""

    process: subprocess.Popen[bytes] | None = None
    started: float = -RESTART_SECONDS

    @property
    def worker(self) -> str:
        return worker_name(self.process.pid) if self.process else ""


class Supervisor:
    """Runs `settings.workers` processes until `stop` is set. Several supervisors may share one data folder."""

    def __init__(self, services: Services) -> None:
        self._services = services
        self._places = [_Place() for _ in range(services.settings.workers)]
        self._renewed = 0.0

    def run(self, stop: threading.Event) -> None:
        try:
            while not stop.is_set():
                try:
                    self._tick()
                except (sqlite3.Error, OSError):  # a full or busy disk passes; the next tick starts afresh
                    log.exception("supervision was interrupted")
                stop.wait(TICK_SECONDS)
        finally:
            for place in self._places:
                self._end(place)

    def _tick(self) -> None:
        jobs = self._services.jobs
        self._stop_stubborn()
        for place in self._places:
            self._keep_alive(place)
        if time.monotonic() - self._renewed > RENEW_SECONDS:
            jobs.renew([place.worker for place in self._places])
            self._renewed = time.monotonic()
        for job_id in jobs.recover():
            self._services.enqueue(job_id)
        if self._services.queue.pending_count() == 0:
            for job_id in jobs.orphans():
                self._services.enqueue(job_id)

    def _keep_alive(self, place: _Place) -> None:
        if place.process is not None and place.process.poll() is not None:
            log.warning("worker %s ended with code %s", place.worker, place.process.returncode)
            self._services.jobs.blame(place.worker)
            self._end(place)
        if place.process is None and time.monotonic() - place.started > RESTART_SECONDS:
            place.started = time.monotonic()
            command = [sys.executable, "-m", "vectortalker.server.worker", str(self._services.settings.data)]
            place.process = subprocess.Popen(command, stdin=subprocess.PIPE, start_new_session=True)  # Ctrl-C is ours

    def _stop_stubborn(self) -> None:
        held = {held.worker: held.job_id for held in self._services.jobs.stubborn(PATIENCE_SECONDS)}
        for place in self._places:
            job_id = held.get(place.worker)
            if job_id is not None:
                log.info("worker %s is replaced: it kept the cancelled job %s", place.worker, job_id)
                self._end(place)
                self._services.blobs.delete_folder(folder(job_id))

    def _end(self, place: _Place) -> None:
        """Kill the process if it still lives, and end its lease."""
        if place.process is not None:
            place.process.kill()
            place.process.wait()
            self._services.jobs.dismiss(place.worker)
            place.process = None
