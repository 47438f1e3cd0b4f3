"""Keeps worker processes alive, kills those that do not let go of a cancelled job, and queues the jobs of dead ones."""

from __future__ import annotations

import logging
import os
import secrets
import socket
import sqlite3
import subprocess
import sys
import threading
import time
from dataclasses import dataclass, field

import redis
from pydantic import TypeAdapter

from vectortalker.errors import VectorTalkerError
from vectortalker.server.jobs import LEASE_SECONDS
from vectortalker.server.orphans import remove_orphans
from vectortalker.server.removal import sweep
from vectortalker.server.run import folder
from vectortalker.server.services import Services
from vectortalker.server.settings import Settings

TICK_SECONDS = 0.25
RENEW_SECONDS = 1.0
SWEEP_SECONDS = 60.0
ORPHANS_SECONDS = 3600.0  # all folders are listed
PATIENCE_SECONDS = 2.0  # between a cancel and the end of the worker that ignores it
RESTART_SECONDS = 5.0  # between two starts in the same place, so that a worker that cannot start burns no processor

log = logging.getLogger("vectortalker.supervisor")


@dataclass
class _Place:
    """A seat for one worker process after the other, with the cores that they may use."""

    cores: frozenset[int] | None
    process: subprocess.Popen[bytes] | None = None
    worker: str = ""
    started: float = -RESTART_SECONDS


@dataclass
class _Clock:
    """When things were last done, by the monotonic clock."""

    renewed: float = 0.0
    swept: float = field(default_factory=time.monotonic)
    looked_for_orphans: float = field(default_factory=time.monotonic)
    worker_seen: float = field(default_factory=time.monotonic)
    recover_from: float = 0.0


class Supervisor:
    """Runs `settings.workers` processes until `stop` is set. Several supervisors may share one store."""

    def __init__(self, services: Services) -> None:
        self._services = services
        self._places = [_Place(cores) for cores in _shares(services.settings.workers)]
        self._last = _Clock()

    def run(self, stop: threading.Event) -> None:
        """At its end the workers are killed and what they held is queued again."""
        try:
            while not stop.is_set():
                try:
                    self._tick()
                except (sqlite3.Error, redis.RedisError, VectorTalkerError, OSError) as error:
                    log.warning("supervision was interrupted: %s", error)  # passes; the next tick starts afresh
                    self._last.recover_from = time.monotonic() + LEASE_SECONDS  # nobody could renew a lease either
                stop.wait(TICK_SECONDS)
        finally:
            self._stop_all()

    def _tick(self) -> None:
        now = time.monotonic()
        for place in self._places:
            self._keep_alive(place)
        if now - self._last.renewed > RENEW_SECONDS:
            self._services.jobs.renew([place.worker for place in self._places if place.process])
            self._last.renewed = now
        self._stop_stubborn()
        if now > self._last.recover_from:
            self._call(self._services.jobs.recover())
        self._fail_hopeless(now)
        if now - self._last.swept > SWEEP_SECONDS:
            self._last.swept = now
            sweep(self._services)
        if now - self._last.looked_for_orphans > ORPHANS_SECONDS:
            self._last.looked_for_orphans = now
            remove_orphans(self._services)

    def _keep_alive(self, place: _Place) -> None:
        if place.process is not None and place.process.poll() is not None:
            log.warning("a worker ended", extra={"worker": place.worker, "exit_code": place.process.returncode})
            self._end(place, by_intention=False)
        if place.process is None and time.monotonic() - place.started > RESTART_SECONDS:
            place.started = time.monotonic()
            place.worker = f"{socket.gethostname()}-{secrets.token_hex(6)}"  # never used again, as a process id may be
            place.process = _start(place.worker, self._services.settings)
            if place.cores:
                os.sched_setaffinity(place.process.pid, place.cores)

    def _stop_stubborn(self) -> None:
        held = {held.worker: held.job_id for held in self._services.jobs.stubborn(PATIENCE_SECONDS)}
        for place in self._places:
            job_id = held.get(place.worker)
            if job_id is not None:
                log.warning("a worker kept a cancelled job and is replaced", extra={"job": job_id})
                self._end(place, by_intention=True)
                self._services.blobs.delete_folder(folder(job_id))

    def _fail_hopeless(self, now: float) -> None:
        """Jobs that wait although no worker has been ready for long, here or elsewhere, are told so."""
        limit = self._services.settings.no_worker_seconds
        if self._services.jobs.ready_workers():
            self._last.worker_seen = now
        elif now - self._last.worker_seen > limit:
            for job_id in self._services.jobs.waiting(limit):
                message = f"No worker could start for {limit:.0f} s: the server's log tells why; start the job again."
                self._services.jobs.fail_waiting(job_id, message)
                log.error("failed: no worker is ready", extra={"job": job_id})

    def _end(self, place: _Place, *, by_intention: bool) -> None:
        """Kill the process if it still lives, and queue what it held."""
        if place.process is not None:
            place.process.kill()
            place.process.wait()
            place.process = None
            self._call(self._services.jobs.dismiss(place.worker, by_intention=by_intention))

    def _stop_all(self) -> None:
        for place in self._places:
            try:
                self._end(place, by_intention=True)
            except (sqlite3.Error, redis.RedisError, VectorTalkerError, OSError) as error:
                log.warning("what a worker held waits for the end of its lease: %s", error)

    def _call(self, queued: list[str]) -> None:
        for _ in queued:
            self._services.wake()


def _start(worker: str, settings: Settings) -> subprocess.Popen[bytes]:
    """Its settings may hold passwords, so they go through stdin; its end there tells it that we are gone."""
    command = [sys.executable, "-m", "vectortalker.server.worker", worker]
    process = subprocess.Popen(command, stdin=subprocess.PIPE, start_new_session=True)  # Ctrl-C is ours
    assert process.stdin is not None
    process.stdin.write(TypeAdapter(Settings).dump_json(settings) + b"\n")
    process.stdin.flush()
    return process


def _shares(n_workers: int) -> list[frozenset[int] | None]:
    """The cores of each worker: disjoint if there are enough and more than one shares them, else all (None)."""
    cores = sorted(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else []
    if not 1 < n_workers <= len(cores):
        return [None] * n_workers
    return [frozenset(cores[first::n_workers]) for first in range(n_workers)]
