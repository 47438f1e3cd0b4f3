"""The portrait's layers become the sheets of a level: the paper's four losses with their weights and claims."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import vectortalker_core as core
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter, grey_dilation

from vectortalker.vectorize.level import BACK, FIRST_LOCAL, FORE, TOP, Level, Sheet
from vectortalker.vectorize.losses import SCENERY_SCALE
from vectortalker.vectorize.resize import resize

HIDDEN_WEIGHT = 0.15  # of what another layer hides at rest: it shows only when the head or a lid moves
EMPHASIS = 2.0  # weight of eyes and mouth: they move, and people look there
LOCAL_SHARE = 0.05  # of all paths lie within eyes and open mouth, at least
LOCAL_RADIUS = 0.12  # of the square root of the openings' area: a third of an eye's height
LEAST_OPENING = 4.0  # px
EMPHASIS_MARGIN = 0.3  # of a feature's width around its landmarks
EDGE_MARGIN = 0.012  # of the long side: fore paths may reach this far over the silhouette
FIRST_PART = (0, 1, 4)  # part of a path seeded in the left eye's, right eye's and mouth's opening
IRIS_PART = (2, 3)
FEATURES = (range(36, 42), range(42, 48), range(48, 68))  # iBUG: image-left eye, image-right eye, mouth


@dataclass(frozen=True)
class LayerImages:
    """The layers at the working size. f32: `back` and `fore` [H, W, 3], completed where others hide them.

    `mask` [H, W]: share of the person; `clips` [3, H, W]: coverage of the openings; `emphasis` [H, W] ≥ 1: weight of
    the error; `parts` i64 [H, W]: group of a local path seeded there.
    """

    back: NDArray[np.float32]
    fore: NDArray[np.float32]
    mask: NDArray[np.float32]
    clips: NDArray[np.float32]
    emphasis: NDArray[np.float32]
    parts: NDArray[np.int64]


def layer_images(
    image: NDArray[np.float32],
    mask: NDArray[np.float32],
    landmarks: NDArray[np.float64] | None,
    irises: tuple[tuple[NDArray[np.float64], float], ...],
    outlines: tuple[NDArray[np.float64], ...],
) -> LayerImages:
    """Layers of the working picture f32 [H, W, 3]; landmarks [68, 2], irises and outlines of its face in its px."""
    height, width = mask.shape
    clips = np.zeros((len(outlines), height, width), np.float32)
    parts = np.full(mask.shape, FIRST_LOCAL, np.int64)
    y, x = np.mgrid[:height, :width] + 0.5
    for opening, outline in enumerate(outlines):
        if len(outline):
            clips[opening] = core.coverage(outline.astype(np.float32), width, height)
        parts[clips[opening] > 0] = FIRST_LOCAL + FIRST_PART[opening]
    for eye, (centre, radius) in enumerate(irises):
        parts[((x - centre[0]) ** 2 + (y - centre[1]) ** 2 < radius**2) & (clips[eye] > 0)] = (
            FIRST_LOCAL + IRIS_PART[eye]
        )
    opening = clips.sum(axis=0)
    emphasis = np.ones(mask.shape, np.float32) if landmarks is None else emphasise(mask.shape, landmarks)
    return LayerImages(_inpaint(image, mask), _inpaint(image, opening), mask, clips, emphasis, parts)


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
        Sheet(TOP, smoothed, emphasis, opening * emphasis, _nearest(images.parts, frame), *_local_quota(opening)),
    )
    return Level(sheets, openings, clips, _untouchable(mask, frame), canvas)


def _local_quota(opening: NDArray[np.float32]) -> tuple[float, float]:
    """Share and largest radius of paths within openings [h, w]: an eye is too small to be found among large peaks."""
    area = float(opening.sum())
    if area < LEAST_OPENING:
        return 0.0, np.inf
    return LOCAL_SHARE, LOCAL_RADIUS * area**0.5


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


def _inpaint(image: NDArray[np.float32], hidden: NDArray[np.float32]) -> NDArray[np.float32]:
    """Smooth continuation of `image` [H, W, 3] under `hidden` [H, W]: known colours averaged over growing windows."""
    known = (grey_dilation(hidden, size=(7, 7)) < 0.02).astype(np.float32)
    filled, weight = image * known[..., None], known
    result, done = filled.copy(), known > 0
    sigma = 2.0
    while not done.all() and sigma < 2 * max(hidden.shape):
        share = gaussian_filter(weight, sigma)
        colour = gaussian_filter(filled, (sigma, sigma, 0))
        reached = ~done & (share > 0.02)
        result[reached] = (colour[reached] / share[reached][:, None]).clip(0, 1)
        done |= reached
        sigma *= 2
    return result
