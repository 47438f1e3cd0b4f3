"""A drawn mouth that is open becomes its own outline: an island in flat skin, of any shape.

The mesh network was trained on photographs and lays lips of a photograph's shape over it, often as a closed mouth. Shut
mouths, which are lines or lips, stay as the mesh finds them.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import binary_dilation, binary_fill_holes, distance_transform_edt
from skimage.morphology import disk

from vectortalker.landmarks.ibug import outer_eye_distance
from vectortalker.landmarks.islands import SIDE, Array, Mask, Square, flat_skin, island, square_at

REACH = 1.1  # side of the square in which the mouth is looked for, outer-eye distances
MOUTH = slice(48, 68)
NOSE_BASE, CHIN = 33, 8
ROOM = 0.04  # outer-eye distances between the mouth and what is above and below it
EDGE = 2  # px of an outline's blended edge
LEAST_END = 0.3  # of the mouth's height: what is lower at its ends are lines at its corners
OUTER_BETWEEN, INNER_BETWEEN = 5, 3  # landmarks between the corners of each lip's edge
DARK = 0.5  # lightness: strokes, and what lies behind the teeth
WHITE_LIGHTNESS, WHITE_CHROMA = 0.85, 0.06  # teeth and paper
LEAST_INSIDE, LEAST_WHITE = 0.5, 0.1  # shares of a mouth that are dark or white, and white
MIDDLE = (25, 75)  # percentiles of its pixels, across and along
LINE = (0.02, 0.35)  # share of the middle that a line between two shut lips takes
LEAST_STROKE = 0.7  # share of pixels as deep within the mouth that are dark, if its outline is that thick
MOST_STROKE = 0.08  # of the mouth's width


def drawn_mouth(rgb: NDArray[np.uint8], points: Array) -> Array | None:
    """Landmarks 48-67 [20, 2] of the open mouth of a flat drawing with rough landmarks `points` [68, 2].

    None if nothing between nose and chin is an island in flat skin that shows teeth.
    """
    skin = flat_skin(rgb, points)
    if skin is None:
        return None
    square = square_at(rgb, points, points[MOUTH].mean(axis=0), REACH)
    mouth = island(np.asarray(binary_fill_holes(square.unlike(skin)), bool))
    if mouth is None:
        return None
    inside = _within_outline(mouth, square)
    if not _shows_inside(inside, square):
        return None
    around = np.asarray(binary_dilation(mouth, disk(EDGE)), bool)
    lips = square.to_portrait(np.concatenate([_ring(around, OUTER_BETWEEN), _ring(inside, INNER_BETWEEN)]))
    return lips if _has_room(lips, points) else None


def _within_outline(mouth: Mask, square: Square) -> Mask:
    """The mouth [SIDE, SIDE] without its edge and the stroke that is drawn around it, if any: these are the lips."""
    depth = np.ceil(np.asarray(distance_transform_edt(mouth))).astype(int)
    dark = square.lab[..., 0] < DARK
    most = min(EDGE + round(MOST_STROKE * np.ptp(np.flatnonzero(mouth.any(axis=0)))), int(depth.max()))
    light = (d for d in range(EDGE + 1, most) if dark[depth == d].mean() < LEAST_STROKE)
    return depth >= next(light, most)


def _shows_inside(inside: Mask, square: Square) -> bool:
    """Whether it is dark and white, or white alone: lips have a colour, a shade below them no teeth.

    What a mere line parts may be two shut lips, or a grin.
    """
    lightness, chroma = square.lab[..., 0], np.linalg.norm(square.lab[..., 1:], axis=2)
    dark, white = lightness < DARK, (lightness > WHITE_LIGHTNESS) & (chroma < WHITE_CHROMA)
    rows, columns = np.nonzero(inside)
    if not rows.size or (dark | white)[inside].mean() < LEAST_INSIDE or white[inside].mean() < LEAST_WHITE:
        return False
    (top, bottom), (left, right) = (np.percentile(at, MIDDLE).astype(int) for at in (rows, columns))
    return not LINE[0] < dark[top : bottom + 1, left : right + 1].mean() < LINE[1]


def _ring(mask: Mask, between: int) -> Array:
    """Points [2 · between + 2, 2] around it: image-left corner, above to the right, the other corner, below back."""
    tops = np.argmax(mask, axis=0)
    bottoms = SIDE - np.argmax(mask[::-1], axis=0)
    heights = np.where(mask.any(axis=0), bottoms - tops, 0)
    columns = np.flatnonzero(heights >= LEAST_END * heights.max())
    left, right = int(columns[0]), int(columns[-1])
    at = np.linspace(left, right, between + 2).round().astype(int)[1:-1]
    corners = [(x, (tops[c] + bottoms[c]) / 2) for x, c in ((left, left), (right + 1, right))]
    upper, lower = (np.stack([at + 0.5, edge[at]], axis=1) for edge in (tops, bottoms))
    return np.concatenate([corners[:1], upper, corners[1:], lower[::-1]]).astype(np.float64)


def _has_room(lips: Array, points: Array) -> bool:
    right = (points[45] - points[36]) / outer_eye_distance(points)
    down = np.array([-right[1], right[0]])
    above, below = (lips @ down).min() - points[NOSE_BASE] @ down, points[CHIN] @ down - (lips @ down).max()
    return bool(min(above, below) > ROOM * outer_eye_distance(points))
