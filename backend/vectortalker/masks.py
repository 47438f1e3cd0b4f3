"""A picture, with or without landmarks, becomes the mask of its foreground: the person.

Sources are asked in this order, and the first that fits and is sure is taken, else the surest that fits:

1. the picture's own transparency, where it cuts out a figure;
2. a segmentation net of the user's own, if there is one;
3. a background of one colour around the figure: flat drawings, exact to the pixel;
4. selfie segmentation: photographs and paintings;
5. U^2-Net saliency: cartoons, anime and sketches, on which the one before fails.

A mask fits if it holds nearly all of the face outline and leaves some of the picture over. If none fits, the foreground
is the face outline itself, enlarged to hold hair. Without landmarks only a sure mask counts; if there is none, there is
no foreground.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from scipy import ndimage
from scipy.spatial import ConvexHull
from skimage import measure
from skimage.draw import polygon2mask

from vectortalker import models
from vectortalker.landmarks.window import Window, sample
from vectortalker.segmenter import Segmenter

SELFIE_SIDE, SALIENCY_SIDE = 256, 320
IMAGENET_MEAN, IMAGENET_STD = (0.485, 0.456, 0.406), (0.229, 0.224, 0.225)

MIN_FACE_COVERED = 0.95
MIN_AREA, MAX_AREA = 0.02, 0.97  # shares of the picture a foreground may take
MAX_UNSURE = 0.2  # values of .1-.9, as a share of the mask's area; photographs .02-.17, flat cartoons .22-.95
PLAIN_TOLERANCE = 3  # of 255, per channel: flat colour, not a photographed wall
MIN_PLAIN_BORDER = 0.7  # share of the left, top and right border
MAX_RECTANGULARITY = 0.95  # a figure that fills its rectangle is a framed picture
MIN_ISLAND = 0.05  # share of the largest part below which a part is a speck
MAX_HOLE = 0.005  # share of the picture below which a hole is filled
FOREHEAD = 0.35  # height above the brows, as a share of brows to chin
HAIR_MARGIN = 0.35  # growth of the face outline where no mask fits, as a share of its height

Source = Literal["alpha", "own", "plain", "selfie", "saliency", "face", "none"]


@dataclass(frozen=True)
class Masks:
    """`fore` f32 [H, W] in 0..1, soft at its edge; `face` bool [H, W], the outline of the face; `source` of `fore`."""

    fore: NDArray[np.float32]
    face: NDArray[np.bool_]
    source: Source

    @property
    def has_person(self) -> bool:
        return self.source != "none"


def segment(
    rgb: NDArray[np.uint8],
    points: NDArray[np.float64] | None = None,
    alpha: NDArray[np.uint8] | None = None,
    own: Segmenter | None = None,
) -> Masks:
    """Foreground of `rgb` uint8 [H, W, 3]; `points` [68, 2] and `alpha` [H, W] belong to the same pixels."""
    shape = rgb.shape[:2]
    face = np.zeros(shape, bool) if points is None else face_outline(points, shape)
    best: tuple[float, Source, NDArray[np.float32]] | None = None
    for source, soft in _sources(rgb, points, alpha, own):
        if not _fits(soft, face):
            continue
        unsure = _unsure(soft)
        if best is None or unsure < best[0]:
            best = unsure, source, soft
        if unsure <= MAX_UNSURE:
            break
    if best is not None and (best[0] <= MAX_UNSURE or points is not None):
        return Masks(_clean(np.maximum(best[2], face), face), face, best[1])
    if points is not None:
        return Masks(_head(face).astype(np.float32), face, "face")
    return Masks(np.zeros(shape, np.float32), face, "none")


def face_outline(points: NDArray[np.float64], shape: tuple[int, ...]) -> NDArray[np.bool_]:
    """Convex hull of the landmarks and a forehead above the brows, bool [H, W]."""
    brows, chin = points[17:27], points[8]
    forehead = brows + (brows.mean(axis=0) - chin) * FOREHEAD
    outline = np.concatenate([points, forehead])
    corners = outline[ConvexHull(outline).vertices]
    return np.asarray(polygon2mask(shape[:2], corners[:, ::-1] - 0.5), bool)


def _sources(
    rgb: NDArray[np.uint8],
    points: NDArray[np.float64] | None,
    alpha: NDArray[np.uint8] | None,
    own: Segmenter | None,
) -> Iterator[tuple[Source, NDArray[np.float32]]]:
    """Candidate masks f32 [H, W], cheapest first; the nets run only if they are reached."""
    if alpha is not None:
        yield "alpha", alpha.astype(np.float32) / np.float32(255)
    if own is not None:
        yield "own", own.mask_of(rgb, points)
    yield "plain", _off_plain_background(rgb)
    yield "selfie", _selfie(rgb)
    yield "saliency", _saliency(rgb)


def _fits(soft: NDArray[np.float32], face: NDArray[np.bool_]) -> bool:
    hard = soft > 0.5
    if not MIN_AREA <= hard.mean() <= MAX_AREA:
        return False
    return not face.any() or hard[face].mean() >= MIN_FACE_COVERED


def _unsure(soft: NDArray[np.float32]) -> float:
    return float(((soft > 0.1) & (soft < 0.9)).sum() / (soft > 0.5).sum())


def _off_plain_background(rgb: NDArray[np.uint8]) -> NDArray[np.float32]:
    """All but the one-coloured region along the left, top and right border; empty if there is none or only a frame.

    The lower border is left out: figures stand on it.
    """
    border = np.concatenate([rgb[:, 0], rgb[0], rgb[:, -1]])
    colours, counts = np.unique(border, axis=0, return_counts=True)
    plain = colours[counts.argmax()].astype(np.int16)
    near = (np.abs(rgb.astype(np.int16) - plain) <= PLAIN_TOLERANCE).all(axis=2)
    if np.concatenate([near[:, 0], near[0], near[:, -1]]).mean() < MIN_PLAIN_BORDER:
        return np.zeros(near.shape, np.float32)
    regions = _parts(near)
    touching = np.unique(np.concatenate([regions[:, 0], regions[0], regions[:, -1]]))
    figure = ~np.isin(regions, touching[touching > 0])
    if _rectangularity(figure) > MAX_RECTANGULARITY:
        return np.zeros(near.shape, np.float32)
    return figure.astype(np.float32)


def _parts(mask: NDArray[np.bool_]) -> NDArray[np.int64]:
    """Numbers the 4-connected parts from 1, int [H, W]."""
    return np.asarray(measure.label(mask, connectivity=1), np.int64)


def _rectangularity(figure: NDArray[np.bool_]) -> float:
    """Area of the largest part, holes filled, over its smallest rectangle, turned or not; 0 for less than two rows."""
    parts = _parts(np.asarray(ndimage.binary_fill_holes(figure), bool))
    largest = parts == np.bincount(parts.ravel(), minlength=2)[1:].argmax() + 1
    rows = np.flatnonzero(largest.any(axis=1))
    if rows.size < 2:
        return 0.0
    left = largest[rows].argmax(axis=1)
    right = largest.shape[1] - largest[rows, ::-1].argmax(axis=1)
    corners = np.concatenate([np.stack([x, rows + y], axis=1) for x in (left, right) for y in (0, 1)])
    hull = corners[ConvexHull(corners).vertices].astype(float)
    # The smallest rectangle lies along a side of the hull.
    along = np.roll(hull, -1, axis=0) - hull
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    across = np.stack([-along[:, 1], along[:, 0]], axis=1)
    areas = np.ptp(hull @ along.T, axis=0) * np.ptp(hull @ across.T, axis=0)
    return float(largest.sum() / areas.min())


def _selfie(rgb: NDArray[np.uint8]) -> NDArray[np.float32]:
    """The whole picture squeezed to a square, sampled as the net was trained; smoothing would lose drawings."""
    height, width = rgb.shape[:2]
    whole = Window(width / 2, height / 2, width, height)
    pixels = sample(rgb, whole, SELFIE_SIDE, extend_border=False) / np.float32(255)
    return _resized(models.run("selfie_segmentation", pixels)[0].reshape(SELFIE_SIDE, SELFIE_SIDE), rgb.shape)


def _saliency(rgb: NDArray[np.uint8]) -> NDArray[np.float32]:
    small = Image.fromarray(rgb).resize((SALIENCY_SIDE, SALIENCY_SIDE), Image.Resampling.LANCZOS)
    pixels = np.asarray(small, np.float32)
    pixels = (pixels / max(float(pixels.max()), 1.0) - np.array(IMAGENET_MEAN)) / np.array(IMAGENET_STD)
    found = models.run("u2netp", pixels.transpose(2, 0, 1)[None].astype(np.float32))[0][0, 0]
    return _resized(found, rgb.shape)


def _resized(mask: NDArray[np.float32], shape: tuple[int, ...]) -> NDArray[np.float32]:
    return np.asarray(Image.fromarray(mask).resize((shape[1], shape[0]), Image.Resampling.BILINEAR))


def _clean(soft: NDArray[np.float32], face: NDArray[np.bool_]) -> NDArray[np.float32]:
    """Drops parts that are specks beside the largest and do not touch the face; fills small holes."""
    hard = soft > 0.5
    parts = _parts(hard)
    sizes = np.bincount(parts.ravel())
    sizes[0] = 0
    kept = sizes >= MIN_ISLAND * sizes.max()
    kept[np.unique(parts[face])] = True
    kept[0] = False
    figure = kept[parts]
    holes = _parts(~hard)
    small_hole = np.bincount(holes.ravel()) < MAX_HOLE * soft.size
    small_hole[0] = False
    filled = small_hole[holes] & np.asarray(ndimage.binary_fill_holes(figure), bool)
    near_figure = ndimage.binary_dilation(figure, iterations=2)
    return np.where(filled, 1, soft * near_figure).astype(np.float32)


def _head(face: NDArray[np.bool_]) -> NDArray[np.bool_]:
    rows = np.flatnonzero(face.any(axis=1))
    margin = HAIR_MARGIN * (rows[-1] - rows[0] + 1) if rows.size else 0.0
    distance = np.asarray(ndimage.distance_transform_edt(~face))
    return distance <= margin
