"""The jobs: the one place where the server's state lives.

A job goes queued → running → done | failed, and from either of the first two to cancelled. Each change stores a whole
`JobState` under the next revision. A worker *holds* the job it works on, also for the moment between a cancel and its
next step. Workers have leases that their supervisor renews; what a worker without a lease holds is queued again, by
whichever supervisor notices first.
"""

from __future__ import annotations

import random
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Literal

from vectortalker.errors import VectorTalkerError
from vectortalker.schema import JobState
from vectortalker.server import record as records
from vectortalker.server import transitions
from vectortalker.server.record import ENDED, HELD_CANCELLED, Kind, Record
from vectortalker.server.store import Change, Store

Wish = Literal["go_on", "finish", "stop"]  # what the user wants of a running job

LEASE_SECONDS = 10.0  # supervisors renew every second; one that died is noticed after this
ORPHAN_SECONDS = 5.0  # a queued job that the queue does not know is entered again after this
MAX_CONFLICTS = 100  # of one change with those of others; each time somebody else got on
CONFLICT_SECONDS = 0.005  # mean wait after one
EXPECTED_SECONDS = 30.0  # of a job before any of its kind was done
NEWEST_SHARE = 0.2  # of the last job in the running mean of durations
CLAIM_CANDIDATES = 8  # other workers may take the first few at the same moment

LEASES = "leases"  # index of workers by the end of their lease, epoch seconds
READY = "ready"  # index of workers that have loaded everything


@dataclass(frozen=True)
class Held:
    """A cancelled job whose worker has not let go of it."""

    job_id: str
    worker: str


class Jobs:
    """`max_attempts` starts of a job without a finished level between them, then it is set aside as failed."""

    def __init__(self, store: Store, max_attempts: int) -> None:
        self._store = store
        self._max_attempts = max_attempts

    # ------------------------------------------------------------ for the routes

    def check_room(self, client: str, max_queued: int, max_active: int) -> None:
        """Raises `queue_full`: too many jobs wait, or too many of this client wait or run."""
        queued = self.count("queued")
        if queued >= max_queued:
            raise VectorTalkerError(
                "queue_full", f"{queued} jobs are waiting; the limit is {max_queued}: try again in a few minutes."
            )
        active = self._store.count(records.active_index(client))
        if active >= max_active:
            raise VectorTalkerError(
                "queue_full", f"You have {active} jobs waiting or running; the limit is {max_active}: wait for one."
            )

    def create(self, job_id: str, kind: Kind, portrait_id: str | None, client: str) -> JobState:
        """A new queued job."""
        state = transitions.initial(job_id)
        sequence = self._store.count_up("jobs")
        self._insert(Record(job_id, kind, portrait_id, client, sequence, state, time.time()))
        return self.get(job_id)

    def create_done(self, job_id: str, kind: Kind, portrait_id: str | None, client: str, **fields: object) -> JobState:
        """A job whose result was known already."""
        ending = {"phase": "done", "stage": "done", "progress": 1, "remaining_seconds": 0, "revision": 1}
        state = JobState.model_validate({**transitions.initial(job_id).model_dump(), **ending, **fields})
        self._insert(Record(job_id, kind, portrait_id, client, self._store.count_up("jobs"), state, time.time()))
        return self.get(job_id)

    def get(self, job_id: str) -> JobState:
        """The latest snapshot. Raises `not_found`."""
        record = self._known(job_id)
        if record.state.phase == "running":
            return record.state.model_copy(update={"estimate_s": record.state.remaining_seconds})
        if record.state.phase != "queued":
            return record.state
        ahead = self._store.count(records.phase_index("queued"), below=record.sequence)
        computed = {"queue_position": ahead, "estimate_s": self._estimate(record.kind, ahead)}
        return record.state.model_copy(update=computed)

    def finish(self, job_id: str) -> JobState:
        """Ask a job to end with what it has, at its next step; a job that has ended stays as it is."""
        self._known(job_id)
        self._change(job_id, lambda job: replace(job, finish=True))
        return self.get(job_id)

    def cancel(self, job_id: str) -> JobState:
        """Cancelled from now on; the worker that holds it stops at its next step or is killed."""
        self._known(job_id)
        self._change(job_id, transitions.cancelled)
        return self.get(job_id)

    def ended_of(self, job_ids: list[str]) -> list[str]:
        """Those that have ended or are not known; one read, however many wait."""
        texts = self._store.read([records.document(job_id) for job_id in job_ids])
        return [
            job_id
            for job_id, text in zip(job_ids, texts, strict=True)
            if text is None or records.read(text).state.phase in ENDED
        ]

    def of_portrait(self, portrait_id: str) -> list[str]:
        return self._store.members(records.portrait_index(portrait_id))

    def forget(self, job_id: str) -> None:
        """Cancel a job and remove it; one that is held is gone for all but its worker, until that lets go."""
        self._change(job_id, lambda job: replace(transitions.cancelled(job), forgotten=True) if job.holder else None)

    def count(self, phase: str) -> int:
        return self._store.count(records.phase_index(phase))

    def ended(self, phase: str) -> int:
        """How many jobs have ever ended so."""
        return self._store.number(f"ended:{phase}")

    def ready_workers(self) -> int:
        expired = set(self._store.members(LEASES, below=time.time()))
        leased = set(self._store.members(LEASES)) - expired
        return len(leased & set(self._store.members(READY)))

    # ------------------------------------------------------------ for workers

    def enlist(self, worker: str) -> None:
        """The worker has loaded everything and waits for jobs."""
        lease = time.time() + LEASE_SECONDS
        self._store.commit(Change(ranks={(LEASES, worker): lease, (READY, worker): 0.0}))

    def claim(self, worker: str) -> Record | None:
        """Take the job that came first; None if nothing waits. The attempt is counted before it begins."""
        self.enlist(worker)  # so that no job is ever held without a lease
        held = self._store.members(records.holder_index(worker))  # an answer of the store was lost on the way
        for job_id in [*held, *self._store.members(records.phase_index("queued"), limit=CLAIM_CANDIDATES)]:
            taken = self._change(job_id, lambda job: transitions.claimed(job, worker))
            if taken is not None and taken.holder == worker and taken.state.phase == "running":
                return taken
        return None

    def wish(self, job_id: str, worker: str) -> Wish:
        record = self._find(job_id)
        if record is None or record.state.phase != "running" or record.holder != worker:
            return "stop"
        return "finish" if record.finish else "go_on"

    def is_unwanted(self, job_id: str) -> bool:
        """Cancelled or forgotten: nobody will ask for its files."""
        record = self._find(job_id)
        return record is None or record.forgotten or record.state.phase == "cancelled"

    def report(self, job_id: str, worker: str, **fields: object) -> None:
        """Store the next snapshot of a running job; nothing if it is no longer this worker's to run."""
        self._change(job_id, lambda job: transitions.reported(job, worker, fields))

    def got_on(self, job_id: str, worker: str) -> None:
        """A level was finished and stored: what happens from here on is no repetition."""
        self._change(job_id, lambda job: replace(job, attempts=1) if job.holder == worker else job)

    def release(self, job_id: str, worker: str) -> None:
        """Let go of a job, however it ended."""
        self._change(job_id, lambda job: transitions.let_go(job) if job.holder == worker else job)

    # ------------------------------------------------------------ for supervisors

    def renew(self, workers: list[str]) -> None:
        """The workers are alive: they and what they hold have another lease."""
        lease = time.time() + LEASE_SECONDS
        self._store.commit(Change(ranks={(LEASES, worker): lease for worker in workers}))

    def stubborn(self, seconds: float) -> list[Held]:
        """Jobs that were cancelled more than `seconds` ago and are still held."""
        found = [self._find(job_id) for job_id in self._store.members(HELD_CANCELLED, below=time.time() - seconds)]
        return [Held(record.id, record.holder) for record in found if record and record.holder]

    def dismiss(self, worker: str, *, by_intention: bool = False) -> list[str]:
        """The worker is gone; what it held is queued again, or fails if it was started too often.

        A worker that was ended `by_intention` is not the fault of its job: the attempt does not count. Returns what was
        queued.
        """
        held = self._store.members(records.holder_index(worker))
        changed = [
            self._change(job_id, lambda job: transitions.abandoned(job, worker, self._max_attempts, by_intention))
            for job_id in held
        ]
        self._store.commit(Change(ranks={(LEASES, worker): None, (READY, worker): None}))
        return [record.id for record in changed if record and record.state.phase == "queued"]

    def recover(self) -> list[str]:
        """Dismiss the workers whose lease has run out; what is queued again."""
        return [job_id for worker in self._store.members(LEASES, below=time.time()) for job_id in self.dismiss(worker)]

    def waiting(self, seconds: float) -> list[str]:
        """Jobs that are queued for longer than `seconds`, in their order."""
        since = time.time() - seconds
        found = [self._find(job_id) for job_id in self._store.members(records.phase_index("queued"))]
        return [record.id for record in found if record and record.changed < since]

    def fail_waiting(self, job_id: str, message: str) -> None:
        """Set a queued job aside."""
        self._change(
            job_id,
            lambda job: transitions.failed(job, "unavailable", message) if job.state.phase == "queued" else job,
        )

    def unchanged_since(self, epoch_seconds: float) -> list[str]:
        return self._store.members(records.ALL, below=epoch_seconds)

    # ------------------------------------------------------------ with the store

    def _find(self, job_id: str) -> Record | None:
        (text,) = self._store.read([records.document(job_id)])
        return records.read(text) if text is not None else None

    def _known(self, job_id: str) -> Record:
        record = self._find(job_id)
        if record is None or record.forgotten:
            raise VectorTalkerError("not_found", f"Job {job_id} is not known (any more): start it again.")
        return record

    def _insert(self, record: Record) -> None:
        inserted = self._store.commit(records.replacing(None, record))
        assert inserted, record.id

    def _change(self, job_id: str, transition: Callable[[Record], Record | None]) -> Record | None:
        """Apply `transition` to what is stored, again if others were quicker; None from it removes the job.

        Returns the job afterwards, None if there is none.
        """
        for _ in range(MAX_CONFLICTS):
            (text,) = self._store.read([records.document(job_id)])
            if text is None:
                return None
            before = records.read(text)
            after = transition(before)
            if after == before:
                return after
            if after is not None:
                after = replace(after, changed=time.time())
            if self._store.commit(records.replacing(text, after)):
                self._count_end(before, after)
                return after
            time.sleep(random.uniform(0, 2 * CONFLICT_SECONDS))
        raise VectorTalkerError("unavailable", f"Job {job_id} is being changed by too many at once: try again.")

    def _count_end(self, before: Record, after: Record | None) -> None:
        """Counters of ends, and the mean duration of what was done."""
        if after is None or after.state.phase == before.state.phase or after.state.phase not in ENDED:
            return
        self._store.count_up(f"ended:{after.state.phase}")
        if after.state.phase == "done":
            mean, last = self._mean_seconds(after.kind), after.state.elapsed_seconds
            mean = last if mean is None else mean + NEWEST_SHARE * (last - mean)
            self._store.commit(Change(values={_duration(after.kind): repr(mean)}))

    def _mean_seconds(self, kind: Kind) -> float | None:
        (text,) = self._store.read([_duration(kind)])
        return float(text) if text is not None else None

    def _estimate(self, kind: Kind, ahead: int) -> float:
        """Seconds until a queued job is done, if all took as long as recent ones of its kind."""
        rounds = (ahead + self.count("running")) // max(1, self.ready_workers()) + 1
        return round(rounds * (self._mean_seconds(kind) or EXPECTED_SECONDS), 1)


def _duration(kind: Kind) -> str:
    return f"mean_seconds:{kind}"
