"""A job's snapshots as they change, for Server-Sent Events."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator

from vectortalker.errors import VectorTalkerError
from vectortalker.schema import JobState
from vectortalker.server.faults import StreamEndedError
from vectortalker.server.jobs import ENDED, Jobs

POLL_SECONDS = 0.1  # one indexed read of one row, some 50 µs


def unseen(jobs: Jobs, job_id: str, last_event_id: str | None) -> JobState | None:
    """The newest snapshot; None if the client has seen it and there will be more.

    Raises `not_found`, and `StreamEndedError` if the client has seen the last one.
    """
    state = jobs.get(job_id)
    if last_event_id != str(state.revision):
        return state
    if state.phase in ENDED:
        raise StreamEndedError
    return None


async def snapshots(jobs: Jobs, job_id: str, first: JobState | None) -> AsyncIterator[JobState]:
    """`first`, then whatever is newest when it differs, until the job has ended or is forgotten."""
    state = first
    seen = -1
    while True:
        if state is not None and state.revision != seen:
            seen = state.revision
            yield state
        if state is not None and state.phase in ENDED:
            return
        await asyncio.sleep(POLL_SECONDS)
        try:
            state = jobs.get(job_id)
        except VectorTalkerError:
            return
