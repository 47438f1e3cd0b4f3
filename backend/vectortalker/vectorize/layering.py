"""The portrait's layers become the sheets of a level: the paper's four losses with their weights and claims."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import vectortalker_core as core
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt, maximum_filter, minimum_filter

from vectortalker.inpaint import fill
from vectortalker.interior import MOST_SMILE_GAPE, MOUTH
from vectortalker.irises import CORE, light_part, radius_map, seen_iris
from vectortalker.landmarks.ibug import IrisDisc
from vectortalker.layers import LayerTargets, targets
from vectortalker.vectorize.level import BACK, FIRST_LOCAL, FORE, LID, TOP, Completion, Level, Sheet, Silhouette
from vectortalker.vectorize.losses import SILHOUETTE_SCALE
from vectortalker.vectorize.resize import resize

FIRST_IRIS = FIRST_LOCAL + 2  # group of the image-left iris
LEAST_COVERAGE = 1e-3  # a quarter of a level of 255
CONFINEMENT = 0.5  # weight of fore paint over scenery, against 1 for a squared error of the picture
WHOLENESS = 0.3  # weight of the fore layer alone inside its silhouette
HIDDEN_WEIGHT = 0.15  # of what another layer hides at rest: it shows only when the head or a lid moves
BALL_WEIGHT = 1.0  # of the eyeball under its iris: every glance shows it, and irises get no holes that it fills at rest
LID_WEIGHT = 0.5  # of skin under the openings: every blink shows it …
UNSETTLED_WEIGHT = 0.05  # … but where it begins, an edge of paths would be spent on what hardly shows
SETTLED_DEPTH = 3.0  # px behind the first whole one of an opening from which skin has its whole weight
SEEN_AGAIN = 2.0  # weight of the merged error within openings, as fore and back have their own sheets besides
EMPHASIS = 2.0  # weight of eyes and mouth: they move, and people look there
LOCAL_SHARE = 0.05  # of all paths lie within eyes and open mouth, at least
LOCAL_RADIUS = 0.12  # of the square root of the openings' area: a third of an eye's height
LEAST_OPENING = 4.0  # px
EMPHASIS_MARGIN = 0.3  # of a feature's width around its landmarks
EDGE_MARGIN = 0.012  # of the long side: fore paths may reach this far over the silhouette
FIRST_PART = (0, 1, 4)  # part of a path seeded in the left eye's, right eye's and mouth's opening
IRIS_PART = (2, 3)
LOWER_TEETH, UPPER_TEETH = 5, 7
LEAST_TEETH_CONTRAST = 0.25  # of lightness within an open mouth; below it no teeth are told from the rest
MOST_TEETH_CHROMA = 0.35  # largest minus least channel: lips and tongue have more
FEATURES = (range(36, 42), range(42, 48), range(48, 68))  # iBUG: image-left eye, image-right eye, mouth


@dataclass(frozen=True)
class LayerImages:
    """The layers at the working size.

    `layers`: their completed pictures. `ball` f32 [H, W, 3]: eyeballs without irises. f32 [H, W]: `mask`, share of the
    person; `discs`, share of the irises; `emphasis` ≥ 1, weight of the error. `clips` f32 [3, H, W]: coverage of the
    openings. `parts` i64 [H, W]: group of a local path seeded there.
    """

    layers: LayerTargets
    ball: NDArray[np.float32]
    mask: NDArray[np.float32]
    discs: NDArray[np.float32]
    emphasis: NDArray[np.float32]
    clips: NDArray[np.float32]
    parts: NDArray[np.int64]


def layer_images(
    image: NDArray[np.float32],
    mask: NDArray[np.float32],
    landmarks: NDArray[np.float64] | None,
    irises: tuple[IrisDisc, ...],
    outlines: tuple[NDArray[np.float64], ...],
) -> LayerImages:
    """Layers of the working picture f32 [H, W, 3]; landmarks [68, 2], irises and outlines of its face in its px."""
    height, width = mask.shape
    clips = np.zeros((len(outlines), height, width), np.float32)
    parts = np.full(mask.shape, FIRST_LOCAL, np.int64)
    discs = np.zeros(mask.shape, np.float32)
    for index, outline in enumerate(outlines):
        if len(outline):
            coverage = core.coverage(outline.astype(np.float32), width, height)
            # A closed mouth's outline runs back over itself; what rounding leaves of it would move the paths it hides.
            clips[index] = np.where(coverage > LEAST_COVERAGE, coverage, 0)
        parts[clips[index] > 0] = FIRST_LOCAL + FIRST_PART[index]
    seen = [seen_iris(image, clips[eye], iris) for eye, iris in enumerate(irises)]
    for eye, iris in enumerate(seen):
        inside = (radius_map(iris, mask.shape) < 1) & (clips[eye] > 0)
        parts[inside] = FIRST_LOCAL + IRIS_PART[eye]
        discs[inside] = 1
    if len(clips) > MOUTH:
        _divide_mouth(parts, image, clips[MOUTH])
    face_height = None if landmarks is None else float(np.ptp(landmarks[:, 1]))
    layers = targets(image, mask, clips, seen, face_height)
    ball = image
    if len(clips):
        white = np.logical_or(*(light_part(image, clip > CORE) for clip in clips[:2])) & (discs == 0)
        ball = fill(layers.local, white.astype(np.float32))
    emphasis = np.ones(mask.shape, np.float32) if landmarks is None else emphasise(mask.shape, landmarks)
    return LayerImages(layers, ball, mask, discs, emphasis, clips, parts)


def _divide_mouth(parts: NDArray[np.int64], image: NDArray[np.float32], clip: NDArray[np.float32]) -> None:
    """Say what of an open mouth goes with the skull and what with the jaw.

    A smile shows upper teeth: all that is seen in it stays with the skull as one, and the jaw drops away from it. In a
    wider mouth what is light and grey goes with the jaw below its middle and with the skull above.
    """
    inside = clip > CORE
    if not inside.any():
        return
    if np.ptp(np.flatnonzero(inside.any(axis=1))) < MOST_SMILE_GAPE * np.ptp(np.flatnonzero(inside.any(axis=0))):
        parts[clip > 0] = FIRST_LOCAL + UPPER_TEETH
        return
    lightness, chroma = image.mean(axis=2), np.ptp(image, axis=2)
    dark, light = np.percentile(lightness[inside], (10, 90))
    if light - dark < LEAST_TEETH_CONTRAST:
        return
    teeth = inside & (lightness > (dark + light) / 2) & (chroma < MOST_TEETH_CHROMA)
    rows = np.arange(len(inside))[:, None]
    middle = np.flatnonzero(inside.any(axis=1)).mean()
    parts[teeth & (rows < middle)] = FIRST_LOCAL + UPPER_TEETH
    parts[teeth & (rows >= middle)] = FIRST_LOCAL + LOWER_TEETH


def layered_level(
    images: LayerImages,
    smoothed: NDArray[np.float32],
    openings: tuple[NDArray[np.float64], ...],
    canvas: NDArray[np.float32],
) -> Level:
    """Sheets for the smoothed picture f32 [h, w, 3] of one level; `openings` in its px."""
    frame = (smoothed.shape[1], smoothed.shape[0])
    mask, emphasis, discs = (resize(part, frame) for part in (images.mask, images.emphasis, images.discs))
    clips = np.ascontiguousarray(resize(images.clips.transpose(1, 2, 0), frame).transpose(2, 0, 1))
    clips[clips <= LEAST_COVERAGE] = 0
    opening = clips.sum(axis=0).clip(0, 1)
    scenery = 1 - mask
    back = _blend(resize(images.layers.back, frame), smoothed, scenery)
    lid, lid_weight = _lids(clips)
    completed = resize(images.layers.fore, frame)
    fore = _blend(completed, smoothed, mask * (1 - lid))
    behind_local = _blend(completed, smoothed, 1 - lid)  # back and fore together: the picture, whose the pixel may be
    back_weight = scenery + HIDDEN_WEIGHT * mask
    fore_weight = mask * emphasis * lid_weight
    merged_weight = emphasis * np.where(opening > 0, SEEN_AGAIN * opening**2, 1)
    groups = np.zeros(mask.shape, np.int64)
    sheets = (
        _sheet(FORE, back, back_weight, back_weight, groups + BACK),
        _sheet(LID, behind_local, fore_weight, fore_weight, groups + FORE),
        _sheet(FIRST_IRIS, resize(images.ball, frame), BALL_WEIGHT * discs * opening, 0 * mask, groups + FIRST_LOCAL),
        _sheet(TOP, smoothed, merged_weight, opening * emphasis, _nearest(images.parts, frame), *_local_quota(opening)),
    )
    completion = _completion(images, frame) if opening.any() else None
    whole = (clips > 0).astype(np.float32)
    return Level(sheets, openings, whole, opening, _silhouette(fore, mask, frame), completion, canvas)


def _lids(clips: NDArray[np.float32]) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Share f32 [h, w] of skin in what fore paints under openings of coverage [k, h, w], and the weight of its error.

    A pixel that an opening's edge covers by α shows (1 − α)·fore + α·local: both have the picture itself for target
    there, so that their mixture is the picture whatever α, and the squares of their shares for weight.
    """
    lid, weight = np.zeros(clips.shape[1:], np.float32), np.ones(clips.shape[1:], np.float32)
    for clip in clips:
        edge, whole = (clip > 0) & (clip <= CORE), clip > CORE
        weight[edge] *= (1 - clip[edge]) ** 2
        depth = np.asarray(distance_transform_edt(whole), np.float32)
        settled = np.clip((depth[whole] - 1) / SETTLED_DEPTH, UNSETTLED_WEIGHT, 1)
        lid[whole], weight[whole] = 1, LID_WEIGHT * settled
    return lid, weight


def _sheet(
    below: int,
    target: NDArray[np.float32],
    weight: NDArray[np.floating],
    claim: NDArray[np.floating],
    owner: NDArray[np.int64],
    quota: float = 0.0,
    most_radius: float = np.inf,
) -> Sheet:
    target = np.ascontiguousarray(target)
    return Sheet(below, target, weight.astype(np.float32), claim.astype(np.float32), owner, quota, most_radius)


def _completion(images: LayerImages, frame: tuple[int, int]) -> Completion | None:
    """Local picture on the smallest crop that holds its extent; None if that is too small to be seen in the frame."""
    extent = resize(images.layers.local_extent, frame)
    if not extent.any():
        return None
    rows, columns = np.flatnonzero(extent.any(axis=1)), np.flatnonzero(extent.any(axis=0))
    crop = (slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1))
    target, inside = resize(images.layers.local, frame)[crop], extent[crop]
    weight = (HIDDEN_WEIGHT * inside).astype(np.float32)
    return Completion(int(columns[0]), int(rows[0]), np.ascontiguousarray(target), np.ascontiguousarray(inside), weight)


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
        weight = np.maximum(weight, (1 + (EMPHASIS - 1) * np.clip(2 * (1 - inside), 0, 1)).astype(np.float32))
    return weight


def _blend(under: NDArray[np.float32], over: NDArray[np.float32], share: NDArray[np.float32]) -> NDArray[np.float32]:
    return np.asarray(under + share[..., None] * (over - under), np.float32)


def _nearest(parts: NDArray[np.int64], frame: tuple[int, int]) -> NDArray[np.int64]:
    rows = (np.arange(frame[1]) + 0.5) * parts.shape[0] / frame[1]
    columns = (np.arange(frame[0]) + 0.5) * parts.shape[1] / frame[0]
    return parts[rows.astype(int)[:, None], columns.astype(int)]


def _silhouette(fore: NDArray[np.float32], mask: NDArray[np.float32], frame: tuple[int, int]) -> Silhouette:
    """Fore alone, with a rim of `EDGE_MARGIN` on both sides of the person's edge left to the merged picture."""
    margin = 2 * max(1, round(EDGE_MARGIN * max(frame))) + 1
    size = (max(1, round(frame[0] * SILHOUETTE_SCALE)), max(1, round(frame[1] * SILHOUETTE_SCALE)))
    shrunk = np.asarray(minimum_filter(mask, size=margin), np.float32)
    grown = np.asarray(maximum_filter(mask, size=margin), np.float32)
    inside, outside = resize(shrunk, size) > CORE, resize(grown, size) < 1 - CORE
    return Silhouette(
        np.ascontiguousarray(resize(fore, size)),
        np.where(inside, np.float32(WHOLENESS), np.float32(0)),
        np.where(outside, np.float32(CONFINEMENT), np.float32(0)),
    )
