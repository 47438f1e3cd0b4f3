"""Hours of light use: whether the memory of the server and of its worker stays flat, and every job ends.

`python -m scripts.soak.endurance [MINUTES] [SECONDS_BETWEEN]` from the repository's root. One person works on: pictures
of many sizes are traced, broken off, finished early and deleted, sounds are listened to, videos are rendered. Memory is
read again and again; a line is fitted to what comes after the warm-up.
"""

from __future__ import annotations

import itertools
import random
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable
from pathlib import Path

import httpx
import numpy as np

from scripts.soak.deployment import Deployment, megabytes, wait
from tests.server.pictures import face_points, picture
from tests.server.test_speech import tone

MINUTES = 60.0
SECONDS_BETWEEN = 20.0  # from the beginning of one job to that of the next
WARM_UP_SHARE = 0.25  # of the time: allocators and caches reach what they need
GROWTH_LIMIT = 0.05  # of the memory, in an hour
JOB_SECONDS = 300.0
SMALL = {"paths": 24, "levels": 2, "iterations": 20, "final_iterations": 20, "working_size": 96}
ENDLESS = {**SMALL, "iterations": 5000, "final_iterations": 20000}
ENDED = ("done", "failed", "cancelled")
Samples = dict[str, list[tuple[float, float]]]  # by process: seconds and megabytes


class Person:
    """Each method is one job, from upload to deletion; returns the phase in which it ended."""

    def __init__(self, url: str) -> None:
        self._client = httpx.Client(base_url=url, timeout=60)

    def traced(self) -> str:
        portrait_id, job_id = self._traced(SMALL)
        phase = self._end(job_id)
        self._client.get(f"/api/jobs/{job_id}/svg").raise_for_status()
        self._client.delete(f"/api/portraits/{portrait_id}").raise_for_status()
        return phase

    def broken_off(self) -> str:
        _, job_id = self._traced(ENDLESS)
        self._wait_for_scene(job_id)
        self._client.delete(f"/api/jobs/{job_id}").raise_for_status()
        return self._end(job_id)

    def finished_early(self) -> str:
        _, job_id = self._traced(ENDLESS)
        self._wait_for_scene(job_id)
        self._client.post(f"/api/jobs/{job_id}/finish").raise_for_status()
        return self._end(job_id)

    def listened(self) -> str:
        files = {"file": ("voice.wav", tone(random.uniform(1, 8)))}
        recording = self._answer("POST", "/api/recordings", files=files)
        return self._end(self._answer("POST", "/api/speech", json={"recording_id": recording["id"]})["id"])

    def rendered(self) -> str:
        _, job_id = self._traced(SMALL)
        self._end(job_id)
        scene = self._answer("GET", f"/api/jobs/{job_id}/scene")
        landmarks = {"points": face_points(float(scene["width"]) / 2, float(scene["height"]) / 2)}
        track = {"duration": 1, "fps": 10, "articulators": {"jaw": [0.1 * i for i in range(10)]}}
        body = {"scene": scene, "landmarks": landmarks, "track": track, "fps": 10, "size": 128}
        return self._end(self._answer("POST", "/api/videos", json=body)["id"])

    def _traced(self, options: dict[str, int]) -> tuple[str, str]:
        """Ids of a new portrait of any size and of a job on it."""
        self._client.get("/").raise_for_status()
        size = random.randrange(96, 1000), random.randrange(96, 1400)
        portrait_id = self._answer("POST", "/api/portraits", files={"file": ("waves.png", picture(*size))})["id"]
        self._client.get(f"/api/portraits/{portrait_id}/faces").raise_for_status()
        return portrait_id, self._answer("POST", "/api/jobs", json={"portrait_id": portrait_id, "options": options})[
            "id"
        ]

    def _answer(self, method: str, path: str, **content: object) -> dict[str, str]:
        return self._client.request(method, path, **content).raise_for_status().json()  # type: ignore[arg-type]  # as httpx

    def _wait_for_scene(self, job_id: str) -> None:
        wait(lambda: int(self._answer("GET", f"/api/jobs/{job_id}")["scene_revision"]) > 0, JOB_SECONDS, "a scene")

    def _end(self, job_id: str) -> str:
        """Watches the events to the last."""
        with self._client.stream("GET", f"/api/jobs/{job_id}/events", timeout=JOB_SECONDS) as stream:
            stream.read()
        wait(lambda: self._answer("GET", f"/api/jobs/{job_id}")["phase"] in ENDED, JOB_SECONDS, "the end of a job")
        return self._answer("GET", f"/api/jobs/{job_id}")["phase"]


def main() -> int:
    minutes = float(sys.argv[1]) if len(sys.argv) > 1 else MINUTES
    seconds_between = float(sys.argv[2]) if len(sys.argv) > 2 else SECONDS_BETWEEN
    random.seed(1)
    with tempfile.TemporaryDirectory() as folder, Deployment(Path(folder), shared=False) as deployment:
        deployment.wait_for_workers()
        return _work_on(deployment, 60 * minutes, seconds_between)


def _work_on(deployment: Deployment, seconds: float, seconds_between: float) -> int:
    person, phases, samples = Person(deployment.url), Counter[tuple[str, str]](), Samples()
    kinds: list[Callable[[], str]] = [person.traced, person.traced, person.broken_off, person.finished_early]
    began, workers = time.monotonic(), deployment.worker_pids()
    for kind in itertools.cycle([*kinds, person.listened, *kinds, person.rendered]):
        started = time.monotonic()
        if started - began > seconds:
            break
        phases[kind.__name__, kind()] += 1
        for name, pid in (("server", deployment.server.pid), ("worker", workers[0])):
            samples.setdefault(name, []).append((time.monotonic() - began, megabytes(pid)))
        print(_line(samples, phases), flush=True)
        time.sleep(max(0.0, seconds_between - (time.monotonic() - started)))
    flat = [_is_flat(name, np.array(found), WARM_UP_SHARE * seconds) for name, found in samples.items()]
    ended_well = all(phase == ("cancelled" if kind == "broken_off" else "done") for kind, phase in phases)
    print(f"endurance: {phases.total()} jobs in {seconds / 60:.0f} minutes: {_listed(phases)}")
    return 0 if all(flat) and ended_well and deployment.worker_pids() == workers else 1


def _is_flat(name: str, samples: np.ndarray, warm_up_seconds: float) -> bool:
    """Prints the line through `samples` ([n, 2]: seconds, MB) after the warm-up; whether it rises within the limit."""
    seconds, memory = samples[samples[:, 0] >= warm_up_seconds].T
    (slope, _), covariance = np.polyfit(seconds / 3600, memory, 1, cov=True)
    error = float(np.sqrt(covariance[0, 0]))
    print(
        f"endurance: {name}: {memory.mean():.0f} MB ({memory.min():.0f} to {memory.max():.0f}) after the warm-up,"
        f" {slope:+.1f} ± {error:.1f} MB an hour over {len(memory)} samples"
    )
    return bool(slope <= GROWTH_LIMIT * memory.mean())


def _line(samples: Samples, phases: Counter[tuple[str, str]]) -> str:
    memory = ", ".join(f"{name} {found[-1][1]:.0f} MB" for name, found in samples.items())
    return f"{samples['server'][-1][0]:.0f} s: {phases.total()} jobs, {memory}"


def _listed(phases: Counter[tuple[str, str]]) -> str:
    return ", ".join(f"{kind} {phase} {count}" for (kind, phase), count in sorted(phases.items()))


if __name__ == "__main__":
    sys.exit(main())
