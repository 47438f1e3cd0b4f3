"""Flat skin becomes the islands in it: eyes, mouths and whatever else a drawing sets off against one colour."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import binary_closing, binary_fill_holes, binary_opening
from skimage import measure
from skimage.morphology import convex_hull_image, disk

from vectortalker.landmarks.ibug import outer_eye_distance
from vectortalker.landmarks.window import Window, sample
from vectortalker.oklab import to_oklab

SIDE = 160  # px of the square in which an island is looked for
CHEEKS = ((2, 31), (14, 35), (4, 48), (12, 54), (31, 41), (35, 46))  # skin lies between them
CHEEK_REACH = 0.08  # half the side of a patch of skin, outer-eye distances
UNLIKE_SKIN = 0.1  # OKLab distance
FLAT = 0.03  # OKLab distance within which skin is of one colour …
LEAST_FLAT = 0.6  # … for this share of the cheeks; photographs have .1 to .5
THIN = (2, 4, 6)  # px: radii of strokes that are cut off, until the island is free: rims of glasses, strands of hair
TONE = 2  # px: half the gaps between the dots of a screentone
LEAST_AREA, MOST_AREA = 0.008, 0.35  # of the square
LEAST_SOLIDITY = 0.75  # area over that of the convex hull
FURTHEST = 0.3  # of the square: from its middle, where the island was detected

Mask = NDArray[np.bool_]
Array = NDArray[np.float64]


@dataclass(frozen=True)
class Square:
    """OKLab `lab` [SIDE, SIDE, 3] of a square level with the eyes; `middle` [2] in portrait pixels, `axes` [2, 2] the
    portrait's vectors of a pixel to the right and one down.
    """

    lab: Array
    middle: Array
    axes: Array

    def to_portrait(self, xy: Array) -> Array:
        """Portrait pixels of points [..., 2] of the square."""
        return self.middle + (xy - SIDE / 2) @ self.axes

    def unlike(self, skin: Array) -> Mask:
        """Pixels [SIDE, SIDE] of another colour than OKLab `skin` [3], the gaps of a screentone too."""
        differs = np.linalg.norm(self.lab - skin, axis=2) > UNLIKE_SKIN
        return np.asarray(binary_closing(differs, disk(TONE)), bool)


def square_at(rgb: NDArray[np.uint8], points: Array, middle: Array, reach: float) -> Square:
    """The square of `reach` outer-eye distances around `middle` [2], for landmarks `points` [68, 2]."""
    across = points[45] - points[36]
    side = reach * outer_eye_distance(points)
    window = Window(float(middle[0]), float(middle[1]), side, side, float(np.arctan2(across[1], across[0])))
    right = across / np.linalg.norm(across) * side / SIDE
    lab = to_oklab(sample(rgb, window, SIDE, extend_border=True)[0] / 255)
    return Square(lab, middle, np.array([right, (-right[1], right[0])]))


def flat_skin(rgb: NDArray[np.uint8], points: Array) -> Array | None:
    """OKLab [3] of a face whose skin is of one colour; None for shaded skin."""
    return colour_of_most(cheeks(rgb, points), FLAT, LEAST_FLAT)


def cheeks(rgb: NDArray[np.uint8], points: Array) -> Array:
    """OKLab [n, 3] of patches of skin in uint8 [H, W, 3], for landmarks [68, 2]; empty beyond the picture."""
    reach = CHEEK_REACH * outer_eye_distance(points)
    patches = []
    for a, b in CHEEKS:
        x, y = (points[a] + points[b]) / 2
        rows, columns = (slice(max(0, round(v - reach)), max(0, round(v + reach) + 1)) for v in (y, x))
        patches.append(rgb[rows, columns].reshape(-1, 3))
    return to_oklab(np.concatenate(patches) / 255)


def colour_of_most(lab: Array, within: float, share: float) -> Array | None:
    """Median of colours [n, 3]; None if less than a `share` of them lies `within` that distance of it."""
    if not len(lab):
        return None
    middle = np.median(lab, axis=0)
    return middle if (np.linalg.norm(lab - middle, axis=1) < within).mean() >= share else None


def island(unlike: Mask) -> Mask | None:
    """The compact part of `unlike` [SIDE, SIDE] nearest to its middle, without holes; None if there is none."""
    for radius in THIN:
        numbers = numbered(unlike, radius)
        parts = (np.asarray(binary_fill_holes(numbers == n), bool) for n in range(1, int(numbers.max()) + 1))
        compact = [part for part in parts if _is_compact(part)]
        if compact:
            return min(compact, key=_eccentricity)
    return None


def numbered(mask: Mask, thin: int) -> NDArray[np.int64]:
    """Its 4-connected parts without strokes of radius `thin` px, numbered from 1."""
    return np.asarray(measure.label(binary_opening(mask, disk(thin)), connectivity=1), np.int64)


def _is_compact(part: Mask) -> bool:
    touches = part[0].any() or part[-1].any() or part[:, 0].any() or part[:, -1].any()
    if touches or not LEAST_AREA * SIDE**2 < part.sum() < MOST_AREA * SIDE**2 or _eccentricity(part) > FURTHEST * SIDE:
        return False
    return bool(part.sum() >= LEAST_SOLIDITY * convex_hull_image(part).sum())


def _eccentricity(part: Mask) -> float:
    """Distance of its centre from the square's, px."""
    rows, columns = np.nonzero(part)
    return float(np.hypot(rows.mean() - (SIDE - 1) / 2, columns.mean() - (SIDE - 1) / 2))
