"""Portraits, and the jobs that vectorise them: what is asked for, how it goes, and what came of it."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from vectortalker.errors import ErrorCode
from vectortalker.schema.face import Landmarks
from vectortalker.schema.wire import Unit, Wire


class Portrait(Wire):
    id: str
    name: str
    width: int
    height: int
    notices: list[str]  # what was normalised, one sentence each ("First of 4 frames used.")


Preset = Literal["draft", "standard", "fine"]
Recipe = Literal["best", "paper", "diffvg"]


class VectorizeOptions(Wire):
    """Options of `vectortalker vectorize`; None means: what the preset says."""

    preset: Preset = "standard"
    recipe: Recipe = "best"
    paths: Annotated[int, Field(ge=8, le=4000)] | None = None
    segments: Annotated[int, Field(ge=3, le=32)] = 8
    levels: Annotated[int, Field(ge=1, le=8)] | None = None
    iterations: Annotated[int, Field(ge=1, le=5000)] | None = None
    final_iterations: Annotated[int, Field(ge=1, le=20000)] | None = None
    seed: Annotated[int, Field(ge=0)] = 0
    working_size: Annotated[int, Field(ge=64, le=2048)] | None = None
    fills: Literal["solid", "gradient"] | None = None
    opacity: Literal["free", "opaque"] = "free"
    layers: bool = True


class JobRequest(Wire):
    """Landmarks None: no face; the picture becomes back and fore only as far as segmentation finds a person.

    `find_face`: without landmarks, the largest face that is detected.
    """

    portrait_id: str
    landmarks: Landmarks | None = None
    find_face: bool = False
    options: VectorizeOptions = VectorizeOptions()


JobPhase = Literal["queued", "running", "done", "failed", "cancelled"]


class Metrics(Wire):
    """Scores of a resvg rendering of the written SVG against the canonical image (docs/benchmarks.md)."""

    paths: int
    segments: int
    parameters: int
    iterations: int
    seconds: float
    cpu_seconds: float
    bytes: int
    gzip_bytes: int
    mse: float
    psnr: float
    ssim: float


class ApiError(Wire):
    """What the server answers instead of a value; `message` is one sentence for the user."""

    code: ErrorCode
    message: str


class JobState(Wire):
    """Whole snapshot of a job, the only thing SSE ever sends. `revision` grows with each that is stored.

    `scene_revision` names the latest scene at `/api/jobs/{id}/scene`; 0: none yet. `estimate_s`: seconds until the job
    is done, its wait included, going by recent jobs of its kind.
    """

    id: str
    revision: int
    phase: JobPhase
    stage: str  # "smoothing", "level 2 of 5", …
    level: int
    levels: int
    n_paths: int
    progress: Unit
    elapsed_seconds: float
    remaining_seconds: float | None
    queue_position: int | None
    estimate_s: float | None = None
    scene_revision: int
    metrics: Metrics | None = None
    error: ApiError | None = None
