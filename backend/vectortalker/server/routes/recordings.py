"""Recordings: upload, or have a text spoken; sound, deletion."""

from __future__ import annotations

import anyio
from anyio import to_thread
from fastapi import APIRouter, Response, UploadFile

from vectortalker import schema
from vectortalker.server import recordings
from vectortalker.server.removal import remove_recording
from vectortalker.server.routes.access import Has, Id

router = APIRouter(prefix="/api/recordings", tags=["speech"])

DECODING = anyio.CapacityLimiter(2)  # ten minutes take 80 MB while they are decoded


@router.post("", status_code=201)
async def add_recording(file: UploadFile, has: Has) -> schema.Recording:
    """Any sound of up to 10 minutes; it is decoded once, so a bad one is refused here."""
    data = await file.read()
    name = file.filename or ""
    return await to_thread.run_sync(recordings.add, has.store, has.blobs, data, name, limiter=DECODING)


@router.post("/spoken", status_code=201)
async def speak_text(request: schema.SpokenRequest, has: Has) -> schema.Recording:
    """A text spoken by espeak-ng; unsupported where that is not installed."""
    return await to_thread.run_sync(_spoken, request, has, limiter=DECODING)


def _spoken(request: schema.SpokenRequest, has: Has) -> schema.Recording:
    from vectortalker.speech.spoken import speak

    data = speak(request.text, request.language, request.voice, request.rate, request.pitch)
    return recordings.add(has.store, has.blobs, data, "spoken.wav")


@router.get("/{recording_id}")
def get_recording(recording_id: Id, has: Has) -> schema.Recording:
    return recordings.describe(has.blobs, recording_id)


@router.get("/{recording_id}/audio", response_class=Response, responses={200: {"content": {"audio/*": {}}}})
def get_audio(recording_id: Id, has: Has) -> Response:
    """The file as it came."""
    recording = recordings.describe(has.blobs, recording_id)
    headers = {"Cache-Control": "private, max-age=3600"}
    return Response(recordings.source(has.blobs, recording_id), media_type=recording.media_type, headers=headers)


@router.delete("/{recording_id}", status_code=204)
def delete_recording(recording_id: Id, has: Has) -> None:
    """What was heard in it goes with it; listening is stopped."""
    remove_recording(has, recording_id)
