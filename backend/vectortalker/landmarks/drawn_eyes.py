"""Drawn eyes become their own outlines: islands in flat skin, often far larger or rounder than eyes in photographs.

The mesh network was trained on photographs and puts an eye of a photograph's size somewhere inside the drawn one. Where
the skin around is of one colour, as in cartoons and anime, the eye is what differs from it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from skimage.morphology import convex_hull_image

from vectortalker.landmarks.ibug import IrisDisc, outer_eye_distance
from vectortalker.landmarks.islands import SIDE, Array, Mask, flat_skin, island, numbered, square_at

REACH = 0.9  # side of the square in which an eye is looked for, outer-eye distances
EYES = (36, 42)  # first landmark of the image-left and image-right eye
BROWS = (slice(17, 22), slice(22, 27))
TEMPLES = (slice(0, 3), slice(14, 17))  # of the jaw's contour
BROW_ROOM, TEMPLE_ROOM = 0.06, 0.1  # outer-eye distances that lids need to close under a brow and beside a temple
LEAST_END = 0.3  # of the eye's height: what is lower at its ends is lashes
ARCH = 1.125  # weight of the inner points' height, less their corners', in the middle of an opening's outline
CORNER_HEIGHT = 0.65  # of the eye's height below its top: where the lids meet in a round eye
EDGE = 2  # px of an outline's blended edge
LASH_LIGHTNESS = 0.5
MOST_LASH = 0.2  # of the eye's height
OUTLINE = 3  # px: radius of strokes round the eye, which are not its iris
LEAST_SCLERA_CONTRAST = 0.25  # of lightness, between white and iris


@dataclass(frozen=True)
class DrawnEye:
    """`contour` f64 [6, 2] in iBUG order and the iris, in portrait pixels."""

    contour: Array
    iris: IrisDisc


def drawn_eyes(rgb: NDArray[np.uint8], points: Array) -> tuple[DrawnEye, DrawnEye] | None:
    """Both eyes of a flat drawing with rough landmarks `points` [68, 2]; None if they are no islands in flat skin."""
    skin = flat_skin(rgb, points)
    if skin is None:
        return None
    eyes = [_drawn_eye(rgb, points, first, skin) for first in EYES]
    left, right = eyes
    return None if left is None or right is None else (left, right)


def with_eyes(points: Array, eyes: tuple[DrawnEye, DrawnEye]) -> Array:
    """Landmarks [68, 2] with these eyes. Brows and temples that the eyes reach give way to them."""
    placed = points.copy()
    placed[36:48] = np.concatenate([eye.contour for eye in eyes])
    unit = outer_eye_distance(points)
    right = (points[45] - points[36]) / unit
    up = np.array([right[1], -right[0]])
    for eye, brow, temple, outwards in zip(eyes, BROWS, TEMPLES, (-right, right), strict=True):
        missing = (eye.contour @ up).max() + BROW_ROOM * unit - (placed[brow] @ up).min()
        placed[brow] += max(0.0, float(missing)) * up
        missing = (eye.contour @ outwards).max() + TEMPLE_ROOM * unit - placed[temple] @ outwards
        placed[temple] += missing.clip(min=0)[:, None] * outwards
    return placed


def _drawn_eye(rgb: NDArray[np.uint8], points: Array, first: int, skin: Array) -> DrawnEye | None:
    square = square_at(rgb, points, points[first : first + 6].mean(axis=0), REACH)
    compact = island(square.unlike(skin))
    if compact is None:
        return None
    eye = np.asarray(convex_hull_image(compact), bool)
    centre, radius = _iris(eye, square.lab[..., 0])
    x, y = square.to_portrait(centre)
    scale = float(np.linalg.norm(square.axes[0]))
    return DrawnEye(square.to_portrait(_contour(eye)), IrisDisc((float(x), float(y)), radius * scale))


def _contour(eye: Mask) -> Array:
    """Six points [6, 2] whose outline holds the eye, its lash line too: its ends, and above and below near them."""
    tops = np.argmax(eye, axis=0)
    bottoms = SIDE - np.argmax(eye[::-1], axis=0)
    heights = np.where(eye.any(axis=0), bottoms - tops, 0)
    columns = np.flatnonzero(heights >= LEAST_END * heights.max())
    left, right = int(columns[0]), int(columns[-1])
    corner = float(tops[columns].min() + CORNER_HEIGHT * heights.max())
    thirds = [round(left + (right - left) * share) for share in (0.2, 0.5, 0.8)]
    upper = _arch(corner, *(float(tops[c]) for c in thirds))
    lower = _arch(corner, *(float(bottoms[c]) for c in thirds))
    (x1, _, x2), edge = np.array(thirds) + 0.5, EDGE / 2
    above = [(x1, upper[0] - edge), (x2, upper[1] - edge)]
    below = [(x2, lower[1] + edge), (x1, lower[0] + edge)]
    return np.array([(left - edge, corner), *above, (right + 1 + edge, corner), *below])


def _arch(corner: float, first: float, middle: float, last: float) -> tuple[float, float]:
    """Heights of the two inner points of a contour whose outline passes through `middle`, or beyond it."""
    reached = ARCH * (first + last) / 2 + (1 - ARCH) * corner
    away = np.sign(middle - corner)
    lift = away * max(0.0, away * (middle - reached)) / ARCH
    return first + lift, last + lift


def _lash_height(eye: Mask, lightness: Array) -> int:
    """Rows of the eye's middle columns that are dark along its top; none in an eye that is dark all over."""
    rows, columns = np.nonzero(eye)
    low, high = np.percentile(columns, (30, 70)).astype(int)
    most = round(MOST_LASH * np.ptp(rows))
    tops = [int(np.argmax(eye[:, c])) + EDGE for c in range(low, high + 1)]
    light = [lightness[t : t + most, c] > LASH_LIGHTNESS for c, t in enumerate(tops, low)]
    found = [int(np.argmax(column)) for column in light if column.any()]
    return EDGE + round(float(np.median(found))) if len(found) > len(light) / 2 else 0


def _iris(eye: Mask, lightness: Array) -> tuple[Array, float]:
    """Centre [2] and radius of what is dark below the lash line: all of a dot eye."""
    top = int(np.flatnonzero(eye.any(axis=1))[0]) + _lash_height(eye, lightness)
    below = eye & (np.arange(SIDE)[:, None] >= top)
    dark, light = np.percentile(lightness[below], (5, 95))
    disc = below & (lightness < (dark + light) / 2) if light - dark > LEAST_SCLERA_CONTRAST else below
    numbers = numbered(disc, OUTLINE)
    if numbers.any():
        disc = numbers == 1 + np.bincount(numbers.ravel())[1:].argmax()
    rows, columns = np.nonzero(disc)
    radius = np.sqrt(len(rows) / np.pi)
    return np.array([columns.mean() + 0.5, rows.mean() + 0.5]), float(radius)
