"""Many clients, each with many jobs at once: how long page and uploads take while these are worked on.

`python -m scripts.soak.load [CLIENTS] [JOBS]` from the repository's root. Each client has an address of its own on the
loopback network. Every job must end; the server's memory is read before and after.
"""

from __future__ import annotations

import os
import random
import sys
import tempfile
import threading
import time
from collections import Counter
from pathlib import Path

import httpx
import numpy as np

from scripts.soak.deployment import START_SECONDS, Deployment, megabytes, wait
from tests.server.pictures import figure

CLIENTS = 20
JOBS = 200
SMALL = {"paths": 24, "levels": 1, "iterations": 60, "final_iterations": 60, "working_size": 128}  # some 0.3 s
PAUSE_SECONDS = 5.0  # mean, between two pictures of a client
MEDIAN_LIMIT, P99_LIMIT = 0.2, 1.0  # seconds
ENDED = ("done", "failed", "cancelled")


class Times:
    def __init__(self) -> None:
        self._seconds: dict[str, list[float]] = {}

    def request(self, client: httpx.Client, name: str, method: str, path: str, **content: object) -> httpx.Response:
        began = time.perf_counter()
        answer = client.request(method, path, **content)  # type: ignore[arg-type]  # as httpx takes them
        self._seconds.setdefault(name, []).append(time.perf_counter() - began)
        return answer

    def report(self) -> bool:
        """Prints a line a kind of request; whether all are within the limits."""
        good = True
        for name, seconds in self._seconds.items():
            median, p99 = np.percentile(seconds, [50, 99])
            good &= bool(median <= MEDIAN_LIMIT and p99 <= P99_LIMIT)
            print(f"load: {name}: {len(seconds)} requests, median {1000 * median:.0f} ms, p99 {1000 * p99:.0f} ms")
        return good


class Client:
    """Hands in its jobs at once, then uses page and uploads as a person does until all of them have ended."""

    def __init__(self, url: str, number: int, times: Times) -> None:
        transport = httpx.HTTPTransport(local_address=f"127.0.0.{number + 2}")
        self._http = httpx.Client(base_url=url, transport=transport, timeout=60)
        self._times = times
        self._picture = figure(400 + number, 600)  # made before anything is timed

    def use(self, n_jobs: int, jobs: list[str]) -> None:
        portrait_id = self._upload()
        mine = [self._start(portrait_id, seed) for seed in range(n_jobs)]
        jobs += mine
        while mine:
            time.sleep(random.expovariate(1 / PAUSE_SECONDS))
            self._upload()
            while mine and self._has_ended(mine[0]):
                mine.pop(0)

    def _upload(self) -> str:
        self._times.request(self._http, "page", "GET", "/")
        files = {"file": ("waves.png", self._picture)}
        return self._times.request(self._http, "upload", "POST", "/api/portraits", files=files).json()["id"]

    def _has_ended(self, job_id: str) -> bool:
        return self._times.request(self._http, "state", "GET", f"/api/jobs/{job_id}").json()["phase"] in ENDED

    def _start(self, portrait_id: str, seed: int) -> str:
        body = {"portrait_id": portrait_id, "options": {**SMALL, "seed": seed}}
        answer = self._times.request(self._http, "job", "POST", "/api/jobs", json=body)
        assert answer.status_code == 202, answer.text
        return answer.json()["id"]


def main() -> int:
    clients = int(sys.argv[1]) if len(sys.argv) > 1 else CLIENTS
    n_jobs = int(sys.argv[2]) if len(sys.argv) > 2 else JOBS
    times, jobs = Times(), list[str]()
    with tempfile.TemporaryDirectory() as folder, Deployment(Path(folder), shared=False) as deployment:
        deployment.wait_for_workers()
        wait(lambda: deployment.health().get("running") == 0, START_SECONDS, "the worker is idle")
        before, load = megabytes(deployment.server.pid), os.getloadavg()
        users = [Client(deployment.url, number, times) for number in range(clients)]
        began = time.monotonic()
        threads = [threading.Thread(target=user.use, args=(n_jobs // clients, jobs)) for user in users]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        seconds, after = time.monotonic() - began, megabytes(deployment.server.pid)
        phases = Counter(httpx.get(f"{deployment.url}/api/jobs/{job_id}").json()["phase"] for job_id in jobs)
    good = times.report()
    print(f"load: {clients} clients, {len(jobs)} jobs in {seconds:.0f} s: {dict(phases)}")
    print(
        f"load: server {before:.0f} MB before, {after:.0f} MB after; load average {load[0]:.1f} before,"
        f" {os.getloadavg()[0]:.1f} after"
    )
    return 0 if good and set(phases) <= {"done", "cancelled"} and len(jobs) == n_jobs else 1


if __name__ == "__main__":
    sys.exit(main())
