"""Turns a track of articulators into one of landmark offsets, by posing the neutral face."""

from __future__ import annotations

import numpy as np

from vectortalker.schema import N_LANDMARKS, Pose, Track
from vectortalker.tracks.neutral import neutral_eye_distance, neutral_rig

DECIMALS = 5


def as_landmarks(track: Track) -> Track:
    """The same track, its articulators given as offsets of 68 landmarks in units of the outer-eye distance."""
    rig = neutral_rig()
    channels = track.articulators or {}
    frames = zip(*channels.values(), strict=True)
    posed = [rig.vertices(Pose(articulators=dict(zip(channels, values, strict=True)))).vertices for values in frames]
    moved = np.array(posed)[:, :N_LANDMARKS] - rig.rest_vertices[:N_LANDMARKS]
    offsets = (moved / neutral_eye_distance()).round(DECIMALS)
    return Track.model_validate(track.model_dump() | {"articulators": None, "landmarks": offsets.tolist()})
