"""Workers, the server and Redis are killed and the disk is filled at random moments while jobs run: none is lost, all
give the same bytes.

`python -m scripts.soak.faults [KILLS] [sqlite|redis] [SEED]` from the repository's root. Every job's SVG is compared
with that of an undisturbed run of the same request; event streams are cut and taken up again with `Last-Event-ID`.
Where this user may mount a small disk, all data lie on it, and it is filled from time to time; only then may a job
fail, and it must say so.
"""

from __future__ import annotations

import json
import random
import signal
import sys
import tempfile
import threading
import time
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import httpx

from scripts.soak.deployment import SMALL, START_SECONDS, Deployment
from tests.server.pictures import picture
from tests.server.small_disk import fill, small_disk

KILLS = 50
MEAN_SECONDS = 1.0  # between the moment when some job runs and the kill; a job takes about as long
WAITING = 3  # jobs that are kept in the queue while there are kills to come
N_REQUESTS = 4  # different ones, each asked for again and again
PATIENCE_SECONDS = 600.0  # for the last job after the last kill
ENDED = ("done", "failed", "cancelled")
DISK_MEGABYTES = 200
MEAN_FULL_SECONDS = 3.0
FILLING_SHARE = 0.2  # of the faults


@dataclass
class Asked:
    seed: int
    job_id: str
    phase: str = "queued"
    error: dict[str, str] | None = None


class Client:
    """Asks as a browser does: again after any failure, and for snapshots from where the stream was cut."""

    def __init__(self, deployment: Deployment) -> None:
        self._url = deployment.url
        self.cuts = 0

    def ask(self, method: str, path: str, **content: object) -> httpx.Response:
        deadline = time.monotonic() + START_SECONDS
        while True:
            try:
                answer = httpx.request(method, f"{self._url}{path}", timeout=30, **content)  # type: ignore[arg-type]
                if answer.status_code < 500:
                    return answer
            except httpx.HTTPError:
                pass
            if time.monotonic() > deadline:
                raise TimeoutError(f"{method} {path}")
            time.sleep(0.2)

    def start(self, seed: int) -> str:
        portrait = self.ask("POST", "/api/portraits", files={"file": ("waves.png", picture(72, 96))}).json()
        body = {"portrait_id": portrait["id"], "options": {**SMALL, "seed": seed}}
        return self.ask("POST", "/api/jobs", json=body).json()["id"]

    def follow(self, job_id: str) -> dict[str, object]:
        """The last snapshot, over as many streams as it takes; revisions never go back."""
        last_id, revision, state = "", -1, dict[str, object]()
        deadline = time.monotonic() + PATIENCE_SECONDS
        while time.monotonic() < deadline:
            try:
                headers = {"Last-Event-ID": last_id} if last_id else {}
                with httpx.stream(
                    "GET", f"{self._url}/api/jobs/{job_id}/events", headers=headers, timeout=30
                ) as stream:
                    if stream.status_code == 404:
                        raise AssertionError(f"job {job_id} was lost")
                    for line in stream.iter_lines():
                        if line.startswith("data: "):
                            state = json.loads(line.removeprefix("data: "))
                            assert int(str(state["revision"])) >= revision, (state, revision)
                            revision = int(str(state["revision"]))
                        elif line.startswith("id: "):
                            last_id = line.removeprefix("id: ")
                        if random.random() < 0.02:
                            break  # the connection is cut here
            except httpx.HTTPError:
                time.sleep(0.2)
            if state.get("phase") in ENDED:
                return state
            self.cuts += 1
        raise TimeoutError(f"job {job_id} is stuck: {state}")


def undisturbed(folder: Path) -> list[str]:
    """The SVG of each request."""
    with Deployment(folder, shared=False) as deployment:
        client = Client(deployment)
        jobs = [client.start(seed) for seed in range(N_REQUESTS)]
        states = [client.follow(job_id) for job_id in jobs]
        assert all(state["phase"] == "done" for state in states), states
        return [client.ask("GET", f"/api/jobs/{job_id}/svg").text for job_id in jobs]


def main() -> int:
    kills = int(sys.argv[1]) if len(sys.argv) > 1 else KILLS
    shared = sys.argv[2:3] != ["sqlite"]
    random.seed(int(sys.argv[3]) if len(sys.argv) > 3 else 1)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "undisturbed").mkdir()
        expected = undisturbed(folder / "undisturbed")
        with (
            small_disk(folder / "disk", DISK_MEGABYTES) as may_fill,
            Deployment(folder / "disk", shared=shared) as deployment,
        ):
            return _disturbed(deployment, kills, expected, may_fill)


def _disturbed(deployment: Deployment, kills: int, expected: list[str], may_fill: bool) -> int:
    client, killed, n_filled = Client(deployment), Counter[str](), 0
    feed = _Feed(client)
    began = time.monotonic()
    while killed.total() < kills:
        feed.until(deployment.is_at_work)
        time.sleep(random.expovariate(1 / MEAN_SECONDS))
        if may_fill and random.random() < FILLING_SHARE:
            _fill_for_a_while(deployment)
            n_filled += 1
            continue
        victim = _kill(deployment)
        if victim:
            killed[victim] += 1
            print(f"{time.monotonic() - began:.0f} s: {victim} killed, {len(feed.asked)} jobs so far", flush=True)
    feed.follow_to_the_end()
    done = [job for job in feed.asked if job.phase == "done"]
    refused = [job for job in feed.asked if job.error and job.error["code"] == "storage_full"]
    differing = [job for job in done if client.ask("GET", f"/api/jobs/{job.job_id}/svg").text != expected[job.seed]]
    print(
        f"faults: {dict(killed)} killed and the disk filled {n_filled} times in {time.monotonic() - began:.0f} s,"
        f" {client.cuts} streams taken up again"
    )
    print(
        f"faults: {len(feed.asked)} jobs: {len(done)} done, {len(refused)} failed for want of space;"
        f" {len(differing)} differ from the undisturbed run"
    )
    for job in feed.asked:
        if job not in done and job not in refused:
            print(f"faults: job {job.job_id}: {job.phase}, {job.error}")
    return 0 if len(done) + len(refused) == len(feed.asked) and not differing else 1


class _Feed:
    """Keeps some jobs waiting and follows each of them."""

    def __init__(self, client: Client) -> None:
        self._client = client
        self._threads: list[threading.Thread] = []
        self.asked: list[Asked] = []

    def until(self, condition: Callable[[], bool]) -> None:
        deadline = time.monotonic() + START_SECONDS
        while not condition():
            if time.monotonic() > deadline:
                raise TimeoutError(f"no job ran for {START_SECONDS} s")
            if sum(job.phase not in ENDED for job in self.asked) < WAITING:
                self._ask()
            time.sleep(0.1)

    def _ask(self) -> None:
        seed = len(self.asked) % N_REQUESTS
        job = Asked(seed, self._client.start(seed))
        self.asked.append(job)
        self._threads.append(threading.Thread(target=_follow, args=(self._client, job)))
        self._threads[-1].start()

    def follow_to_the_end(self) -> None:
        for thread in self._threads:
            thread.join()


def _follow(client: Client, job: Asked) -> None:
    state = client.follow(job.job_id)
    job.phase, job.error = str(state["phase"]), state["error"]  # type: ignore[assignment]  # as `ApiError` has it


def _fill_for_a_while(deployment: Deployment) -> None:
    filling = deployment.folder / "filling"
    fill(filling)
    time.sleep(random.expovariate(1 / MEAN_FULL_SECONDS))
    filling.unlink()


def _kill(deployment: Deployment) -> str | None:
    victims = ["worker", "worker", "server"] + (["Redis"] if deployment.redis else [])
    match random.choice(victims):
        case "worker":
            return "worker" if deployment.kill_worker(random.randrange(4)) else None
        case "server":
            deployment.kill_server()
            return "server"
        case _:
            deployment.kill_redis()
            return "Redis"


if __name__ == "__main__":
    sys.exit(main())
