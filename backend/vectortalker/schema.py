"""The one contract: every value that crosses the HTTP border or is stored in a project file.

The browser's types are generated from the OpenAPI document made of these models (`npm run gen`); a test checks for
drift.
All coordinates are portrait pixels (x, y), y down, unless a field says otherwise.
"""

from __future__ import annotations

import itertools
from typing import Annotated, Literal, Self

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, FiniteFloat, model_validator

from vectortalker.errors import ErrorCode

SCHEMA_VERSION = 1
N_LANDMARKS = 68  # iBUG order
NUMBERS_PER_SEGMENT = 6  # anchor, handle, handle
FRAME_COUNT_TOLERANCE = 1.5  # rounded durations, and one frame at the end or not

Unit = Annotated[FiniteFloat, Field(ge=0, le=1)]
Coordinate = Annotated[FiniteFloat, Field(ge=-1e6, le=1e6)]  # far beyond any portrait, and no product overflows
Xy = tuple[Coordinate, Coordinate]
Side = Annotated[FiniteFloat, Field(gt=0, le=65536)]
Offset = Annotated[FiniteFloat, Field(ge=-100, le=100)]  # units of the outer-eye distance
OffsetXy = tuple[Offset, Offset]
Articulation = Annotated[FiniteFloat, Field(ge=-360, le=360)]  # head turns are in degrees, all else within -1…1
HexColour = Annotated[str, Field(pattern=r"^#[0-9a-f]{6}$")]
Part = Literal[
    "left_eye", "right_eye", "left_iris", "right_iris", "mouth_cavity", "mouth_lower", "tongue", "mouth_upper"
]


class Wire(BaseModel):
    """Base of all wire models: immutable, unknown fields refused."""

    model_config = ConfigDict(frozen=True, extra="forbid")


# ---------------------------------------------------------------- scene


class SolidFill(Wire):
    kind: Literal["solid"] = "solid"
    colour: HexColour
    opacity: Unit = 1.0


class Stop(Wire):
    colour: HexColour
    opacity: Unit = 1.0


class LinearFill(Wire):
    """Two-stop linear gradient from `start` to `end`, padded, unpremultiplied sRGB."""

    kind: Literal["linear"] = "linear"
    start: Xy
    end: Xy
    stops: tuple[Stop, Stop]


Fill = Annotated[SolidFill | LinearFill, Field(discriminator="kind")]


def _whole_segments(points: list[float]) -> list[float]:
    if len(points) % NUMBERS_PER_SEGMENT:
        raise ValueError(f"{len(points)} numbers are no whole number of segments of {NUMBERS_PER_SEGMENT}")
    return points


class ScenePath(Wire):
    """Closed chain of cubics: flat x, y of `anchor, handle, handle` a segment; the last ends at the first anchor."""

    points: Annotated[list[Coordinate], Field(min_length=12), AfterValidator(_whole_segments)]
    fill: Fill


class LocalPath(ScenePath):
    part: Part


class Scene(Wire):
    """Layered portrait in painter's order. `canvas` fills the whole frame beneath `back`."""

    width: Side
    height: Side
    canvas: HexColour
    back: list[ScenePath]
    fore: list[ScenePath]
    local: list[LocalPath]


# ---------------------------------------------------------------- landmarks


class Iris(Wire):
    centre: Xy
    radius: Side


class Landmarks(Wire):
    """68 iBUG points; irises image-left first; `depth` towards the viewer in units of the outer-eye distance."""

    points: Annotated[list[Xy], Field(min_length=N_LANDMARKS, max_length=N_LANDMARKS)]
    irises: tuple[Iris, Iris] | None = None
    depth: Annotated[list[Offset], Field(min_length=N_LANDMARKS, max_length=N_LANDMARKS)] | None = None


class Box(Wire):
    x: FiniteFloat
    y: FiniteFloat
    width: FiniteFloat
    height: FiniteFloat


class Face(Wire):
    box: Box
    landmarks: Landmarks
    confidence: Unit
    fit_advised: bool  # the fit is doubtful: ask the user to check it or to place the five pins


class Faces(Wire):
    """Detected faces, largest first. Empty: no face was found, the user fits five pins."""

    width: int
    height: int
    faces: list[Face]


# ---------------------------------------------------------------- portraits and jobs


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


# ---------------------------------------------------------------- poses, tracks, projects


class Pose(Wire):
    """Articulators and landmark offsets (units of the outer-eye distance, from rest); both add up."""

    articulators: dict[str, Articulation] = {}
    offsets: Annotated[list[OffsetXy], Field(min_length=N_LANDMARKS, max_length=N_LANDMARKS)] | None = None


class Track(Wire):
    """Poses over time. `landmarks`: offsets from a neutral face (closed lips, open eyes); either or both are given."""

    model_config = ConfigDict(frozen=True, extra="allow")

    schema_version: Literal[1] = 1
    name: str = "track"
    duration: Annotated[FiniteFloat, Field(gt=0, le=3600)]
    fps: Annotated[FiniteFloat, Field(gt=0, le=240)]
    landmarks: list[Annotated[list[OffsetXy], Field(min_length=N_LANDMARKS, max_length=N_LANDMARKS)]] | None = None
    articulators: dict[str, list[Articulation]] | None = None

    @model_validator(mode="after")
    def _fill_duration(self) -> Self:
        """Every channel has a frame every 1 / fps seconds, with or without one at the very end."""
        channels = {f"articulator {name}": len(values) for name, values in (self.articulators or {}).items()}
        if self.landmarks is not None:
            channels["landmarks"] = len(self.landmarks)
        if not channels:
            raise ValueError("a track needs landmarks or articulators")
        for name, frames in channels.items():
            if frames < 1 or abs(frames - self.duration * self.fps) > FRAME_COUNT_TOLERANCE:
                raise ValueError(
                    f"{name} has {frames} frames; {self.duration:g} s at {self.fps:g} frames a second"
                    f" need {round(self.duration * self.fps)}"
                )
        return self


class Project(Wire):
    """`project.json` of a `.vtalk` file. The source picture and the audio lie beside it in the zip."""

    schema_version: Literal[1] = 1
    name: str
    scene: Scene
    landmarks: Landmarks | None
    pose: Pose = Pose()
    tracks: list[Track] = []
    settings: dict[str, str | float | bool] = {}
    source: str | None = None  # file name inside the zip
    audio: str | None = None


# ---------------------------------------------------------------- speech

Seconds = Annotated[FiniteFloat, Field(ge=0, le=600)]
Factor = Annotated[FiniteFloat, Field(ge=0, le=4)]
Viseme = Literal["sil", "PP", "FF", "TH", "DD", "kk", "CH", "SS", "nn", "RR", "aa", "E", "I", "O", "U"]  # Oculus names
Language = Annotated[str, Field(max_length=40)]  # as espeak-ng names it: en, de, pt-br
OVERLAP_TOLERANCE = 0.002  # seconds: times are rounded to milliseconds


class VisemeBlock(Wire):
    """A viseme from `t` on for `d` seconds. `weight`: how far the jaw opens, 1 as the viseme does."""

    t: Seconds
    d: Annotated[FiniteFloat, Field(gt=0, le=600)]
    viseme: Viseme
    weight: Annotated[FiniteFloat, Field(ge=0, le=2)] = 1.0


def _in_order(blocks: list[VisemeBlock]) -> list[VisemeBlock]:
    for before, after in itertools.pairwise(blocks):
        if after.t < before.t + before.d - OVERLAP_TOLERANCE:
            raise ValueError(f"the block at {after.t:g} s begins before that at {before.t:g} s ends")
    return blocks


VisemeBlocks = Annotated[list[VisemeBlock], Field(max_length=20_000), AfterValidator(_in_order)]


class Recording(Wire):
    """A sound that was uploaded or spoken. `envelope`: its peak in 0…1, 50 a second."""

    id: str
    name: str
    duration: float  # seconds
    media_type: str
    envelope: list[float]


class SpokenRequest(Wire):
    """A text for espeak-ng to speak; `voice` is a variant such as f3, `pitch` 50 its usual one."""

    text: Annotated[str, Field(max_length=20_000)]
    language: Language = "en"
    voice: Annotated[str, Field(max_length=20)] = ""
    rate: Annotated[int, Field(ge=80, le=450)] = 160  # words a minute
    pitch: Annotated[int, Field(ge=0, le=99)] = 50


class SpeechOptions(Wire):
    """`language` is the transcript's. `gains` by channel or group (mouth, blink, head, brows); 0 mutes."""

    language: Language = "en"
    style: Literal["subtle", "normal", "cartoon"] = "normal"
    amplitude: Factor = 1.0
    smoothing: Factor = 1.0
    seed: Annotated[int, Field(ge=0)] = 0
    gains: dict[str, Factor] = {}


class Span(Wire):
    """Seconds from the beginning of a recording."""

    start: Seconds
    end: Seconds

    @model_validator(mode="after")
    def _is_forward(self) -> Self:
        if self.end <= self.start:
            raise ValueError(f"the part ends at {self.end:g} s, not after its start at {self.start:g} s")
        return self


class SpeechRequest(Wire):
    """Listen to a recording, with its transcript if there is one. With `part`: only to that, keeping the `visemes` that
    are given outside it; the transcript is then that of the part."""

    recording_id: str
    transcript: Annotated[str, Field(max_length=20_000)] | None = None
    options: SpeechOptions = SpeechOptions()
    part: Span | None = None
    visemes: VisemeBlocks | None = None

    @model_validator(mode="after")
    def _parts_go_with_visemes(self) -> Self:
        if (self.part is None) != (self.visemes is None):
            raise ValueError("part and visemes go together: those outside the part are kept")
        return self


class SpeechResult(Wire):
    """What was heard. `loudness` (nats, 50 a second) moves head and brows when the track is made anew."""

    track: Track
    visemes: list[VisemeBlock]
    loudness: list[float]
    tier: Literal["audio", "transcript"]


class VisemeTrackRequest(Wire):
    """Blocks, as heard or as edited, to be formed by a mouth. Without `loudness` the head does not nod."""

    model_config = ConfigDict(frozen=True, extra="forbid", validate_by_name=True, validate_by_alias=True)

    visemes: VisemeBlocks
    duration: Annotated[FiniteFloat, Field(ge=0.02, le=600)]
    loudness: Annotated[list[FiniteFloat], Field(max_length=30_000)] | None = None
    options: SpeechOptions = SpeechOptions()
    name: Annotated[str, Field(max_length=120)] = "speech"
    kind: Literal["articulators", "landmarks"] = Field(default="articulators", alias="as")


class TrackExportRequest(Wire):
    """A track for another program: mouth cues of Rhubarb from its `visemes`, or rows of 68 points of a neutral face."""

    track: Track
    format: Literal["json", "rhubarb-tsv", "rhubarb-json", "csv"]


# ---------------------------------------------------------------- server exports


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
