"""Builds the rig of a scene: the Rust core's rig for wire models, the same one the browser runs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import vectortalker_core as core
from numpy.typing import NDArray

from vectortalker.schema import Landmarks, Pose, Scene

Array = NDArray[np.float64]

_BACK, _FORE, _LOCAL = 0, 1, 2  # the core's layer numbers; part n of the local layer is _LOCAL + n
PARTS = ("left_eye", "right_eye", "left_iris", "right_iris", "mouth_cavity", "mouth_lower", "tongue", "mouth_upper")
CHANNELS: tuple[str, ...] = tuple(name for name, _, _ in core.channels())


@dataclass(frozen=True)
class Posed:
    """Vertices [V, 2] of a pose; `scale` < 1 where the motion was held back by `triangles` that would turn over."""

    vertices: Array
    scale: float
    triangles: list[int]


class Rig:
    """A rigged scene; path indices run through back, fore and local in painter's order."""

    def __init__(self, rig: core.Rig) -> None:
        self._rig = rig

    @property
    def core_rig(self) -> core.Rig:
        """The core's own rig, for writers that live in the core."""
        return self._rig

    @property
    def rest_vertices(self) -> Array:
        """Vertices [V, 2] at rest: 68 landmarks, two irises, then the rig's own."""
        return self._rig.rest_vertices

    @property
    def triangles(self) -> NDArray[np.uintp]:
        """Vertex indices [T, 3]."""
        return self._rig.triangles

    @property
    def n_paths(self) -> int:
        return self._rig.n_paths

    def vertices(self, pose: Pose) -> Posed:
        """Vertices of a pose. Channels that this version does not know are left out."""
        articulators = [pose.articulators.get(name, 0.0) for name in CHANNELS]
        offsets = None if pose.offsets is None else np.array(pose.offsets, dtype=np.float64)
        return Posed(*self._rig.vertices(articulators, offsets))

    def frame_points(self, vertices: Array) -> list[Array]:
        """Control points [3S, 2] of every path for these vertices; untouched paths are their rest points."""
        points = [self._rig.rest_path(index) for index in range(self.n_paths)]
        for index, moved in self.moved_points(vertices).items():
            points[index] = moved
        return points

    def moved_points(self, vertices: Array, since: Array | None = None) -> dict[int, Array]:
        """Control points of the paths that differ between `since` (rest when None) and `vertices`, by path index."""
        changed, starts, points = self._rig.frame(vertices, since)
        return {int(index): points[starts[k] : starts[k + 1]] for k, index in enumerate(changed)}

    def openings(self, vertices: Array) -> list[Array]:
        """Outlines [3S, 2] of left eye, right eye and mouth."""
        return self._rig.openings(vertices)


def build_rig(scene: Scene, landmarks: Landmarks, *, split: bool = True, smooth: bool = True) -> Rig:
    """Rig of a scene. `split=False` is the paper's ablation; `smooth` repairs kinks at triangle edges.

    Raises ValueError when the landmarks span no face.
    """
    paths = [*scene.back, *scene.fore, *scene.local]
    layers = [_BACK] * len(scene.back) + [_FORE] * len(scene.fore)
    layers += [_LOCAL + PARTS.index(path.part) for path in scene.local]
    points = [np.array(path.points, dtype=np.float64).reshape(-1, 2) for path in paths]
    rig = core.Rig(
        (scene.width, scene.height),
        np.concatenate(points) if points else np.zeros((0, 2)),
        [len(chain) // 3 for chain in points],
        layers,
        np.array(landmarks.points, dtype=np.float64),
        None if landmarks.irises is None else [[*iris.centre, iris.radius] for iris in landmarks.irises],
        landmarks.depth,
        split,
        smooth,
    )
    return Rig(rig)


def fit_pins(pins: Sequence[tuple[float, float]]) -> Landmarks | None:
    """Landmarks for five pins (eyes, nose tip, mouth corners, image-left first); None when the pins coincide."""
    fit = core.fit_pins(np.array(pins, dtype=np.float64))
    if fit is None:
        return None
    points, irises = fit
    return Landmarks.model_validate(
        {
            "points": points.tolist(),
            "irises": [{"centre": (x, y), "radius": radius} for x, y, radius in irises],
        }
    )
