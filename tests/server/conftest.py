"""Servers that the tests talk to: the API alone, and the whole command with a worker process."""

from __future__ import annotations

import os
import socket
import subprocess
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import httpx
import pytest
import uvicorn
from starlette.types import ASGIApp, Receive, Scope, Send
from vectortalker.server.app import create_app
from vectortalker.server.redis_store import RedisStore
from vectortalker.server.services import Services, open_services
from vectortalker.server.settings import Settings
from vectortalker.server.sqlite_store import SqliteStore
from vectortalker.server.store import Store

from .redis_server import MISSING, REASON, RedisServer

COMMAND = Path(__file__).parents[2] / ".venv" / "bin" / "vectortalker"
START_SECONDS = 90  # torch on a busy machine
PAGE = '<!doctype html><title>page</title><script type="module" src="./page.js"></script>'


def free_port() -> int:
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        return listener.getsockname()[1]


def wait_until(condition, seconds: float = 30) -> None:
    """Poll until true; fail with the condition's name after `seconds`."""
    deadline = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < deadline, f"not within {seconds} s"
        time.sleep(0.02)


@pytest.fixture(scope="session")
def redis_server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RedisServer]:
    if MISSING:
        pytest.skip(REASON)
    server = RedisServer(tmp_path_factory.mktemp("redis"), free_port())
    yield server
    server.kill()


@pytest.fixture(params=["sqlite", "redis"])
def store(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[Store]:
    """Either kind of store, empty."""
    if request.param == "sqlite":
        opened: Store = SqliteStore(tmp_path / "state.sqlite")
    else:
        server: RedisServer = request.getfixturevalue("redis_server")
        server.empty()
        opened = RedisStore(server.url)
    yield opened
    opened.close()


@pytest.fixture
def services(tmp_path: Path) -> Iterator[Services]:
    page = tmp_path / "page"
    page.mkdir()
    (page / "index.html").write_text(PAGE)
    opened = open_services(Settings(data=tmp_path / "data", page=page, max_queued=3, max_body_bytes=2_000_000))
    yield opened
    opened.close()


class Socket:
    """A real port whose application is exchanged from test to test."""

    def __init__(self) -> None:
        self.app: ASGIApp | None = None
        self.url = f"http://127.0.0.1:{(port := free_port())}"
        self.server = uvicorn.Server(uvicorn.Config(self, port=port, log_level="error", lifespan="off"))

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        assert self.app is not None
        await self.app(scope, receive, send)


@pytest.fixture(scope="session")
def listening() -> Iterator[Socket]:
    opened = Socket()
    thread = threading.Thread(target=opened.server.run)
    thread.start()
    wait_until(lambda: opened.server.started)
    yield opened
    opened.server.should_exit = True
    thread.join()


@pytest.fixture
def client(services: Services, listening: Socket) -> Iterator[httpx.Client]:
    """A client of the API, without workers."""
    listening.app = create_app(services)
    with httpx.Client(base_url=listening.url, timeout=20) as opened:
        yield opened


class Serving:
    """`vectortalker serve` as a process; it can be killed and started again on the same data."""

    def __init__(self, data: Path, *options: str) -> None:
        self._command = [str(COMMAND), "serve", "--data", str(data), *options]
        self._n_workers = int(options[options.index("--workers") + 1]) if "--workers" in options else 1
        self.start()

    def start(self) -> None:
        port = free_port()
        self.process = subprocess.Popen(self._command, env={**os.environ, "PORT": str(port)})
        self.client = httpx.Client(base_url=f"http://127.0.0.1:{port}", timeout=20)
        wait_until(self._is_ready, START_SECONDS)

    def _is_ready(self) -> bool:
        assert self.process.poll() is None, "the server ended"
        try:
            return self.client.get("/api/health").json()["workers"] >= self._n_workers
        except httpx.TransportError:
            return False

    def kill(self) -> None:
        self.client.close()
        self.process.kill()
        self.process.wait()

    def stop(self) -> None:
        self.client.close()
        self.process.terminate()
        assert self.process.wait(timeout=10) == 0


@pytest.fixture(scope="session")
def serving(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Serving]:
    served = Serving(tmp_path_factory.mktemp("served"))
    yield served
    served.stop()
