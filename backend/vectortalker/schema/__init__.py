"""The one contract: every value that crosses the HTTP border or is stored in a project file.

The browser's types are generated from the OpenAPI document made of these models (`npm run gen`); a test checks for
drift.
All coordinates are portrait pixels (x, y), y down, unless a field says otherwise.
"""

from vectortalker.schema.face import N_LANDMARKS, Box, Face, Faces, Iris, Landmarks
from vectortalker.schema.job import (
    ApiError,
    JobPhase,
    JobRequest,
    JobState,
    Metrics,
    Portrait,
    Preset,
    Recipe,
    VectorizeOptions,
)
from vectortalker.schema.project import Articulation, Pose, Project, Track
from vectortalker.schema.scene import (
    Fill,
    LinearFill,
    LocalPath,
    Part,
    Scene,
    ScenePath,
    SolidFill,
    Stop,
)
from vectortalker.schema.service import Health, Limits, VideoRequest
from vectortalker.schema.speech import (
    Factor,
    Language,
    Recording,
    Seconds,
    Span,
    SpeechOptions,
    SpeechRequest,
    SpeechResult,
    SpokenRequest,
    TrackExportRequest,
    Viseme,
    VisemeBlock,
    VisemeBlocks,
    VisemeTrackRequest,
)
from vectortalker.schema.wire import SCHEMA_VERSION, Coordinate, HexColour, Offset, OffsetXy, Side, Unit, Wire, Xy

__all__ = [
    "N_LANDMARKS",
    "SCHEMA_VERSION",
    "ApiError",
    "Articulation",
    "Box",
    "Coordinate",
    "Face",
    "Faces",
    "Factor",
    "Fill",
    "Health",
    "HexColour",
    "Iris",
    "JobPhase",
    "JobRequest",
    "JobState",
    "Landmarks",
    "Language",
    "Limits",
    "LinearFill",
    "LocalPath",
    "Metrics",
    "Offset",
    "OffsetXy",
    "Part",
    "Portrait",
    "Pose",
    "Preset",
    "Project",
    "Recipe",
    "Recording",
    "Scene",
    "ScenePath",
    "Seconds",
    "Side",
    "SolidFill",
    "Span",
    "SpeechOptions",
    "SpeechRequest",
    "SpeechResult",
    "SpokenRequest",
    "Stop",
    "Track",
    "TrackExportRequest",
    "Unit",
    "VectorizeOptions",
    "VideoRequest",
    "Viseme",
    "VisemeBlock",
    "VisemeBlocks",
    "VisemeTrackRequest",
    "Wire",
    "Xy",
]
