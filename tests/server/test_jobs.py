"""Jobs over either store: order, leases, attempts, limits, and what many do at once. No worker is needed for it."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable

import pytest
from vectortalker.errors import VectorTalkerError
from vectortalker.server.jobs import LEASE_SECONDS, Jobs
from vectortalker.server.store import Change, Store

ATTEMPTS = 3


class Clock:
    """What `time.time` says, moved by hand."""

    def __init__(self) -> None:
        self.seconds = 1000.0

    def __call__(self) -> float:
        return self.seconds


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> Clock:
    moved = Clock()
    monkeypatch.setattr(time, "time", moved)
    return moved


@pytest.fixture
def jobs(store: Store) -> Jobs:
    return Jobs(store, ATTEMPTS)


def add(jobs: Jobs, *ids: str, client: str = "ada", portrait: str = "p") -> None:
    for job_id in ids:
        jobs.create(job_id, "vectorize", portrait, client)


def claimed(jobs: Jobs, worker: str = "w") -> str | None:
    job = jobs.claim(worker)
    return job.id if job else None


def at_once(n: int, work: Callable[[int], None]) -> None:
    threads = [threading.Thread(target=work, args=[i]) for i in range(n)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()


def test_first_come_is_first_claimed(jobs: Jobs) -> None:
    add(jobs, "a", "b")
    assert [jobs.get(job_id).queue_position for job_id in "ab"] == [0, 1]
    assert claimed(jobs) == "a" and jobs.get("b").queue_position == 0
    assert jobs.get("a").phase == "running" and claimed(jobs, "v") == "b" and claimed(jobs, "u") is None


def test_job_is_claimed_once_by_many_workers_at_once(jobs: Jobs) -> None:
    add(jobs, *(f"{i}" for i in range(12)))
    taken: list[str] = []

    def work(i: int) -> None:
        while (job := jobs.claim(f"w{i}")) is not None:
            taken.append(job.id)
            jobs.report(job.id, f"w{i}", phase="done")
            jobs.release(job.id, f"w{i}")

    at_once(6, work)
    assert sorted(taken) == sorted(f"{i}" for i in range(12))
    assert jobs.ended("done") == 12


def test_changes_of_many_are_all_kept(jobs: Jobs) -> None:
    """Each stores a next revision of the same job: 1 new + 1 claimed + 4·10."""
    add(jobs, "a")
    claimed(jobs)
    at_once(4, lambda _: [jobs.report("a", "w", n_paths=k) for k in range(10)] and None)
    assert jobs.get("a").revision == 42


def test_claim_whose_answer_was_lost_is_found_again(jobs: Jobs) -> None:
    add(jobs, "a", "b")
    assert claimed(jobs) == claimed(jobs) == "a"


def test_job_of_a_worker_without_lease_is_queued_again_in_its_place(jobs: Jobs, clock: Clock) -> None:
    add(jobs, "a", "b")
    assert claimed(jobs) == "a" and jobs.recover() == []
    clock.seconds += LEASE_SECONDS + 1
    assert jobs.recover() == ["a"] and jobs.ready_workers() == 0
    assert jobs.get("a").queue_position == 0 and jobs.wish("a", "w") == "stop"


def test_renewed_lease_keeps_the_job(jobs: Jobs, clock: Clock) -> None:
    add(jobs, "a")
    claimed(jobs)
    for _ in range(3):
        clock.seconds += LEASE_SECONDS / 2
        jobs.renew(["w"])
    assert jobs.recover() == [] and jobs.wish("a", "w") == "go_on"


def test_attempts_are_counted_before_they_begin_and_bounded(jobs: Jobs) -> None:
    add(jobs, "a")
    for _ in range(ATTEMPTS):
        assert claimed(jobs) == "a"
        jobs.dismiss("w")
    last = jobs.get("a")
    assert last.phase == "failed" and last.error is not None and "3 times" in last.error.message
    assert claimed(jobs) is None


def test_finished_level_starts_the_count_anew(jobs: Jobs) -> None:
    add(jobs, "a")
    for _ in range(2 * ATTEMPTS):
        assert claimed(jobs) == "a"
        jobs.got_on("a", "w")
        jobs.dismiss("w")
    assert jobs.get("a").phase == "queued"


def test_worker_ended_by_intention_is_no_attempt(jobs: Jobs) -> None:
    add(jobs, "a")
    for _ in range(2 * ATTEMPTS):
        assert claimed(jobs) == "a"
        jobs.dismiss("w", by_intention=True)
    assert jobs.get("a").phase == "queued"


def test_worker_that_lost_its_job_changes_nothing(jobs: Jobs) -> None:
    add(jobs, "a")
    claimed(jobs)
    jobs.dismiss("w")
    before = jobs.get("a")
    jobs.report("a", "w", phase="done")
    jobs.release("a", "w")
    assert jobs.get("a") == before


def test_cancelled_job_is_stubborn_until_it_is_let_go(jobs: Jobs) -> None:
    add(jobs, "a")
    claimed(jobs)
    jobs.cancel("a")
    assert [held.worker for held in jobs.stubborn(-1)] == ["w"] and jobs.is_unwanted("a")
    jobs.release("a", "w")
    assert jobs.stubborn(-1) == []


def test_forgotten_job_is_gone_at_once_and_removed_when_let_go(jobs: Jobs) -> None:
    add(jobs, "a", "b")
    claimed(jobs)
    for job_id in "ab":
        jobs.forget(job_id)
        with pytest.raises(VectorTalkerError, match="not known"):
            jobs.get(job_id)
    assert jobs.of_portrait("p") == ["a"] and jobs.wish("a", "w") == "stop"
    jobs.release("a", "w")
    assert jobs.of_portrait("p") == []


def test_room_is_limited_in_all_and_for_each_client(jobs: Jobs) -> None:
    add(jobs, "a", "b")
    add(jobs, "c", client="eve")
    jobs.check_room("eve", 4, 2)
    with pytest.raises(VectorTalkerError, match="You have 2 jobs"):
        jobs.check_room("ada", 4, 2)
    with pytest.raises(VectorTalkerError, match="3 jobs are waiting; the limit is 3"):
        jobs.check_room("eve", 3, 2)
    jobs.cancel("a")
    jobs.check_room("ada", 4, 2)


def test_estimate_follows_what_jobs_took(jobs: Jobs, clock: Clock) -> None:
    """Jobs of 4 s: two ahead of it and itself, by one worker, make 12 s; by two workers 8 s."""
    add(jobs, "a", "b", "c", "d")
    claimed(jobs)
    clock.seconds += 4
    jobs.report("a", "w", phase="done")
    jobs.release("a", "w")
    assert jobs.get("d").estimate_s == pytest.approx(12)
    jobs.enlist("v")
    assert jobs.get("d").estimate_s == pytest.approx(8)


def test_store_changes_all_or_nothing(store: Store) -> None:
    assert store.commit(Change({"x": None}, {"x": "1", "y": "2"}, {("list", "m"): 5.0}))
    assert not store.commit(Change({"x": None}, {"x": "3"}, {("list", "n"): 1.0}))
    assert store.read(["y", "x", "z"]) == ["2", "1", None]
    assert store.members("list") == ["m"] and store.count("list", below=5.0) == 0
    assert store.commit(Change({"x": "1"}, {"x": None}, {("list", "m"): None, ("list", "n"): 1.0}))
    assert store.read(["x"]) == [None] and store.members("list", below=2.0, limit=1) == ["n"]


def test_store_numbers_are_given_once(store: Store) -> None:
    given: list[int] = []
    at_once(4, lambda _: given.extend(store.count_up("n") for _ in range(25)))
    assert sorted(given) == list(range(1, 101)) and store.number("n") == 100
