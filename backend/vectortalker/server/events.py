"""A job's snapshots as they change, for Server-Sent Events."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator

from anyio import to_thread

from vectortalker.errors import VectorTalkerError
from vectortalker.schema import JobState
from vectortalker.server.faults import StreamEndedError
from vectortalker.server.jobs import Jobs
from vectortalker.server.record import ENDED

POLL_SECONDS = 0.15  # one read of one document
QUEUE_POLL_SECONDS = 0.5  # nothing moves fast for those that wait, and there may be many


def unseen(jobs: Jobs, job_id: str, last_event_id: str | None) -> JobState | None:
    """The newest snapshot; None if the client has seen it and there will be more.

    Raises `not_found`, and `StreamEndedError` if the client has seen the last one.
    """
    state = jobs.get(job_id)
    if last_event_id != event_id(state):
        return state
    if state.phase in ENDED:
        raise StreamEndedError
    return None


def event_id(state: JobState) -> str:
    """Differs where a snapshot has news: a revision, or another place in the queue, which is not stored."""
    place = "" if state.queue_position is None else f".{state.queue_position}"
    return f"{state.revision}{place}"


async def snapshots(jobs: Jobs, job_id: str, first: JobState | None) -> AsyncIterator[JobState]:
    """`first`, then whatever is newest when it differs, until the job has ended or is forgotten."""
    state, seen = first, None
    while True:
        if state is not None and event_id(state) != seen:
            seen = event_id(state)
            yield state
        if state is not None and state.phase in ENDED:
            return
        await asyncio.sleep(QUEUE_POLL_SECONDS if state is None or state.phase == "queued" else POLL_SECONDS)
        try:
            state = await to_thread.run_sync(jobs.get, job_id)
        except VectorTalkerError as error:
            if error.code != "unavailable":  # an outage of the store is waited out
                return
