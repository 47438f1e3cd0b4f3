"""A scene and a track become a video file, for browsers that cannot encode one."""

from __future__ import annotations

import tempfile
from pathlib import Path

from vectortalker import animate, schema
from vectortalker.server.run import Run


def video_job(run: Run) -> None:
    """Raises `StoppedError` at the first frame after a cancel."""
    request = schema.VideoRequest.model_validate_json(run.services.blobs.get(run.key("request.json")))
    project = schema.Project(name="video", scene=request.scene, landmarks=request.landmarks)

    def report(fraction: float) -> None:
        run.wants_finish()
        run.report_fraction(fraction, stage="rendering frames")

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"video.{request.format}"
        animate.animate(project, request.track, path, animate.Options(fps=request.fps, size=request.size), report)
        run.services.blobs.put(run.key("video"), path.read_bytes())
    run.report(phase="done", stage="done", progress=1, remaining_seconds=0)
