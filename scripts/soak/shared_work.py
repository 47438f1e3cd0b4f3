"""A batch by one worker and by two on one Redis, each worker on a core of its own: the ratio of times, and equal bytes.

`python -m scripts.soak.shared_work [PORTRAITS]` from the repository's root, on the development portraits or else the
shipped samples; needs two cores that are otherwise idle. Whether they were can be read off the processor time of the
workers, whose ratio other work hardly touches.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

from vectortalker.bench.portraits import portrait_files, portrait_folder
from vectortalker.server.jobs import Jobs
from vectortalker.server.redis_store import RedisStore

from scripts.soak.deployment import START_SECONDS, children, wait
from tests.server.conftest import COMMAND, free_port
from tests.server.redis_server import RedisServer

PORTRAITS = 20
OPTIONS = ["--preset", "draft"]
RATIO_LIMIT = 0.6


@dataclass(frozen=True)
class Batch:
    """What one took: wall time, and the processor time of each worker, lowest first."""

    seconds: float
    cpu_seconds: list[float]


def main() -> int:
    n_portraits = int(sys.argv[1]) if len(sys.argv) > 1 else PORTRAITS
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "in").mkdir()
        for file in portrait_files(portrait_folder(), quick=False, names=None)[:n_portraits]:
            shutil.copy(file, folder / "in")
        n_portraits = len(list((folder / "in").iterdir()))
        print(f"shared work: load average {os.getloadavg()[0]:.1f} before the start", flush=True)
        one, two = (_batch(folder, n_workers) for n_workers in (1, 2))
        print(f"shared work: load average {os.getloadavg()[0]:.1f} at the end")
        differing = [
            file.name
            for file in sorted((folder / "out-1").iterdir())
            if file.read_bytes() != (folder / "out-2" / file.name).read_bytes()
        ]
    ratio, cpu_ratio = two.seconds / one.seconds, two.cpu_seconds[-1] / one.cpu_seconds[-1]
    print(f"shared work: {n_portraits} portraits: {one.seconds:.1f} s by one, {two.seconds:.1f} s by two: {ratio:.2f}")
    print(
        f"shared work: processor time {one.cpu_seconds[-1]:.1f} s by one,"
        f" {' and '.join(f'{seconds:.1f} s' for seconds in two.cpu_seconds)} by two: {cpu_ratio:.2f}"
    )
    print(f"shared work: {len(differing)} files differ {' '.join(differing)}")
    return 0 if ratio <= RATIO_LIMIT and not differing else 1


def _batch(folder: Path, n_workers: int) -> Batch:
    """From handing in to the last file, by warm workers pinned to one core each."""
    redis = RedisServer(folder / f"redis-{n_workers}", free_port())
    shared = ["--redis", redis.url, "--blobs", (folder / f"blobs-{n_workers}").as_uri()]
    supervisors = [
        _start("taskset", "--cpu-list", str(core), COMMAND, "worker", "--data", folder / f"{n_workers}-{core}", *shared)
        for core in range(n_workers)
    ]
    jobs = Jobs(RedisStore(redis.url), 3)
    try:
        wait(lambda: jobs.ready_workers() == n_workers, START_SECONDS, "the workers are ready")
        workers = [pid for supervisor in supervisors for pid in children(supervisor.pid)]
        before = {pid: _cpu_seconds(pid) for pid in workers}
        began = time.monotonic()
        out = folder / f"out-{n_workers}"
        batch = _start(COMMAND, "batch", folder / "in", "-o", out, "--handed-in", *shared, *OPTIONS)
        assert batch.wait() == 0, batch.returncode
        seconds = time.monotonic() - began
        return Batch(seconds, sorted(_cpu_seconds(pid) - before[pid] for pid in workers))
    finally:
        for supervisor in supervisors:
            supervisor.terminate()
        for supervisor in supervisors:
            supervisor.wait()
        redis.kill()


def _start(*words: object) -> subprocess.Popen[bytes]:
    return subprocess.Popen([str(word) for word in words], stderr=subprocess.DEVNULL)


def _cpu_seconds(pid: int) -> float:
    """User and system time, fields 14 and 15 of proc(5)'s `stat`."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


if __name__ == "__main__":
    sys.exit(main())
