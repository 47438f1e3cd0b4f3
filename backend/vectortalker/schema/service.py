"""What else the server does, and what it says of itself."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, FiniteFloat

from vectortalker.schema.face import Landmarks
from vectortalker.schema.project import Track
from vectortalker.schema.scene import Scene
from vectortalker.schema.wire import Wire


class VideoRequest(Wire):
    """Server rendering of a track, for browsers that cannot encode H.264."""

    scene: Scene
    landmarks: Landmarks
    track: Track
    fps: Annotated[FiniteFloat, Field(ge=1, le=60)] = 25
    size: Annotated[int, Field(ge=64, le=2048)] = 512
    format: Literal["mp4", "webm", "gif"] = "mp4"


class Limits(Wire):
    """What the server allows, for clients that want to know before they are refused."""

    body_bytes: int  # of a request
    queued_jobs: int
    active_jobs: int  # of one client
    retention_hours: float  # after which unused portraits and jobs are deleted


class Health(Wire):
    """`workers` counts the worker processes that have loaded everything, `queued` and `running` the jobs."""

    version: str
    workers: int
    queued: int
    running: int
    store: Literal["sqlite", "redis"]
    free_bytes: int | None  # of the disk for blobs; an object store does not say
    limits: Limits
