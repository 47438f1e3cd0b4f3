"""Turns a track of articulators into one of landmark offsets, by posing a face of average proportions."""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import NDArray

from vectortalker.rig import Rig, build_rig, fit_pins
from vectortalker.schema import N_LANDMARKS, Landmarks, Pose, Scene, Track

PINS = ((200.0, 240.0), (312.0, 240.0), (256.0, 305.0), (212.0, 365.0), (300.0, 365.0))  # eyes, nose tip, mouth corners
SIDE = 512.0
OUTER_EYES = (36, 45)
INNER_LIPS = ((61, 67), (62, 66), (63, 65))  # upper and lower points
MEETING = 0.35  # where the lips of the neutral face meet, from the upper to the lower
DECIMALS = 5


def as_landmarks(track: Track) -> Track:
    """The same track, its articulators given as offsets of 68 landmarks in units of the outer-eye distance."""
    rig = _canonical_rig()
    rest, scale = rig.rest_vertices[:N_LANDMARKS], _eye_distance(rig)
    channels = track.articulators or {}
    frames = zip(*channels.values(), strict=True)
    posed = [rig.vertices(Pose(articulators=dict(zip(channels, values, strict=True)))).vertices for values in frames]
    offsets = ((np.array(posed)[:, :N_LANDMARKS] - rest) / scale).round(DECIMALS)
    return Track.model_validate(track.model_dump() | {"articulators": None, "landmarks": offsets.tolist()})


def rest_landmarks() -> NDArray[np.float64]:
    """Landmarks [68, 2] of the neutral face, in units of its outer-eye distance."""
    rig = _canonical_rig()
    return rig.rest_vertices[:N_LANDMARKS] / _eye_distance(rig)


def _eye_distance(rig: Rig) -> float:
    left, right = rig.rest_vertices[list(OUTER_EYES)]
    return float(np.linalg.norm(right - left))


@cache
def _canonical_rig() -> Rig:
    landmarks = fit_pins(PINS)
    assert landmarks is not None, "the canonical pins are apart"
    points = np.array(landmarks.points)
    for upper, lower in INNER_LIPS:
        points[[upper, lower]] = points[upper] + MEETING * (points[lower] - points[upper])
    neutral = Landmarks(points=points.tolist(), irises=landmarks.irises)
    return build_rig(Scene(width=SIDE, height=SIDE, canvas="#ffffff", back=[], fore=[], local=[]), neutral)
