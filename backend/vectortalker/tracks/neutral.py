"""The face of average proportions, with closed lips and open eyes, that tracks without a portrait are shown on."""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import NDArray

from vectortalker.rig import Rig, build_rig, fit_pins
from vectortalker.schema import N_LANDMARKS, Landmarks, Scene

PINS = ((200.0, 240.0), (312.0, 240.0), (256.0, 305.0), (212.0, 365.0), (300.0, 365.0))  # eyes, nose tip, mouth corners
SIDE = 512.0
OUTER_EYES = (36, 45)
INNER_LIPS = ((61, 67), (62, 66), (63, 65))  # upper and lower points
MEETING = 0.35  # where the lips of the neutral face meet, from the upper to the lower


@cache
def neutral_rig() -> Rig:
    """Its rig, with nothing drawn on it, in pixels of a square of SIDE."""
    landmarks = fit_pins(PINS)
    assert landmarks is not None, "the canonical pins are apart"
    points = np.array(landmarks.points)
    for upper, lower in INNER_LIPS:
        points[[upper, lower]] = points[upper] + MEETING * (points[lower] - points[upper])
    neutral = Landmarks(points=points.tolist(), irises=landmarks.irises)
    return build_rig(Scene(width=SIDE, height=SIDE, canvas="#ffffff", back=[], fore=[], local=[]), neutral)


def neutral_landmarks() -> NDArray[np.float64]:
    """Its landmarks [68, 2] in units of its outer-eye distance."""
    return neutral_rig().rest_vertices[:N_LANDMARKS] / neutral_eye_distance()


def neutral_eye_distance() -> float:
    """Pixels between its outer eye corners."""
    left, right = neutral_rig().rest_vertices[list(OUTER_EYES)]
    return float(np.linalg.norm(right - left))
