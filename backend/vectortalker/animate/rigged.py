"""Turns a scene, its rest landmarks and poses into the points of frames."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import vectortalker_core as core
from numpy.typing import NDArray

from vectortalker import tracks
from vectortalker.animate.drawing import Drawing, Points, drawing_of
from vectortalker.errors import VectorTalkerError
from vectortalker.rig import Rig, build_rig
from vectortalker.schema import Landmarks, LinearFill, Scene, Track

Vertices = NDArray[np.float64]  # [V, 2], or [frames, V, 2] over time


@dataclass(frozen=True)
class RiggedScene:
    """A rig with the drawing that its frames fill. `axes` [2n, 2]: both gradient ends of each path, zeros if solid."""

    rig: Rig
    drawing: Drawing
    axes: Points
    rest: Points  # the frame of the rest pose, [N, 2]


def rig_scene(scene: Scene, landmarks: Landmarks, *, split: bool = True, smooth: bool = True) -> RiggedScene:
    """`split=False` is the paper's ablation, `smooth` repairs kinks. A face without extent raises `bad_landmarks`."""
    try:
        rig = build_rig(scene, landmarks, split=split, smooth=smooth)
    except ValueError as error:
        raise VectorTalkerError("bad_landmarks", f"{error}. Correct the landmarks in the editor.") from error
    paths = rig.frame_points(rig.rest_vertices)
    openings = rig.openings(rig.rest_vertices)
    drawing = drawing_of(scene, [len(path) for path in paths], [len(opening) for opening in openings])
    axes = np.zeros((2 * len(paths), 2))
    for path, fill in enumerate(drawing.fills):
        if isinstance(fill, LinearFill):
            axes[2 * path : 2 * path + 2] = fill.start, fill.end
    rest = np.concatenate([*paths, *openings, axes[np.repeat(drawing.linear, 2)]])
    return RiggedScene(rig, drawing, axes, rest)


def frame_points(rigged: RiggedScene, vertices: Vertices) -> Points:
    """Points [N, 2] of one frame for posed `vertices` [V, 2]."""
    drawing, rig = rigged.drawing, rigged.rig.core_rig
    points = rigged.rest.copy()
    changed, starts, moved = rig.frame(vertices)
    for path, start, end in zip(changed, starts, starts[1:], strict=False):
        points[drawing.bounds[path] : drawing.bounds[path + 1]] = moved[start:end]
    n_paths = len(drawing.fills)
    points[drawing.bounds[n_paths] : drawing.bounds[-1]] = np.concatenate(rig.openings(vertices))
    axes = rigged.axes.reshape(n_paths, 2, 2).copy()
    axes[changed] = core.follow_gradients(rig, changed, starts, moved, rigged.axes).reshape(-1, 2, 2)
    points[drawing.bounds[-1] :] = axes[drawing.linear].reshape(-1, 2)
    return points


def vertices_at(rigged: RiggedScene, track: Track, times: NDArray[np.float64]) -> Vertices:
    """Vertices [frames, V, 2] at `times` (seconds) of the track."""
    return np.stack([rigged.rig.vertices(tracks.sample(track, float(time))).vertices for time in times])
