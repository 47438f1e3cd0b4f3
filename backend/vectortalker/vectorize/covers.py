"""Covers: paths that poses need and rest hides, so that they are made and not fitted.

Lids lie on top of the fore, under the eyeballs, which are fitted over them; the floor of a smile on top of the local
layer, outside its opening.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from vectortalker.interior import smile_floor
from vectortalker.lids import lids
from vectortalker.oklab import to_srgb
from vectortalker.patch import Patch
from vectortalker.scene import NO_PART, PARTS, STOPS, Layer, empty_layer
from vectortalker.schema import Landmarks
from vectortalker.vectorize.frame import Frame, layer_to_level
from vectortalker.vectorize.level import LID
from vectortalker.vectorize.population import Population, insert
from vectortalker.vectorize.starts import Start, through_samples

MOST_SHARE = 0.05  # of the path budget; a sketch of fewer paths has none to spare for what is hidden
UPPER_TEETH = PARTS.index("mouth_upper")


@dataclass(frozen=True)
class Covers:
    """Paths in portrait px for the top of the fore and of the local layer."""

    fore: Layer
    local: Layer

    def __len__(self) -> int:
        return len(self.fore) + len(self.local)


def no_covers(segments: int) -> Covers:
    return Covers(empty_layer(segments), empty_layer(segments))


def covers(landmarks: Landmarks, rgb: NDArray[np.uint8], budget: int, segments: int) -> Covers:
    """What the eyes and the mouth of `rgb` u8 [H, W, 3] need; nothing in a tiny budget."""
    floor = smile_floor(np.array(landmarks.points, np.float64), rgb)
    eyes = lids(landmarks, rgb)
    if len(floor) + len(eyes) > MOST_SHARE * budget:
        return no_covers(segments)
    return Covers(_layer(eyes, NO_PART, segments), _layer(floor, UPPER_TEETH, segments))


def with_lids(population: Population, lids: Layer, frame: Frame, level: tuple[int, int]) -> Population:
    """The population of a level of (width, height) px with `lids`, in portrait px, between fore and local."""
    placed = layer_to_level(lids, frame, level)
    starts = [Start(*arrays) for arrays in zip(placed.points, placed.stops, placed.axis, strict=True)]
    return insert(population, starts, np.full(len(lids), LID), lids.gradient)


def with_covers(layer: Layer, top: Layer) -> Layer:
    """`top` painted last."""
    return Layer(
        np.concatenate([layer.points, top.points]),
        np.concatenate([layer.stops, top.stops]),
        np.concatenate([layer.axis, top.axis]),
        np.concatenate([layer.gradient, top.gradient]),
        np.concatenate([layer.part, top.part]),
    )


def _layer(patches: list[Patch], part: int, segments: int) -> Layer:
    n = len(patches)
    if not n:
        return empty_layer(segments)
    colours = np.array([np.append(to_srgb(patch.lab), 1) for patch in patches], np.float32)
    stops = np.repeat(colours[:, None], STOPS, axis=1)
    fading = np.array([patch.fade is not None for patch in patches])
    stops[fading, :, 3] = np.linspace(0, 1, STOPS)
    axes = [np.zeros(4) if patch.fade is None else patch.fade.ravel() for patch in patches]
    outlines = [np.concatenate([patch.outline, patch.outline[:1]]) for patch in patches]
    return Layer(
        np.stack([through_samples(outline, segments) for outline in outlines]),
        stops,
        np.array(axes, np.float32),
        fading,
        np.full(n, part),
    )
