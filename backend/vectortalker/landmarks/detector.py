"""A window of a picture becomes face boxes with eye positions (BlazeFace, short range)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.special import expit

from vectortalker import models
from vectortalker.landmarks.window import Window, sample

INPUT_SIDE = 128
BLEND_THRESHOLD = 0.2  # lowest score that enters a blended box; the reference chain's value
SAME_FACE_IOU = 0.3
ROI_SCALE = 1.5  # the mesh sees the box enlarged by this factor
LEFT_EYE, RIGHT_EYE = 2, 3  # rows of the raw box: centre, size, then six key points


@dataclass(frozen=True)
class FaceBox:
    """`roi`: upright square for the mesh; `eyes`: [2, 2] picture pixels, image-left first; `score` 0..1."""

    score: float
    roi: Window
    eyes: NDArray[np.float64]


def find_faces(image: NDArray[np.uint8], window: Window) -> list[FaceBox]:
    """Faces of a square window, best first."""
    pixels = sample(image, window, INPUT_SIDE, extend_border=False) * np.float32(2 / 255) - 1
    outputs = models.run("face_detection_short_range", pixels)
    raw = next(output for output in outputs if output.shape[-1] == 16)[0]
    logits = next(output for output in outputs if output.shape[-1] == 1)[0, :, 0]
    scores = expit(np.float64(logits))
    kept = np.flatnonzero(scores >= BLEND_THRESHOLD)
    boxes = np.float64(raw[kept]).reshape(-1, 8, 2) / INPUT_SIDE
    anchors = _anchors()[kept]
    boxes[:, 0] += anchors
    boxes[:, 2:] += anchors[:, None]
    return [_face_box(score, box, window) for score, box in _blend(scores[kept], boxes)]


def _anchors() -> NDArray[np.float64]:
    """[896, 2] centres: a 16x16 grid with two anchors a cell, then 8x8 with six."""
    grids = []
    for n_cells, per_cell in ((16, 2), (8, 6)):
        centres = (np.arange(n_cells) + 0.5) / n_cells
        grid = np.stack(np.meshgrid(centres, centres), axis=-1).reshape(-1, 2)
        grids.append(np.repeat(grid, per_cell, axis=0))
    return np.concatenate(grids)


def _blend(scores: NDArray[np.float64], boxes: NDArray[np.float64]) -> list[tuple[float, NDArray[np.float64]]]:
    """Weighted non-maximum suppression: overlapping boxes become their mean weighted by score."""
    order = np.argsort(-scores, kind="stable")
    blended = []
    while order.size:
        best = order[0]
        same = np.array([i == best or _iou(boxes[i], boxes[best]) > SAME_FACE_IOU for i in order])
        group, order = order[same], order[~same]
        mean = np.tensordot(scores[group], boxes[group], axes=1) / scores[group].sum()
        blended.append((float(scores[best]), mean))
    return blended


def _iou(a: NDArray[np.float64], b: NDArray[np.float64]) -> float:
    low = np.maximum(a[0] - a[1] / 2, b[0] - b[1] / 2)
    high = np.minimum(a[0] + a[1] / 2, b[0] + b[1] / 2)
    overlap = np.clip(high - low, 0, None).prod()
    return float(overlap / (a[1].prod() + b[1].prod() - overlap))


def _face_box(score: float, box: NDArray[np.float64], window: Window) -> FaceBox:
    """Window units to picture pixels. The roi is square, and turned so that the eyes are level."""
    centre = window.to_picture(box[0])
    eyes = window.to_picture(box[[LEFT_EYE, RIGHT_EYE]])
    side = float(ROI_SCALE * box[1].max() * window.width)
    dx, dy = eyes[1] - eyes[0]
    roi = Window(float(centre[0]), float(centre[1]), side, side, float(np.arctan2(dy, dx)))
    return FaceBox(score, roi, eyes)
