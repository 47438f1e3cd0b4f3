"""The portrait's layers become the sheets of a level: the paper's four losses with their weights and claims."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter, grey_dilation

from vectortalker.vectorize.level import BACK, FIRST_LOCAL, FORE, TOP, Level, Sheet
from vectortalker.vectorize.losses import SCENERY_SCALE
from vectortalker.vectorize.resize import resize

HIDDEN_WEIGHT = 0.15  # of what another layer hides at rest: it shows only when the head or a lid moves
EMPHASIS = 2.0  # weight of eyes and mouth: they move, and people look there
EMPHASIS_MARGIN = 0.3  # of a feature's width around its landmarks
EDGE_MARGIN = 0.012  # of the long side: fore paths may reach this far over the silhouette
FEATURES = (range(36, 42), range(42, 48), range(48, 68))  # iBUG: image-left eye, image-right eye, mouth


@dataclass(frozen=True)
class LayerImages:
    """The layers at the working size. f32: `back`, `fore`, `local` [H, W, 3] completed where others hide them.

    `mask` [H, W]: share of the person; `clips` [3, H, W]: coverage of the openings; `emphasis` [H, W] ≥ 1: weight of
    the error; `parts` i64 [H, W]: group of a local path seeded there.
    """

    back: NDArray[np.float32]
    fore: NDArray[np.float32]
    mask: NDArray[np.float32]
    clips: NDArray[np.float32]
    emphasis: NDArray[np.float32]
    parts: NDArray[np.int64]


def layered_level(
    images: LayerImages,
    smoothed: NDArray[np.float32],
    openings: tuple[NDArray[np.float64], ...],
    canvas: NDArray[np.float32],
) -> Level:
    """Sheets for the smoothed picture f32 [h, w, 3] of one level; `openings` in its px."""
    frame = (smoothed.shape[1], smoothed.shape[0])
    mask, emphasis = resize(images.mask, frame), resize(images.emphasis, frame)
    clips = np.ascontiguousarray(resize(images.clips.transpose(1, 2, 0), frame).transpose(2, 0, 1))
    opening = clips.sum(axis=0).clip(0, 1) if len(clips) else np.zeros_like(mask)
    scenery = 1 - mask
    back = _blend(resize(images.back, frame), smoothed, scenery)
    fore = _blend(resize(images.fore, frame), smoothed, 1 - opening)
    back_weight = (scenery + HIDDEN_WEIGHT * mask).astype(np.float32)
    fore_weight = (mask * emphasis * (1 - (1 - HIDDEN_WEIGHT) * opening)).astype(np.float32)
    groups = np.zeros(mask.shape, np.int64)
    sheets = (
        Sheet(FORE, back, back_weight, back_weight, groups + BACK),
        Sheet(FIRST_LOCAL, fore, fore_weight, fore_weight, groups + FORE),
        Sheet(TOP, smoothed, emphasis, opening * emphasis, _nearest(images.parts, frame)),
    )
    return Level(sheets, openings, clips, _untouchable(mask, frame), canvas)


def emphasise(shape: tuple[int, int], landmarks: NDArray[np.float64]) -> NDArray[np.float32]:
    """Weight [H, W] of the error: `EMPHASIS` over eyes and mouth, falling to 1; `landmarks` [68, 2] in its px."""
    y, x = np.mgrid[: shape[0], : shape[1]].astype(np.float32)
    weight = np.ones(shape, np.float32)
    for feature in FEATURES:
        points = landmarks[list(feature)]
        low, high = points.min(axis=0), points.max(axis=0)
        middle, half = (low + high) / 2, (high - low) / 2 + EMPHASIS_MARGIN * (high[0] - low[0])
        inside = ((x + 0.5 - middle[0]) / half[0]) ** 2 + ((y + 0.5 - middle[1]) / half[1]) ** 2
        weight = np.maximum(weight, 1 + (EMPHASIS - 1) * np.clip(2 * (1 - inside), 0, 1))
    return weight.astype(np.float32)


def _blend(under: NDArray[np.float32], over: NDArray[np.float32], share: NDArray[np.float32]) -> NDArray[np.float32]:
    return under + share[..., None] * (over - under)


def _nearest(parts: NDArray[np.int64], frame: tuple[int, int]) -> NDArray[np.int64]:
    rows = (np.arange(frame[1]) + 0.5) * parts.shape[0] / frame[1]
    columns = (np.arange(frame[0]) + 0.5) * parts.shape[1] / frame[0]
    return parts[rows.astype(int)[:, None], columns.astype(int)]


def _untouchable(mask: NDArray[np.float32], frame: tuple[int, int]) -> NDArray[np.float32]:
    """Scenery [h, w] at `SCENERY_SCALE`, farther from the person than `EDGE_MARGIN`."""
    margin = max(1, round(EDGE_MARGIN * max(frame)))
    widened = grey_dilation(mask, size=(2 * margin + 1, 2 * margin + 1))
    quarter = (max(1, round(frame[0] * SCENERY_SCALE)), max(1, round(frame[1] * SCENERY_SCALE)))
    soft = gaussian_filter(widened, 1).clip(0, 1)
    return (1 - resize(soft, quarter)).astype(np.float32)
