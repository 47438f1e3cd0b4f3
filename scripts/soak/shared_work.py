"""A batch by one worker and by two on one Redis, each worker on a core of its own: the ratio of times, and equal bytes.

`python -m scripts.soak.shared_work [PICTURES]` from the repository's root; needs two cores that are otherwise idle.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from vectortalker.server.jobs import Jobs
from vectortalker.server.redis_store import RedisStore

from scripts.soak.deployment import START_SECONDS, wait
from tests.server.conftest import COMMAND, free_port
from tests.server.pictures import picture
from tests.server.redis_server import RedisServer

PICTURES = 20
OPTIONS = ["--paths", "60", "--levels", "3", "--iterations", "60", "--final-iterations", "60", "--working-size", "128"]
RATIO_LIMIT = 0.6


def main() -> int:
    n_pictures = int(sys.argv[1]) if len(sys.argv) > 1 else PICTURES
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "in").mkdir()
        for i in range(n_pictures):
            (folder / "in" / f"{i:02}.png").write_bytes(picture(120 + i, 160))
        print(f"shared work: load average {os.getloadavg()[0]:.1f} before the start", flush=True)
        seconds = [_batch(folder, n_workers) for n_workers in (1, 2)]
        differing = [
            file.name
            for file in sorted((folder / "out-1").iterdir())
            if file.read_bytes() != (folder / "out-2" / file.name).read_bytes()
        ]
    ratio = seconds[1] / seconds[0]
    print(
        f"shared work: {n_pictures} pictures, {seconds[0]:.1f} s by one worker, {seconds[1]:.1f} s by two: {ratio:.2f}"
    )
    print(f"shared work: {len(differing)} files differ")
    return 0 if ratio <= RATIO_LIMIT and not differing else 1


def _batch(folder: Path, n_workers: int) -> float:
    """Seconds from handing in to the last file, by warm workers pinned to one core each."""
    redis = RedisServer(folder / f"redis-{n_workers}", free_port())
    shared = ["--redis", redis.url, "--blobs", (folder / f"blobs-{n_workers}").as_uri()]
    workers = [
        _start("taskset", "--cpu-list", str(core), COMMAND, "worker", "--data", folder / f"{n_workers}-{core}", *shared)
        for core in range(n_workers)
    ]
    jobs = Jobs(RedisStore(redis.url), 3)
    try:
        wait(lambda: jobs.ready_workers() == n_workers, START_SECONDS, "the workers are ready")
        began = time.monotonic()
        out = folder / f"out-{n_workers}"
        batch = _start(COMMAND, "batch", folder / "in", "-o", out, "--handed-in", *shared, *OPTIONS)
        assert batch.wait() == 0, batch.returncode
        return time.monotonic() - began
    finally:
        for worker in workers:
            worker.terminate()
        for worker in workers:
            worker.wait()
        redis.kill()


def _start(*words: object) -> subprocess.Popen[bytes]:
    return subprocess.Popen([str(word) for word in words], stderr=subprocess.DEVNULL)


if __name__ == "__main__":
    sys.exit(main())
