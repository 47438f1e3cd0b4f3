"""A recording becomes viseme blocks and the track that forms them."""

from __future__ import annotations

import io

from vectortalker import schema
from vectortalker.server import recordings
from vectortalker.server.run import Run


def speech_job(run: Run) -> None:
    """Raises `StoppedError` between two pieces of the recording after a cancel."""
    from vectortalker.speech.request import answer

    request = schema.SpeechRequest.model_validate_json(run.services.blobs.get(run.key("request.json")))
    recording = recordings.describe(run.services.blobs, request.recording_id)

    def report(stage: str, fraction: float) -> None:
        run.wants_finish()
        run.report_fraction(fraction, stage=stage)

    result = answer(request, io.BytesIO(recordings.source(run.services.blobs, recording.id)), recording.name, report)
    run.services.blobs.put(run.key("speech.json"), result.model_dump_json(exclude_none=True).encode())
    run.report(phase="done", stage="done", progress=1, remaining_seconds=0)
