"""Tracks: from edited visemes, from files of other programs, and into such files. Answered at once."""

from __future__ import annotations

import anyio
from anyio import to_thread
from fastapi import APIRouter, Response, UploadFile

from vectortalker import schema, tracks
from vectortalker.server.portraits import display_name

router = APIRouter(prefix="/api/tracks", tags=["tracks"])

FORMING = anyio.CapacityLimiter(2)  # an hour's landmarks keep a core busy for seconds
MEDIA_TYPES: dict[tracks.Format, str] = {
    "json": "application/json",
    "rhubarb-json": "application/json",
    "rhubarb-tsv": "text/tab-separated-values",
    "csv": "text/csv",
}


@router.post("/visemes", response_model_exclude_none=True)
async def form_visemes(request: schema.VisemeTrackRequest) -> schema.Track:
    """The track of edited blocks; milliseconds for a clip of seconds."""
    return await to_thread.run_sync(_formed, request, limiter=FORMING)


def _formed(request: schema.VisemeTrackRequest) -> schema.Track:
    from vectortalker.speech.request import track_of_visemes

    return track_of_visemes(request)


@router.post("/import", response_model_exclude_none=True)
async def import_track(file: UploadFile) -> schema.Track:
    """Track JSON, Rhubarb JSON or TSV, or raw 68-point CSV, told apart by content."""
    data = await file.read()
    name = display_name(file.filename or "", "track")
    return await to_thread.run_sync(tracks.read_track, data, name, limiter=FORMING)


@router.post(
    "/export",
    response_class=Response,
    responses={200: {"content": {kind: {} for kind in sorted(set(MEDIA_TYPES.values()))}}},
)
async def export_track(request: schema.TrackExportRequest) -> Response:
    """A file to save."""
    text = await to_thread.run_sync(tracks.write_track, request.track, request.format, limiter=FORMING)
    headers = {"Content-Disposition": f'attachment; filename="track{tracks.ENDINGS[request.format]}"'}
    return Response(text, media_type=MEDIA_TYPES[request.format], headers=headers)
