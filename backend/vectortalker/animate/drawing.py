"""Turns a scene into a drawing: what every frame of an animation shares, beside the control points that move.

A frame is one flat array of points: the control points of all paths in painter's order, then those of the three
openings, then the two ends of every linear gradient, both in the order of the paths they belong to.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from vectortalker.scene import OPENING_OF_PART, PARTS
from vectortalker.schema import Fill, HexColour, LinearFill, Scene

NO_OPENING = -1

Points = NDArray[np.float64]  # [N, 2], portrait pixels


@dataclass(frozen=True)
class Drawing:
    """Layers, fills and clips of `n` paths; `bounds` say where their and the openings' points lie in a frame."""

    width: float
    height: float
    canvas: HexColour
    n_back: int
    n_fore: int
    fills: tuple[Fill, ...]
    openings: NDArray[np.int64]  # [n] index into `scene.OPENINGS`, or `NO_OPENING`
    bounds: NDArray[np.int64]  # [n + 3 + 1] first point of each path and opening; the last is the first gradient end

    @property
    def layers(self) -> tuple[range, range, range]:
        """Paths of back, fore and local."""
        fore, local = self.n_back, self.n_back + self.n_fore
        return range(fore), range(fore, local), range(local, len(self.fills))

    @property
    def linear(self) -> NDArray[np.bool_]:
        """Which paths have a gradient, [n]."""
        return np.array([isinstance(fill, LinearFill) for fill in self.fills], bool)

    @property
    def n_points(self) -> int:
        """Points of one frame."""
        return int(self.bounds[-1]) + 2 * int(self.linear.sum())


def drawing_of(scene: Scene, path_sizes: Sequence[int], opening_sizes: Sequence[int]) -> Drawing:
    """Drawing of `scene` whose paths have `path_sizes` [n] points (more than in the scene if split), openings [3]."""
    paths = [*scene.back, *scene.fore, *scene.local]
    unclipped = len(scene.back) + len(scene.fore)
    parts = [PARTS.index(path.part) for path in scene.local]
    return Drawing(
        width=scene.width,
        height=scene.height,
        canvas=scene.canvas,
        n_back=len(scene.back),
        n_fore=len(scene.fore),
        fills=tuple(path.fill for path in paths),
        openings=np.array([NO_OPENING] * unclipped + [int(OPENING_OF_PART[part]) for part in parts], np.int64),
        bounds=np.concatenate(([0], np.cumsum([*path_sizes, *opening_sizes]))).astype(np.int64),
    )


def scene_points(scene: Scene, openings: Sequence[Points]) -> Points:
    """The scene as it lies, unsplit, as one frame [N, 2]; `openings` are the outlines [k, 2] of `scene.OPENINGS`."""
    paths = [*scene.back, *scene.fore, *scene.local]
    rows = [np.reshape(np.asarray(path.points, np.float64), (-1, 2)) for path in paths]
    ends = [np.array([path.fill.start, path.fill.end]) for path in paths if isinstance(path.fill, LinearFill)]
    return np.concatenate([*rows, *openings, *ends])
