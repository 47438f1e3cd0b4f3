"""A track becomes a file of another program, or our own."""

from __future__ import annotations

from typing import Literal

import numpy as np
from pydantic import TypeAdapter, ValidationError

from vectortalker.errors import VectorTalkerError
from vectortalker.json_input import sentence
from vectortalker.schema import N_LANDMARKS, Track, VisemeBlock, VisemeBlocks
from vectortalker.tracks import points_csv, rhubarb
from vectortalker.tracks.neutral import neutral_rig
from vectortalker.tracks.sampling import sample

Format = Literal["json", "rhubarb-tsv", "rhubarb-json", "csv"]
ENDINGS: dict[Format, str] = {"json": ".json", "rhubarb-tsv": ".tsv", "rhubarb-json": ".json", "csv": ".csv"}
_VISEMES = TypeAdapter(VisemeBlocks)


def write_track(track: Track, kind: Format) -> str:
    """Track JSON, Rhubarb TSV or JSON of the track's `visemes`, or rows of 68 points of a face of average proportions.

    Raises `bad_track` for mouth cues of a track without visemes.
    """
    match kind:
        case "json":
            return track.model_dump_json(exclude_none=True) + "\n"
        case "csv":
            return points_csv.to_csv(_points(track), track.fps)
        case "rhubarb-tsv":
            return rhubarb.to_tsv(rhubarb.cues_of(_visemes(track), track.duration), track.duration)
        case "rhubarb-json":
            return rhubarb.to_json(rhubarb.cues_of(_visemes(track), track.duration), track.duration, track.name)


def _points(track: Track) -> points_csv.Points:
    """Pixels of the face that the track moves, by articulators, offsets or both."""
    rig = neutral_rig()
    poses = (sample(track, frame / track.fps) for frame in range(max(1, round(track.duration * track.fps))))
    return np.array([rig.vertices(pose).vertices[:N_LANDMARKS] for pose in poses])


def _visemes(track: Track) -> list[VisemeBlock]:
    given = (track.model_extra or {}).get("visemes")
    if given is None:
        raise _bad(f"{track.name} has no visemes to make mouth cues of: export it as JSON or CSV.")
    try:
        return _VISEMES.validate_python(given)
    except ValidationError as error:
        raise _bad(f"The visemes of {track.name} are not valid: {sentence(error)}") from error


def _bad(message: str) -> VectorTalkerError:
    return VectorTalkerError("bad_track", message)
