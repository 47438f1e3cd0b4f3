"""Mouth interior and eyeballs become the first local paths, under all that the optimiser adds."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from vectortalker.decode import Portrait
from vectortalker.interior import eyeballs, mouth_interior
from vectortalker.scene import Layer, from_wire
from vectortalker.schema import LocalPath, Scene
from vectortalker.vectorize.frame import Frame, to_frame
from vectortalker.vectorize.level import FIRST_LOCAL
from vectortalker.vectorize.population import Population, empty_population, insert
from vectortalker.vectorize.starts import Start, through_samples

MOST_SHARE = 0.25  # of the path budget; a sketch of fewer paths has none to spare for what is hidden
SAMPLES = 16  # a cubic, where the number of segments is another


def first_paths(
    portrait: Portrait,
    landmarks: NDArray[np.float64],
    frame: Frame,
    level: tuple[int, int],
    budget: int,
    segments: int,
) -> Population:
    """Solid paths in the px of the coarsest level (width, height); `landmarks` [68, 2] in portrait px.

    What a closed mouth hides has no gradient at rest and stays as it is made; eyeballs are fitted like other paths.
    """
    paths = [*eyeballs(landmarks, portrait.rgb), *mouth_interior(landmarks, portrait.rgb)]
    population = empty_population(segments)
    if not paths or len(paths) > MOST_SHARE * budget:
        return population
    layer = _arrays(paths, portrait)
    stretch = np.array(level) / (frame.width, frame.height)
    starts = []
    for points, stops in zip(layer.points, layer.stops, strict=True):
        placed = to_frame(resegment(points.astype(np.float64), segments), frame) * stretch
        low, high = placed.min(axis=0), placed.max(axis=0)
        starts.append(Start(placed.astype(np.float32), stops, np.append(low, high).astype(np.float32)))
    return insert(population, starts, FIRST_LOCAL + layer.part, gradient=False)


def resegment(points: NDArray[np.float64], segments: int) -> NDArray[np.float64]:
    """A closed chain of cubics [3k, 2] drawn with `segments` cubics; the same array if it has as many."""
    if len(points) == 3 * segments:
        return points
    t = (np.arange(SAMPLES) / SAMPLES)[:, None]
    quads = np.stack([np.roll(points, -k, axis=0)[::3] for k in range(4)])[:, :, None]  # [4, k, 1, 2]
    basis = ((1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3)
    outline = sum((weight * control for weight, control in zip(basis, quads, strict=True)), np.zeros(2)).reshape(-1, 2)
    return through_samples(np.concatenate([outline, outline[:1]]), segments).astype(np.float64)


def _arrays(paths: list[LocalPath], portrait: Portrait) -> Layer:
    scene = Scene(width=portrait.width, height=portrait.height, canvas="#000000", back=[], fore=[], local=paths)
    return from_wire(scene).local
