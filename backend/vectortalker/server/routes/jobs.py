"""Jobs: start, watch, take the scene, finish early, cancel."""

from __future__ import annotations

from collections.abc import AsyncIterator
from typing import Annotated

from fastapi import APIRouter, Depends, Header, Response
from fastapi.sse import EventSourceResponse, ServerSentEvent

from vectortalker import schema
from vectortalker.server.events import event_id, snapshots, unseen
from vectortalker.server.routes.access import Client, Has, Id, job_file
from vectortalker.server.run import folder
from vectortalker.server.submit import submit_portrait

router = APIRouter(prefix="/api/jobs", tags=["jobs"])

SEEN = {"description": "The last snapshot was seen: do not come back"}


@router.post("", status_code=202)
def start_job(request: schema.JobRequest, has: Has, client: Client) -> schema.JobState:
    """A job that is done at once if the same was made before."""
    return submit_portrait(has, client, request)


@router.get("/{job_id}")
def get_job(job_id: Id, has: Has) -> schema.JobState:
    return has.jobs.get(job_id)


def _first_snapshot(
    job_id: Id, has: Has, last_event_id: Annotated[str | None, Header()] = None
) -> schema.JobState | None:
    return unseen(has.jobs, job_id, last_event_id)


@router.get("/{job_id}/events", response_class=EventSourceResponse, responses={204: SEEN})
async def watch_job(
    job_id: Id, has: Has, first: Annotated[schema.JobState | None, Depends(_first_snapshot)]
) -> AsyncIterator[ServerSentEvent]:
    """Whole `JobState` snapshots, the newest at once; ends after the last one. The event id names the snapshot."""
    async for state in snapshots(has.jobs, job_id, first):
        yield ServerSentEvent(data=state, id=event_id(state))


@router.get("/{job_id}/scene", response_class=Response, responses={200: {"model": schema.Scene}})
def get_scene(job_id: Id, has: Has) -> Response:
    """The latest scene. Not found until the first one is there (`scene_revision` 0)."""
    data = job_file(has, job_id, "scene.json", "There is no scene yet: wait for the first level.")
    return Response(data, media_type="application/json")


@router.get("/{job_id}/svg", response_class=Response, responses={200: {"content": {"image/svg+xml": {}}}})
def get_svg(job_id: Id, has: Has) -> Response:
    """The layered SVG. Not found until the job is done."""
    data = job_file(has, job_id, "portrait.svg", "There is no SVG yet: wait for the job to be done.")
    headers = {"Content-Disposition": 'attachment; filename="portrait.svg"'}
    return Response(data, media_type="image/svg+xml", headers=headers)


@router.post("/{job_id}/finish", status_code=202)
def finish_job(job_id: Id, has: Has) -> schema.JobState:
    """Good enough: the job ends as done with what it has."""
    return has.jobs.finish(job_id)


@router.delete("/{job_id}")
def cancel_job(job_id: Id, has: Has) -> schema.JobState:
    """Stops the work; the worker that does not stop by itself is killed. Of a job that has ended the files go."""
    state = has.jobs.cancel(job_id)
    if state.phase != "cancelled":  # else its worker removes what it may be writing
        has.blobs.delete_folder(folder(job_id))
    return state
