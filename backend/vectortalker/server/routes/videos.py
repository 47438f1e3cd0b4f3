"""Videos rendered by the server, for browsers without an encoder; watched and cancelled like any job."""

from __future__ import annotations

from fastapi import APIRouter, Response

from vectortalker import schema
from vectortalker.server.routes.access import Client, Has, Id, job_file
from vectortalker.server.run import folder
from vectortalker.server.submit import submit

router = APIRouter(prefix="/api/videos", tags=["videos"])

MEDIA_TYPES = {"mp4": "video/mp4", "webm": "video/webm", "gif": "image/gif"}


@router.post("", status_code=202)
def start_video(request: schema.VideoRequest, has: Has, client: Client) -> schema.JobState:
    return submit(has, client, "video", None, request)


@router.get(
    "/{job_id}/file", response_class=Response, responses={200: {"content": {kind: {} for kind in MEDIA_TYPES.values()}}}
)
def get_video(job_id: Id, has: Has) -> Response:
    """Not found until the job is done."""
    data = job_file(has, job_id, "video", "The video is not ready yet: wait for its job to be done.")
    request = schema.VideoRequest.model_validate_json(has.blobs.get(f"{folder(job_id)}/request.json"))
    headers = {"Content-Disposition": f'attachment; filename="video.{request.format}"'}
    return Response(data, media_type=MEDIA_TYPES[request.format], headers=headers)
