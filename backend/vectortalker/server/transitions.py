"""What happens to a job, as functions from its record to the next: no store, no queue."""

from __future__ import annotations

import time
from dataclasses import replace

from vectortalker.errors import ErrorCode
from vectortalker.schema import ApiError, JobState
from vectortalker.server.record import ENDED, Record


def initial(job_id: str) -> JobState:
    return JobState(
        id=job_id,
        revision=1,
        phase="queued",
        stage="waiting",
        level=0,
        levels=0,
        n_paths=0,
        progress=0,
        elapsed_seconds=0,
        remaining_seconds=None,
        queue_position=None,
        scene_revision=0,
    )


def _next(job: Record, **fields: object) -> Record:
    """The job with `fields` over its snapshot as the next revision."""
    state = JobState.model_validate({**job.state.model_dump(), **fields, "revision": job.state.revision + 1})
    return replace(job, state=state)


def cancelled(job: Record) -> Record:
    if job.state.phase in ENDED:
        return job
    return _next(job, phase="cancelled", stage="cancelled", remaining_seconds=None)


def claimed(job: Record, worker: str) -> Record:
    if job.state.phase != "queued":
        return job
    started = _next(job, phase="running", stage="starting")
    return replace(started, holder=worker, started=time.time(), attempts=job.attempts + 1)


def reported(job: Record, worker: str, fields: dict[str, object]) -> Record:
    if job.state.phase != "running" or job.holder != worker:
        return job
    return _next(job, elapsed_seconds=round(time.time() - job.started, 2), **fields)


def let_go(job: Record) -> Record | None:
    return None if job.forgotten else replace(job, holder=None)


def failed(job: Record, code: ErrorCode, message: str) -> Record:
    error = ApiError(code=code, message=message)
    return _next(job, phase="failed", stage="failed", remaining_seconds=None, error=error)


def abandoned(job: Record, worker: str, max_attempts: int, by_intention: bool) -> Record | None:
    """`worker` is gone: what it held waits again, unless it was started `max_attempts` times."""
    if job.holder != worker:
        return job
    if job.state.phase != "running":
        return let_go(job)
    attempts = job.attempts - by_intention
    if attempts < max_attempts:
        again = _next(job, phase="queued", stage="waiting after its worker stopped", remaining_seconds=None)
        return replace(again, attempts=attempts, holder=None)
    message = f"It was broken off {attempts} times by the end of its worker or of the server: try other options."
    return replace(failed(job, "internal", message), holder=None)
