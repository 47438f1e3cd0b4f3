"""Several workers on one Redis, as on several machines: they share a batch, and an end of Redis loses nothing."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest
from vectortalker.cli import main
from vectortalker.server.redis_store import RedisStore

from .conftest import COMMAND, START_SECONDS, free_port, wait_until
from .pictures import figure
from .redis_server import MISSING, REASON, RedisServer

OPTIONS = ["--paths", "24", "--levels", "2", "--iterations", "24", "--final-iterations", "24", "--working-size", "96"]
N_PICTURES = 4

pytestmark = pytest.mark.skipif(MISSING, reason=REASON)


class Machine:
    """A worker with a data folder of its own; only Redis and the blobs are shared."""

    def __init__(self, folder: Path, name: str, shared: list[str]) -> None:
        self.log = folder / f"{name}.log"
        command = [COMMAND, "worker", "--data", folder / name, "--log-format", "json", *shared]
        with self.log.open("w") as stderr:
            self.process = subprocess.Popen([str(part) for part in command], stderr=stderr)

    def lines(self) -> list[dict[str, object]]:
        return [json.loads(line) for line in self.log.read_text().splitlines()]

    def is_ready(self) -> bool:
        return any(line["message"] == "ready" for line in self.lines())

    def done(self) -> list[object]:
        """Ids of the jobs that it did."""
        return [line["job"] for line in self.lines() if line["message"] == "done"]

    def stop(self) -> None:
        self.process.terminate()
        assert self.process.wait(timeout=30) == 0


@pytest.fixture
def own_redis(tmp_path: Path) -> Iterator[RedisServer]:
    server = RedisServer(tmp_path / "redis", free_port())
    yield server
    server.kill()


def write_pictures(folder: Path) -> Path:
    folder.mkdir()
    for i in range(N_PICTURES):
        (folder / f"{i}.png").write_bytes(figure(64 + i, 80))
    (folder / "text.png").write_text("no picture")
    return folder


def test_workers_share_a_batch_over_an_end_of_redis(tmp_path: Path, own_redis: RedisServer) -> None:
    """The same bytes as in one process, each by some worker; the file that is no picture is refused as there."""
    pictures = write_pictures(tmp_path / "in")
    shared = ["--redis", own_redis.url, "--blobs", (tmp_path / "blobs").as_uri()]
    machines = [Machine(tmp_path, name, shared) for name in ("one", "two")]
    wait_until(lambda: all(machine.is_ready() for machine in machines), START_SECONDS)
    command = [COMMAND, "batch", pictures, "-o", tmp_path / "handed-in", "--handed-in", *shared, *OPTIONS]
    batch = subprocess.Popen([str(part) for part in command], stderr=subprocess.PIPE, text=True)
    wait_until(lambda: all(machine.done() for machine in machines), START_SECONDS)
    own_redis.kill()
    own_redis.start()
    _, stderr = batch.communicate(timeout=120)
    assert batch.returncode == 2 and "text.png is not a picture" in stderr
    assert main(["batch", str(pictures), "-o", str(tmp_path / "alone"), *OPTIONS]) == 2
    for file in sorted((tmp_path / "alone").iterdir()):
        assert (tmp_path / "handed-in" / file.name).read_bytes() == file.read_bytes(), file.name
    assert len(list((tmp_path / "handed-in").iterdir())) == 2 * N_PICTURES
    for machine in machines:
        machine.stop()
    assert RedisStore(own_redis.url).members("jobs") == [], "a batch leaves nothing behind"
