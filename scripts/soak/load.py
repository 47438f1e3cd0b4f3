"""Many clients with many jobs at once: how long page, uploads and job requests take while the worker is busy.

`python -m scripts.soak.load [CLIENTS] [JOBS]` from the repository's root. Each client has an address of its own on the
loopback network. Every job must end; the server's memory is read before and after.
"""

from __future__ import annotations

import os
import random
import re
import sys
import tempfile
import threading
import time
from collections import Counter
from pathlib import Path

import httpx
import numpy as np

from scripts.soak.deployment import START_SECONDS, Deployment, wait
from tests.server.pictures import picture

CLIENTS = 20
JOBS = 200
TINY = {"paths": 16, "levels": 1, "iterations": 8, "final_iterations": 8, "working_size": 64}
PAUSE_SECONDS = 0.5  # mean, between two requests of a client, as a person has it
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


def use(url: str, number: int, n_jobs: int, times: Times, jobs: list[str]) -> None:
    """One client: the page, an upload, and a job on it, again and again; then its jobs are watched to their end."""
    transport = httpx.HTTPTransport(local_address=f"127.0.0.{number + 2}")
    mine = []
    with httpx.Client(base_url=url, transport=transport, timeout=60) as client:
        for i in range(n_jobs):
            times.request(client, "page", "GET", "/")
            files = {"file": ("waves.png", picture(400 + number, 600 + i))}
            portrait = times.request(client, "upload", "POST", "/api/portraits", files=files).json()
            body = {"portrait_id": portrait["id"], "options": {**TINY, "seed": i}}
            answer = times.request(client, "job", "POST", "/api/jobs", json=body)
            assert answer.status_code == 202, answer.text
            mine.append(answer.json()["id"])
            time.sleep(random.expovariate(1 / PAUSE_SECONDS))
        jobs += mine
        while mine:
            times.request(client, "page", "GET", "/")
            state = times.request(client, "state", "GET", f"/api/jobs/{mine[0]}").json()
            if state["phase"] in ENDED:
                mine.pop(0)
            else:
                time.sleep(random.expovariate(1 / PAUSE_SECONDS))


def megabytes(pid: int) -> float:
    found = re.search(r"VmRSS:\s+(\d+) kB", Path(f"/proc/{pid}/status").read_text())
    assert found is not None, pid
    return int(found.group(1)) / 1000


def main() -> int:
    clients = int(sys.argv[1]) if len(sys.argv) > 1 else CLIENTS
    n_jobs = int(sys.argv[2]) if len(sys.argv) > 2 else JOBS
    times, jobs = Times(), list[str]()
    with tempfile.TemporaryDirectory() as folder, Deployment(Path(folder), shared=False) as deployment:
        deployment.wait_for_workers()
        wait(lambda: deployment.health().get("running") == 0, START_SECONDS, "the worker is idle")
        before, load = megabytes(deployment.server.pid), os.getloadavg()[0]
        began = time.monotonic()
        arguments = (deployment.url, n_jobs // clients, times, jobs)
        threads = [threading.Thread(target=use, args=(arguments[0], i, *arguments[1:])) for i in range(clients)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        seconds, after = time.monotonic() - began, megabytes(deployment.server.pid)
        phases = Counter(httpx.get(f"{deployment.url}/api/jobs/{job_id}").json()["phase"] for job_id in jobs)
    good = times.report()
    print(f"load: {clients} clients, {len(jobs)} jobs in {seconds:.0f} s: {dict(phases)}")
    print(f"load: server {before:.0f} MB before, {after:.0f} MB after; load average {load:.1f} before the start")
    return 0 if good and set(phases) <= {"done", "cancelled"} and len(jobs) == n_jobs else 1


if __name__ == "__main__":
    sys.exit(main())
