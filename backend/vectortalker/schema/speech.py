"""Recordings, what is heard in them, and the tracks that are formed of it."""

from __future__ import annotations

import itertools
from typing import Annotated, Literal, Self

from pydantic import AfterValidator, ConfigDict, Field, FiniteFloat, model_validator

from vectortalker.schema.project import Track
from vectortalker.schema.wire import Wire

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
