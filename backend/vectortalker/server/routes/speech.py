"""Speech: listen to a recording. Watched and cancelled like any job."""

from __future__ import annotations

from fastapi import APIRouter, Response

from vectortalker import schema
from vectortalker.errors import VectorTalkerError
from vectortalker.server import recordings
from vectortalker.server.routes.access import Client, Has, Id
from vectortalker.server.run import folder
from vectortalker.server.submit import submit

router = APIRouter(prefix="/api/speech", tags=["speech"])


@router.post("", status_code=202)
def start_speech(request: schema.SpeechRequest, has: Has, client: Client) -> schema.JobState:
    recordings.describe(has.blobs, request.recording_id)
    recordings.note_use(has.store, request.recording_id)
    return submit(has, client, "speech", request.recording_id, request)


@router.get("/{job_id}/result", response_class=Response, responses={200: {"model": schema.SpeechResult}})
def get_speech(job_id: Id, has: Has) -> Response:
    """Not found until the job is done."""
    has.jobs.get(job_id)
    data = has.blobs.find(f"{folder(job_id)}/speech.json")
    if data is None:
        raise VectorTalkerError("not_found", "The track is not ready yet: wait for its job to be done.")
    return Response(data, media_type="application/json")
