"""A whole installation of its own for a soak: Redis or SQLite, servers, workers, all real processes."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import time
from collections.abc import Callable
from pathlib import Path

import httpx

from tests.server.conftest import COMMAND, free_port
from tests.server.redis_server import RedisServer

START_SECONDS = 600  # on a machine that is busy with other work
SMALL = {"paths": 24, "levels": 3, "iterations": 40, "final_iterations": 40, "working_size": 96}


def wait(condition: Callable[[], bool], seconds: float, what: str) -> None:
    deadline = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > deadline:
            raise TimeoutError(f"{what}: not within {seconds} s")
        time.sleep(0.05)


def megabytes(pid: int) -> float:
    """Of memory that the process holds."""
    found = re.search(r"VmRSS:\s+(\d+) kB", Path(f"/proc/{pid}/status").read_text())
    assert found is not None, pid
    return int(found.group(1)) / 1000


def children(pid: int) -> list[int]:
    """Processes that one of the threads of `pid` started."""
    return [int(child) for path in Path(f"/proc/{pid}/task").glob("*/children") for child in path.read_text().split()]


class Deployment:
    """One server with a worker of its own; with Redis, a second worker beside it."""

    def __init__(self, folder: Path, *, shared: bool) -> None:
        self.folder = folder
        self.port = free_port()
        self.url = f"http://127.0.0.1:{self.port}"
        self.redis = RedisServer(folder / "redis", free_port()) if shared else None
        self._options = ["--max-attempts", "10", "--log-format", "json", "--cache-mb", "0", "--min-free-mb", "1"]
        if self.redis:
            self._options += ["--redis", self.redis.url, "--blobs", (folder / "blobs").as_uri()]
        self.server = self._start("serve", "--port", str(self.port))
        self.helper = self._start("worker") if shared else None
        self.wait_for_answer()

    def _start(self, command: str, *options: str) -> subprocess.Popen[bytes]:
        words = [COMMAND, command, "--data", self.folder / command, *options, *self._options]
        with (self.folder / f"{command}.log").open("ab") as log:
            return subprocess.Popen([str(word) for word in words], stderr=log, stdout=log)

    def health(self) -> dict[str, object]:
        try:
            return httpx.get(f"{self.url}/api/health", timeout=10).json()
        except (httpx.HTTPError, json.JSONDecodeError):
            return {}

    def wait_for_answer(self) -> None:
        wait(lambda: "workers" in self.health(), START_SECONDS, "the server answers")

    def wait_for_workers(self) -> None:
        wait(lambda: int(str(self.health().get("workers", 0))) >= 1, START_SECONDS, "a worker is ready")

    def is_at_work(self) -> bool:
        """Whether a worker is ready and a job runs."""
        health = self.health()
        return min(int(str(health.get("workers", 0))), int(str(health.get("running", 0)))) >= 1

    def worker_pids(self) -> list[int]:
        """Worker processes of all supervisors."""
        return [pid for process in (self.server, self.helper) if process for pid in children(process.pid)]

    def kill_server(self) -> None:
        self.server.kill()
        self.server.wait()
        self.server = self._start("serve", "--port", str(self.port))

    def kill_redis(self) -> None:
        assert self.redis is not None
        self.redis.kill()
        self.redis.start()

    def kill_worker(self, number: int) -> bool:
        """Whether there was one."""
        pids = self.worker_pids()
        if pids:
            os.kill(pids[number % len(pids)], signal.SIGKILL)
        return bool(pids)

    def __enter__(self) -> Deployment:
        return self

    def __exit__(self, *_: object) -> None:
        running = [process for process in (self.server, self.helper) if process]
        for process in running:
            process.terminate()
        for process in running:
            process.wait(timeout=60)
        if self.redis:
            self.redis.kill()
