"""Recordings among the blobs: the file as it came, and its description. Kept and found as portraits are."""

from __future__ import annotations

import io
import secrets

import av
import numpy as np

from vectortalker import schema
from vectortalker.errors import VectorTalkerError
from vectortalker.server.blobs import Blobs
from vectortalker.server.kept import note_use
from vectortalker.server.portraits import display_name
from vectortalker.server.store import Store

ENVELOPE_FPS = 50
DECIMALS = 3
MEDIA_TYPES = {  # by the first name of FFmpeg's format
    "wav": "audio/wav", "mp3": "audio/mpeg", "ogg": "audio/ogg", "flac": "audio/flac", "mov": "audio/mp4",
    "matroska": "audio/webm", "aac": "audio/aac", "aiff": "audio/aiff",
}  # fmt: skip
OTHER_MEDIA = "application/octet-stream"


def add(store: Store, blobs: Blobs, data: bytes, filename: str) -> schema.Recording:
    """Decode once, and keep. Raises `bad_audio` or `storage_full`."""
    from vectortalker.speech.audio import RATE, mono_chunks  # loads onnxruntime, which the server need not wait for

    samples = np.concatenate([*mono_chunks(io.BytesIO(data))])
    recording = schema.Recording(
        id=secrets.token_hex(16),
        name=display_name(filename, "recording"),
        duration=round(len(samples) / RATE, DECIMALS),
        media_type=_media_type(data),
        envelope=_envelope(samples, round(RATE / ENVELOPE_FPS)),
    )
    note_use(store, "recordings", recording.id)
    blobs.put(_key(recording.id, "source"), data)
    blobs.put(_key(recording.id, "recording.json"), recording.model_dump_json().encode())
    return recording


def describe(blobs: Blobs, recording_id: str) -> schema.Recording:
    """Raises `not_found`."""
    data = blobs.find(_key(recording_id, "recording.json"))
    if data is None:
        raise VectorTalkerError("not_found", f"Recording {recording_id} is not known (any more): upload it again.")
    return schema.Recording.model_validate_json(data)


def source(blobs: Blobs, recording_id: str) -> bytes:
    """The file as it came. Raises `not_found`."""
    describe(blobs, recording_id)
    return blobs.get(_key(recording_id, "source"))


def _envelope(samples: np.ndarray, hop: int) -> list[float]:
    """Peak of every `hop` samples; the last may be fewer."""
    padded = np.pad(np.abs(samples), (0, -len(samples) % hop))
    return np.minimum(1, padded.reshape(-1, hop).max(axis=1)).astype(float).round(DECIMALS).tolist()


def _media_type(data: bytes) -> str:
    with av.open(io.BytesIO(data)) as container:
        return MEDIA_TYPES.get(container.format.name.partition(",")[0], OTHER_MEDIA)


def _key(recording_id: str, name: str) -> str:
    return f"recordings/{recording_id}/{name}"
