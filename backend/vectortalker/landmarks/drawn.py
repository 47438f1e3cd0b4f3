"""Drawn eyes become their own outlines: islands in flat skin, often far larger or rounder than eyes in photographs.

The mesh network was trained on photographs and puts an eye of a photograph's size somewhere inside the drawn one. Where
the skin around is of one colour, as in cartoons and anime, the eye is what differs from it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import binary_fill_holes, binary_opening
from skimage import measure
from skimage.morphology import convex_hull_image, disk

from vectortalker.landmarks.ibug import IrisDisc, outer_eye_distance
from vectortalker.landmarks.window import Window, sample
from vectortalker.oklab import to_oklab

SIDE = 160  # px of the square in which an eye is looked for
REACH = 0.9  # its side in outer-eye distances
EYES = (36, 42)  # first landmark of the image-left and image-right eye
CHEEKS = ((2, 31), (14, 35), (4, 48), (12, 54), (31, 41), (35, 46))  # skin lies between them
UNLIKE_SKIN = 0.1  # OKLab distance
FLAT = 0.03  # OKLab distance within which skin is of one colour …
LEAST_FLAT = 0.6  # … for this share of the cheeks; photographs have .1 to .5
THIN = (2, 4, 6)  # px: radii of strokes that are cut off, until the eye is free: rims of glasses, strands of hair
LEAST_AREA, MOST_AREA = 0.008, 0.35  # of the square
LEAST_SOLIDITY = 0.75  # area over that of the convex hull
FURTHEST = 0.3  # of the square: from its middle, where the eye was detected
LEAST_END = 0.3  # of the eye's height: what is lower at its ends is lashes
CORNER_HEIGHT = 0.6  # of the eye's height below its top: where the lids meet in a round eye
EDGE = 2  # px of an outline's blended edge
LASH_LIGHTNESS = 0.5
MOST_LASH = 0.2  # of the eye's height
OUTLINE = 3  # px: radius of strokes round the eye, which are not its iris
LEAST_SCLERA_CONTRAST = 0.25  # of lightness, between white and iris

Mask = NDArray[np.bool_]
Array = NDArray[np.float64]


@dataclass(frozen=True)
class DrawnEye:
    """`contour` f64 [6, 2] in iBUG order and the iris, in portrait pixels."""

    contour: Array
    iris: IrisDisc


def drawn_eyes(rgb: NDArray[np.uint8], points: Array) -> tuple[DrawnEye, DrawnEye] | None:
    """Both eyes of a flat drawing with rough landmarks `points` [68, 2]; None if they are no islands in flat skin."""
    skin = _flat_skin(rgb, points)
    if skin is None:
        return None
    eyes = [_drawn_eye(rgb, points, first, skin) for first in EYES]
    left, right = eyes
    return None if left is None or right is None else (left, right)


def _flat_skin(rgb: NDArray[np.uint8], points: Array) -> Array | None:
    """OKLab of the cheeks; None if they are shaded."""
    reach = 0.08 * outer_eye_distance(points)
    patches = []
    for a, b in CHEEKS:
        x, y = (points[a] + points[b]) / 2
        rows, columns = (slice(max(0, round(v - reach)), max(0, round(v + reach)) + 1) for v in (y, x))
        patches.append(rgb[rows, columns].reshape(-1, 3))
    lab = to_oklab(np.concatenate(patches) / 255)
    if not len(lab):
        return None
    skin = np.median(lab, axis=0)
    return skin if (np.linalg.norm(lab - skin, axis=1) < FLAT).mean() >= LEAST_FLAT else None


def _drawn_eye(rgb: NDArray[np.uint8], points: Array, first: int, skin: Array) -> DrawnEye | None:
    across = points[45] - points[36]
    side = REACH * float(np.linalg.norm(across))
    middle = points[first : first + 6].mean(axis=0)
    window = Window(float(middle[0]), float(middle[1]), side, side, float(np.arctan2(across[1], across[0])))
    lab = to_oklab(sample(rgb, window, SIDE, extend_border=True)[0] / 255)
    eye = _island(np.linalg.norm(lab - skin, axis=2) > UNLIKE_SKIN)
    if eye is None:
        return None
    contour = _contour(eye, lab[..., 0])
    centre, radius = _iris(eye, lab[..., 0], contour)
    axes = np.array([[across[0], across[1]], [-across[1], across[0]]]) / np.linalg.norm(across)
    scale = side / SIDE

    def placed(xy: Array) -> Array:
        return middle + (xy - SIDE / 2) * scale @ axes

    x, y = placed(centre)
    return DrawnEye(placed(contour), IrisDisc((float(x), float(y)), radius * scale))


def _island(unlike: Mask) -> Mask | None:
    """The convex hull of the compact part of `unlike` [SIDE, SIDE] nearest to its middle; None if it is no eye."""
    for radius in THIN:
        numbers = _numbered(unlike, radius)
        parts = (np.asarray(binary_fill_holes(numbers == n), bool) for n in range(1, int(numbers.max()) + 1))
        eyes = [part for part in parts if _may_be_eye(part)]
        if eyes:
            return np.asarray(convex_hull_image(min(eyes, key=_eccentricity)), bool)
    return None


def _numbered(mask: Mask, thin: int) -> NDArray[np.int64]:
    """Its 4-connected parts without strokes of radius `thin` px, numbered from 1."""
    return np.asarray(measure.label(binary_opening(mask, disk(thin)), connectivity=1), np.int64)


def _may_be_eye(part: Mask) -> bool:
    touches = part[0].any() or part[-1].any() or part[:, 0].any() or part[:, -1].any()
    if touches or not LEAST_AREA * SIDE**2 < part.sum() < MOST_AREA * SIDE**2 or _eccentricity(part) > FURTHEST * SIDE:
        return False
    return bool(part.sum() >= LEAST_SOLIDITY * convex_hull_image(part).sum())


def _eccentricity(part: Mask) -> float:
    """Distance of its centre from the square's, px."""
    rows, columns = np.nonzero(part)
    return float(np.hypot(rows.mean() - (SIDE - 1) / 2, columns.mean() - (SIDE - 1) / 2))


def _contour(eye: Mask, lightness: Array) -> Array:
    """Six points [6, 2] round the eye: its ends, and above and below its thirds.

    A dark rim along its top stays outside: it is the lash line, which goes with the lid. So do lashes beside the ends.
    """
    tops = np.argmax(eye, axis=0)
    bottoms = SIDE - np.argmax(eye[::-1], axis=0)
    heights = np.where(eye.any(axis=0), bottoms - tops, 0)
    columns = np.flatnonzero(heights >= LEAST_END * heights.max())
    left, right = int(columns[0]), int(columns[-1])
    corner = float(tops[columns].min() + CORNER_HEIGHT * heights.max())
    most = round(MOST_LASH * int(heights.max()))
    quarter = len(columns) // 4
    rims = [_rim(lightness[tops[c] : tops[c] + most, c]) for c in columns[quarter : len(columns) - quarter]]
    rim = float(np.median(rims))
    thirds = [round(left + (right - left) * share) for share in (0.3, 0.7)]
    upper = [(c + 0.5, tops[c] + rim) for c in thirds]
    lower = [(c + 0.5, float(bottoms[c])) for c in thirds]
    return np.array([(left, corner), *upper, (right + 1, corner), *reversed(lower)], float)


def _rim(column: Array) -> int:
    """Pixels from the top of a column down to the first light one below the blended edge."""
    light = np.flatnonzero(column[EDGE:] > LASH_LIGHTNESS)
    return EDGE + int(light[0]) if light.size else len(column)


def _iris(eye: Mask, lightness: Array, contour: Array) -> tuple[Array, float]:
    """Centre [2] and radius of what is dark below the lash line: all of a dot eye."""
    below = eye & (np.arange(SIDE)[:, None] >= contour[1:3, 1].mean())
    dark, light = np.percentile(lightness[below], (5, 95))
    disc = below & (lightness < (dark + light) / 2) if light - dark > LEAST_SCLERA_CONTRAST else below
    numbers = _numbered(disc, OUTLINE)
    if numbers.any():
        disc = numbers == 1 + np.bincount(numbers.ravel())[1:].argmax()
    rows, columns = np.nonzero(disc)
    radius = np.sqrt(len(rows) / np.pi)
    return np.array([columns.mean() + 0.5, rows.mean() + 0.5]), float(radius)
