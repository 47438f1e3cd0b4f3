"""Speech: listen to a recording. Watched and cancelled like any job."""

from __future__ import annotations

from fastapi import APIRouter, Response

from vectortalker import schema
from vectortalker.server import kept, recordings
from vectortalker.server.routes.access import Client, Has, Id, job_file
from vectortalker.server.submit import submit

router = APIRouter(prefix="/api/speech", tags=["speech"])


@router.post("", status_code=202)
def start_speech(request: schema.SpeechRequest, has: Has, client: Client) -> schema.JobState:
    recordings.describe(has.blobs, request.recording_id)
    kept.note_use(has.store, "recordings", request.recording_id)
    return submit(has, client, "speech", request.recording_id, request)


@router.get("/{job_id}/result", response_class=Response, responses={200: {"model": schema.SpeechResult}})
def get_speech(job_id: Id, has: Has) -> Response:
    """Not found until the job is done."""
    data = job_file(has, job_id, "speech.json", "The track is not ready yet: wait for its job to be done.")
    return Response(data, media_type="application/json")
