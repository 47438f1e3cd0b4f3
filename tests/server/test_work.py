"""The whole server with a real worker process: progress, cancel, finish, faults, restarts."""

from __future__ import annotations

import io
import os
import signal
from collections.abc import Iterator
from pathlib import Path

import av
import httpx
from vectortalker import schema
from vectortalker.server.events import event_id
from vectortalker.server.record import ENDED

from .conftest import Serving, wait_until
from .pictures import face_points, figure

TINY = {"paths": 32, "levels": 2, "iterations": 4, "final_iterations": 4, "working_size": 128}
ENDLESS = {"paths": 64, "levels": 2, "iterations": 5000, "final_iterations": 20000, "working_size": 128}
LONG_LAST_LEVEL = {**TINY, "levels": 3, "final_iterations": 20000}


def start(serving: Serving, options: dict[str, int]) -> str:
    portrait = serving.client.post("/api/portraits", files={"file": ("figure.png", figure(96, 128))}).json()
    job = serving.client.post("/api/jobs", json={"portrait_id": portrait["id"], "options": options})
    assert job.status_code == 202, job.text
    return job.json()["id"]


def state(serving: Serving, job_id: str) -> schema.JobState:
    return schema.JobState.model_validate(serving.client.get(f"/api/jobs/{job_id}").json())


def snapshots(client: httpx.Client, job_id: str, last_seen: int = 0) -> Iterator[schema.JobState]:
    """What a browser's EventSource gets: each event's data, with its id checked."""
    headers = {"Last-Event-ID": str(last_seen)}
    with client.stream("GET", f"/api/jobs/{job_id}/events", headers=headers) as stream:
        for line in stream.iter_lines():
            if line.startswith("data: "):
                snapshot = schema.JobState.model_validate_json(line.removeprefix("data: "))
            elif line.startswith("id: "):
                assert line.removeprefix("id: ") == event_id(snapshot)
                yield snapshot


def wait_for_scene(serving: Serving, job_id: str) -> None:
    wait_until(lambda: state(serving, job_id).scene_revision > 0)


def wait_for_end(serving: Serving, job_id: str) -> schema.JobState:
    wait_until(lambda: state(serving, job_id).phase in ENDED)
    return state(serving, job_id)


def worker_pid(serving: Serving) -> int:
    """The only child of the server is its worker."""
    children = Path(f"/proc/{serving.process.pid}/task/{serving.process.pid}/children")
    tasks = Path(f"/proc/{serving.process.pid}/task").glob("*/children")
    (pid,) = {int(pid) for path in [children, *tasks] for pid in path.read_text().split()}
    return pid


def test_job_streams_whole_snapshots_to_its_end(serving: Serving) -> None:
    job_id = start(serving, TINY)
    seen = list(snapshots(serving.client, job_id))
    revisions = [snapshot.revision for snapshot in seen]
    assert revisions == sorted(set(revisions))
    assert [snapshot.progress for snapshot in seen] == sorted(snapshot.progress for snapshot in seen)
    last = seen[-1]
    assert (last.phase, last.progress, last.levels) == ("done", 1, 2)
    assert last.metrics is not None and last.metrics.paths == last.n_paths
    scene = schema.Scene.model_validate(serving.client.get(f"/api/jobs/{job_id}/scene").json())
    assert (scene.width, scene.height) == (96, 128)
    assert len(scene.back) + len(scene.fore) + len(scene.local) == last.n_paths


def test_reconnected_stream_goes_on_with_the_newest(serving: Serving) -> None:
    job_id = start(serving, ENDLESS)
    first = next(snapshots(serving.client, job_id))
    wait_until(lambda: state(serving, job_id).revision > first.revision + 2)
    resumed = snapshots(serving.client, job_id, first.revision)
    assert next(resumed).revision > first.revision + 2
    serving.client.delete(f"/api/jobs/{job_id}")
    assert [snapshot.phase for snapshot in resumed][-1] == "cancelled"


def test_cancel_stops_the_work(serving: Serving) -> None:
    job_id = start(serving, ENDLESS)
    wait_for_scene(serving, job_id)
    before = worker_pid(serving)
    assert serving.client.delete(f"/api/jobs/{job_id}").json()["phase"] == "cancelled"
    assert wait_for_end(serving, start(serving, TINY)).phase == "done"
    assert worker_pid(serving) == before, "a worker that stops by itself is kept warm"


def test_worker_that_ignores_a_cancel_is_replaced(serving: Serving) -> None:
    job_id = start(serving, ENDLESS)
    wait_for_scene(serving, job_id)
    before = worker_pid(serving)
    os.kill(before, signal.SIGSTOP)
    serving.client.delete(f"/api/jobs/{job_id}")
    wait_until(lambda: not Path(f"/proc/{before}").exists(), 6)
    assert wait_for_end(serving, start(serving, TINY)).phase == "done"
    assert state(serving, job_id).phase == "cancelled"


def test_good_enough_keeps_what_is_there(serving: Serving) -> None:
    job_id = start(serving, ENDLESS)
    wait_for_scene(serving, job_id)
    assert serving.client.post(f"/api/jobs/{job_id}/finish").status_code == 202
    last = wait_for_end(serving, job_id)
    assert last.phase == "done" and last.metrics is not None and last.metrics.iterations < 5000
    assert serving.client.get(f"/api/jobs/{job_id}/scene").status_code == 200


def test_killed_worker_leaves_its_job_to_the_next(serving: Serving) -> None:
    job_id = start(serving, LONG_LAST_LEVEL)
    wait_until(lambda: state(serving, job_id).level == 3)
    os.kill(worker_pid(serving), signal.SIGKILL)
    wait_until(lambda: state(serving, job_id).phase == "queued")
    seen = snapshots(serving.client, job_id)
    assert next(snapshot.level for snapshot in seen if snapshot.stage.startswith("level")) == 3, "levels are kept"
    serving.client.post(f"/api/jobs/{job_id}/finish")
    assert wait_for_end(serving, job_id).phase == "done"


def test_job_that_brings_down_worker_and_server_is_set_aside(tmp_path: Path) -> None:
    """Two starts without a finished level between them; what waits behind it is done."""
    serving = Serving(tmp_path, "--max-attempts", "2")
    poison, waiting = start(serving, ENDLESS), start(serving, TINY)
    wait_for_scene(serving, poison)
    orphan = worker_pid(serving)
    os.kill(orphan, signal.SIGSTOP)
    before = state(serving, poison).revision
    serving.kill()
    os.kill(orphan, signal.SIGCONT)
    wait_until(lambda: not Path(f"/proc/{orphan}").exists(), 5)
    serving.start()
    wait_until(lambda: state(serving, poison).revision > before + 3 and state(serving, poison).phase == "running", 60)
    os.kill(worker_pid(serving), signal.SIGKILL)
    wait_until(lambda: state(serving, poison).phase != "running")
    last = state(serving, poison)
    assert last.phase == "failed" and last.error is not None and last.error.code == "internal"
    assert "2 times" in last.error.message
    assert wait_for_end(serving, waiting).phase == "done"
    serving.stop()


def test_stopped_server_queues_its_job_without_blame(tmp_path: Path) -> None:
    serving = Serving(tmp_path, "--max-attempts", "1")
    job_id = start(serving, ENDLESS)
    wait_for_scene(serving, job_id)
    serving.stop()
    serving.start()
    wait_until(lambda: state(serving, job_id).phase == "running")
    serving.client.post(f"/api/jobs/{job_id}/finish")
    assert wait_for_end(serving, job_id).phase == "done"
    serving.stop()


def test_job_that_no_worker_takes_fails_in_time(tmp_path: Path) -> None:
    serving = Serving(tmp_path, "--workers", "0", "--no-worker-seconds", "0.5")
    last = wait_for_end(serving, start(serving, TINY))
    assert last.phase == "failed" and last.error is not None and last.error.code == "unavailable"
    serving.stop()


def test_video_of_a_track_can_be_watched(serving: Serving) -> None:
    job_id = start(serving, TINY)
    wait_for_end(serving, job_id)
    scene = serving.client.get(f"/api/jobs/{job_id}/scene").json()
    track = {"duration": 0.4, "fps": 10, "articulators": {"jaw": [0, 0.5, 1, 0.5]}}
    body = {"scene": scene, "landmarks": {"points": face_points(48, 64)}, "track": track, "fps": 10, "size": 64}
    video = serving.client.post("/api/videos", json=body).json()
    assert wait_for_end(serving, video["id"]).phase == "done"
    answer = serving.client.get(f"/api/videos/{video['id']}/file")
    assert answer.headers["content-type"] == "video/mp4"
    with av.open(io.BytesIO(answer.content)) as container:
        frames = [frame.to_ndarray(format="gray") for frame in container.decode(video=0)]
    assert len(frames) == 4 and frames[0].shape == (64, 48)
