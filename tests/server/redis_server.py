"""A real Redis that the tests start, kill and start again on its own files."""

from __future__ import annotations

import shutil
import subprocess
import time
from pathlib import Path

import redis

MISSING = shutil.which("redis-server") is None
REASON = "redis-server is not installed (Debian package redis-server)"
START_SECONDS = 30


class RedisServer:
    """Keeps every answered write over its own death: `appendonly yes`."""

    def __init__(self, folder: Path, port: int) -> None:
        self.url = f"redis://127.0.0.1:{port}/0"
        folder.mkdir(parents=True, exist_ok=True)
        options = {
            "port": port,
            "bind": "127.0.0.1",
            "dir": folder,
            "appendonly": "yes",
            "save": "",
            "loglevel": "warning",
        }
        self._command = [
            "redis-server",
            *(text for name, value in options.items() for text in (f"--{name}", str(value))),
        ]
        self.start()

    def start(self) -> None:
        self.process = subprocess.Popen(self._command, stdout=subprocess.DEVNULL)
        client = redis.Redis.from_url(self.url)
        deadline = time.monotonic() + START_SECONDS
        while True:
            try:
                client.ping()
                return
            except redis.ConnectionError:
                assert time.monotonic() < deadline and self.process.poll() is None, "redis-server does not start"
                time.sleep(0.02)

    def kill(self) -> None:
        self.process.kill()
        self.process.wait()

    def empty(self) -> None:
        redis.Redis.from_url(self.url).flushall()
