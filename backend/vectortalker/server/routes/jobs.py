"""Jobs: start, watch, take the scene, finish early, cancel."""

from __future__ import annotations

from collections.abc import AsyncIterator
from typing import Annotated

from fastapi import APIRouter, Depends, Header, Response
from fastapi.sse import EventSourceResponse, ServerSentEvent

from vectortalker import schema
from vectortalker.errors import VectorTalkerError
from vectortalker.server import portraits
from vectortalker.server.events import snapshots, unseen
from vectortalker.server.routes.access import Has, Id
from vectortalker.server.run import folder
from vectortalker.server.submit import submit

router = APIRouter(prefix="/api/jobs", tags=["jobs"])


@router.post("", status_code=202)
def start_job(request: schema.JobRequest, has: Has) -> schema.JobState:
    portraits.describe(has.blobs, request.portrait_id)
    return submit(has, "vectorize", request.portrait_id, request)


@router.get("/{job_id}")
def get_job(job_id: Id, has: Has) -> schema.JobState:
    return has.jobs.get(job_id)


def _first_snapshot(
    job_id: Id, has: Has, last_event_id: Annotated[str | None, Header()] = None
) -> schema.JobState | None:
    return unseen(has.jobs, job_id, last_event_id)


@router.get("/{job_id}/events", response_class=EventSourceResponse)
async def watch_job(
    job_id: Id, has: Has, first: Annotated[schema.JobState | None, Depends(_first_snapshot)]
) -> AsyncIterator[ServerSentEvent]:
    """Whole `JobState` snapshots, the newest at once; ends after the last one. The event id is the revision."""
    async for state in snapshots(has.jobs, job_id, first):
        yield ServerSentEvent(data=state, id=str(state.revision))


@router.get("/{job_id}/scene", response_class=Response, responses={200: {"model": schema.Scene}})
def get_scene(job_id: Id, has: Has) -> Response:
    """The latest scene. Not found until the first one is there (`scene_revision` 0)."""
    has.jobs.get(job_id)
    data = has.blobs.find(f"{folder(job_id)}/scene.json")
    if data is None:
        raise VectorTalkerError("not_found", "There is no scene yet: wait for the first level.")
    return Response(data, media_type="application/json")


@router.post("/{job_id}/finish", status_code=202)
def finish_job(job_id: Id, has: Has) -> schema.JobState:
    """Good enough: the job ends as done with what it has."""
    return has.jobs.finish(job_id)


@router.delete("/{job_id}")
def cancel_job(job_id: Id, has: Has) -> schema.JobState:
    """Stops the work; the worker that does not stop by itself is killed."""
    return has.jobs.cancel(job_id)
