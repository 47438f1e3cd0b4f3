"""Poses, tracks of them, and the project that a `.vtalk` file holds."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import ConfigDict, Field, FiniteFloat, model_validator

from vectortalker.schema.face import N_LANDMARKS, Landmarks
from vectortalker.schema.scene import Scene
from vectortalker.schema.wire import OffsetXy, Wire

FRAME_COUNT_TOLERANCE = 1.5  # rounded durations, and one frame at the end or not
Articulation = Annotated[FiniteFloat, Field(ge=-360, le=360)]  # head turns are in degrees, all else within -1…1


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
