"""What is kept and for how long: the cache of results, retention, and deletion that leaves nothing."""

from __future__ import annotations

import multiprocessing
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import httpx
import pytest
from vectortalker.errors import VectorTalkerError
from vectortalker.outputs import write_whole
from vectortalker.schema import JobRequest, Metrics, VectorizeOptions
from vectortalker.server import kept, portraits
from vectortalker.server.blobs import Blobs
from vectortalker.server.cache import Cache, CachedResult
from vectortalker.server.orphans import remove_orphans
from vectortalker.server.removal import sweep
from vectortalker.server.services import Services, open_services
from vectortalker.server.settings import Settings
from vectortalker.server.sqlite_store import SqliteStore
from vectortalker.server.store import Store

from .pictures import picture
from .small_disk import REASON, fill, small_disk
from .test_api import refused, start_job, upload

COUNTS = dict.fromkeys(("paths", "segments", "parameters", "iterations", "bytes", "gzip_bytes"), 1)
METRICS = Metrics(**COUNTS, **dict.fromkeys(("seconds", "cpu_seconds", "mse", "psnr", "ssim"), 1.0))
ENTRY_BYTES = 10_000
PROCESSES = 4


def request(seed: int, portrait_id: str = "p") -> JobRequest:
    return JobRequest(portrait_id=portrait_id, options=VectorizeOptions(seed=seed))


def result(text: str = "scene") -> CachedResult:
    return CachedResult(scene=text.ljust(ENTRY_BYTES), svg="<svg/>", metrics=METRICS, levels=2)


@pytest.fixture
def blobs(tmp_path: Path) -> Blobs:
    return Blobs(str(tmp_path / "blobs"), 0)


@pytest.fixture
def cache(store: Store, blobs: Blobs) -> Cache:
    return Cache(store, blobs, 4 * ENTRY_BYTES)


def files(blobs: Blobs, folder: str) -> list[str]:
    return blobs.names(folder)


def test_same_picture_and_request_is_known_whatever_the_portrait_is_called(cache: Cache) -> None:
    cache.add("picture", request(1, "one"), result())
    assert cache.find("picture", request(1, "other")) == result()
    assert cache.find("picture", request(2)) is None and cache.find("another", request(1)) is None


def test_longest_unused_is_dropped_first(cache: Cache, blobs: Blobs) -> None:
    """Room is for three entries; the first was used again before the fourth came."""
    for seed in (1, 2, 3):
        cache.add("picture", request(seed), result())
    assert cache.find("picture", request(1)) is not None
    cache.add("picture", request(4), result())
    assert [cache.find("picture", request(seed)) is not None for seed in (1, 2, 3, 4)] == [True, False, True, True]
    assert cache.total_bytes() <= 4 * ENTRY_BYTES and len(files(blobs, "cache")) == 3


def test_forgotten_picture_leaves_no_results(cache: Cache, blobs: Blobs) -> None:
    cache.add("picture", request(1), result())
    cache.add("other", request(1), result())
    cache.forget("picture")
    assert cache.find("picture", request(1)) is None and cache.find("other", request(1)) is not None
    assert len(files(blobs, "cache")) == 1


def _use(folder: Path, number: int) -> None:
    cache = Cache(SqliteStore(folder / "state.sqlite"), Blobs(str(folder / "blobs"), 0), 4 * ENTRY_BYTES)
    for i in range(30):
        seed = (7 * i + number) % 9
        known = cache.find("picture", request(seed))
        assert known is None or known == result(f"{seed}")
        cache.add("picture", request(seed), result(f"{seed}"))


def test_processes_share_the_cache(tmp_path: Path) -> None:
    """Whole entries or none are read while others are dropped, and the limit holds in the end."""
    context = multiprocessing.get_context("fork")
    processes = [context.Process(target=_use, args=(tmp_path, number)) for number in range(PROCESSES)]
    for process in processes:
        process.start()
    for process in processes:
        process.join()
    assert [process.exitcode for process in processes] == [0] * PROCESSES
    blobs = Blobs(str(tmp_path / "blobs"), 0)
    cache = Cache(SqliteStore(tmp_path / "state.sqlite"), blobs, 4 * ENTRY_BYTES)
    cache.add("picture", request(0), result("0"))
    assert cache.total_bytes() <= 4 * ENTRY_BYTES
    assert not [name for name in files(blobs, "cache") if name.endswith(".part")]


def test_known_result_is_answered_at_once(client: httpx.Client, services: Services) -> None:
    portrait_id = upload(client, picture()).json()["id"]
    asked = JobRequest(portrait_id=portrait_id, options=VectorizeOptions(paths=8))
    services.cache.add(portraits.picture(services.blobs, portrait_id), asked, result('{"width": 1}'))
    again = upload(client, picture(), "the same.png").json()["id"]
    job = start_job(client, again, paths=8).json()
    assert job["phase"] == "done" and job["scene_revision"] == 1 and job["levels"] == 2
    assert client.get(f"/api/jobs/{job['id']}/scene").json() == {"width": 1}
    assert client.get(f"/api/jobs/{job['id']}/svg").text == "<svg/>"
    assert start_job(client, again, paths=9).json()["phase"] == "queued"


def stored_files(services: Services) -> list[Path]:
    return [path for path in (services.settings.data / "blobs").rglob("*") if path.is_file()]


def test_deleted_portrait_leaves_nothing(client: httpx.Client, services: Services) -> None:
    portrait_id = upload(client, picture()).json()["id"]
    asked = JobRequest(portrait_id=portrait_id, options=VectorizeOptions(paths=8))
    services.cache.add(portraits.picture(services.blobs, portrait_id), asked, result())
    job_ids = [start_job(client, portrait_id, paths=paths).json()["id"] for paths in (8, 9)]
    assert client.delete(f"/api/portraits/{portrait_id}").status_code == 204
    for path in (f"portraits/{portrait_id}/image", *(f"jobs/{job_id}" for job_id in job_ids)):
        refused(client.get(f"/api/{path}"), 404, "not_found")
    assert stored_files(services) == [] and services.cache.total_bytes() == 0


def test_unused_things_are_removed_when_their_time_is_over(client: httpx.Client, services: Services) -> None:
    portrait_id = upload(client, picture()).json()["id"]
    job_id = start_job(client, portrait_id).json()["id"]
    sweep(services)
    assert (
        client.get(f"/api/jobs/{job_id}").status_code == client.get(f"/api/portraits/{portrait_id}").status_code == 200
    )
    sweep(replace(services, settings=replace(services.settings, retention_seconds=-1)))
    assert (
        client.get(f"/api/jobs/{job_id}").status_code == client.get(f"/api/portraits/{portrait_id}").status_code == 404
    )
    assert stored_files(services) == []


def test_files_without_a_record_are_removed_in_time(client: httpx.Client, services: Services) -> None:
    """As after crashes between a job's request and its record, and between a cached result and its entry."""
    portrait_id = upload(client, picture()).json()["id"]
    job_id = start_job(client, portrait_id).json()["id"]
    services.cache.add("picture", request(1), result())
    kept = set(stored_files(services))
    for key in ("jobs/lost/request.json", "portraits/lost/source", "cache/lost.json", "cache/lost.json.1234.part"):
        services.blobs.put(key, b"{}")
    services.blobs.put("jobs/soon/request.json", b"{}")
    remove_orphans(services)
    assert len(stored_files(services)) == len(kept) + 5, "none was seen for long"
    services.jobs.create("soon", "vectorize", portrait_id, "ada")
    remove_orphans(services, patience_seconds=-1)
    left = set(stored_files(services)) - kept
    assert {file.parent.name for file in left} == {"soon"} and services.jobs.get(job_id).phase == "queued"
    assert kept <= set(stored_files(services)) and services.store.members("orphans") == []


def test_use_keeps_a_portrait(client: httpx.Client, services: Services) -> None:
    portrait_id = upload(client, picture()).json()["id"]
    uploaded = time.time()
    start_job(client, portrait_id)
    assert kept.unused_since(services.store, "portraits", uploaded) == []


@pytest.fixture
def in_memory() -> Iterator[Blobs]:
    blobs = Blobs("memory://vectortalker-test", 0)
    yield blobs
    blobs.delete_folder("")


def test_blobs_lie_in_any_store_of_fsspec(in_memory: Blobs) -> None:
    in_memory.put("jobs/a/scene.json", b"1")
    in_memory.put("jobs/a/scene.json", b"2")
    assert in_memory.get("jobs/a/scene.json") == b"2" and in_memory.names("jobs") == ["a"]
    in_memory.delete_folder("jobs/a")
    assert in_memory.find("jobs/a/scene.json") is None and in_memory.free_bytes() is None


@pytest.fixture
def disk(tmp_path: Path) -> Iterator[Path]:
    """Of 3 MB."""
    folder = tmp_path / "disk"
    with small_disk(folder, 3) as mounted:
        if not mounted:
            pytest.skip(REASON)
        yield folder


def test_full_disk_loses_nothing_that_was_kept(disk: Path) -> None:
    """Blobs and jobs are added until the disk is full; then each is whole or not there, and deleting makes room."""
    services = open_services(Settings(data=disk, min_free_bytes=0))
    kept = []
    with pytest.raises(VectorTalkerError) as caught:
        for number in range(100):
            services.blobs.put(f"jobs/{number}/scene.json", bytes(50_000))
            services.jobs.create(f"{number}", "vectorize", None, "ada")
            kept.append(number)
    assert caught.value.code == "storage_full" and len(kept) > 10
    services.blobs.delete_folder("jobs/0")
    services.blobs.delete_folder("jobs/1")
    services.close()
    reopened = open_services(Settings(data=disk, min_free_bytes=0))
    assert all(reopened.jobs.get(f"{number}").phase == "queued" for number in kept)
    assert all(reopened.blobs.find(f"jobs/{number}/scene.json") == bytes(50_000) for number in kept[2:])
    reopened.jobs.create("after", "vectorize", None, "ada")
    assert reopened.jobs.get("after").phase == "queued"
    reopened.close()


def test_file_that_does_not_fit_leaves_the_old_one(disk: Path) -> None:
    file = disk / "portrait.svg"
    write_whole(file, b"old")
    with pytest.raises(VectorTalkerError, match="is full") as caught:
        write_whole(file, bytes(4_000_000))
    assert caught.value.code == "storage_full" and file.read_bytes() == b"old" and list(disk.iterdir()) == [file]


@pytest.mark.parametrize("is_new", [True, False], ids=["new", "used"])
def test_start_on_a_full_disk_says_so_and_keeps_what_is_there(disk: Path, is_new: bool) -> None:
    settings = Settings(data=disk / "data", min_free_bytes=0)
    if not is_new:
        used = open_services(settings)
        used.jobs.create("kept", "vectorize", None, "ada")
        used.close()
    filling = disk / "filling"
    fill(filling)
    with pytest.raises(VectorTalkerError) as caught:
        open_services(settings)
    assert caught.value.code == "storage_full"
    filling.unlink()
    reopened = open_services(settings)
    if not is_new:
        assert reopened.jobs.get("kept").phase == "queued"
    reopened.close()


def test_job_is_kept_when_no_worker_can_be_called(services: Services, caplog: pytest.LogCaptureFixture) -> None:
    """The queue's table is gone: the job is stored all the same, since workers look for jobs by themselves."""
    services.queue.storage.conn.execute("DROP TABLE task")
    services.wake()
    assert "no worker could be called" in caplog.text
