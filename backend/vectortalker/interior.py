"""Landmarks and picture become the parts that no picture shows at rest: mouth interior and eyeballs, as local paths.

A closed mouth gets a cavity, teeth and a tongue in the portrait's own colours; its opening is empty at rest, so they
are invisible until it opens. An open mouth shows its own, and gets only a cavity to put underneath for when it opens
wider.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import vectortalker_core as core
from numpy.typing import NDArray

from vectortalker.oklab import to_oklab, to_srgb
from vectortalker.patch import Patch
from vectortalker.schema import LocalPath, Part, SolidFill

SEGMENTS = 8
EYES: tuple[Part, Part] = ("left_eye", "right_eye")
MOUTH = 2  # index of its opening
# The rig binds a cavity to the lips around it: a closed mouth's to the outer ones, which always hold the opening.
OUTER_LIP_ANCHORS = ((48, 48), (49, 50), (51, 51), (52, 53), (54, 54), (55, 56), (57, 57), (58, 59))
INNER_LIP_ANCHORS = tuple((landmark, landmark) for landmark in range(60, 68))
OPEN_CAVITY_GROWTH = 1.12  # a smooth curve through the inner lips must not cut their corners
LEFT_CORNER, RIGHT_CORNER, UPPER_MIDDLE, LOWER_MIDDLE = 60, 64, 62, 66
LIP_PAIRS = ((50, 61), (51, 62), (52, 63), (56, 65), (57, 66), (58, 67))  # the lip's middle lies between them
CHEEKS = ((2, 31), (14, 35), (4, 48), (12, 54), (8, 57), (27, 21), (27, 22))  # skin lies between them
MAX_PALETTE = 24
PALETTE_SHARE = 0.95  # of the pixels, that the palette's colours must make up
MAX_CAVITY_LIGHTNESS = 0.3
LEAST_TINT = 0.02  # OKLab chroma below which everything is ink on paper
LEAST_LIP_HUE = 0.03  # OKLab distance in a, b between lips that are coloured and skin
LEAST_LIP_CHROMA = 0.04
REDDER = np.array([0.08, 0.02])  # OKLab a, b
HUE_WEIGHT, MAX_SNAP = 3.0, 0.3
MOST_SMILE_GAPE = 0.4  # height over width of the opening; lower teeth and tongue are seen in a wider one
FLOOR_GAP, FLOOR_REACH = 0.03, 0.3  # of the inner mouth's width: below the lip line, and beyond the corners
WHITEST = 70  # percentile of lightness within an eye above which it is white
BALL_SCALE = 1.3  # an eyeball's disc against the opening's width


Array = NDArray[np.float64]


@dataclass(frozen=True)
class Blob:
    """Rounded band in mouth units: x in inner-mouth widths from the middle, y downwards from the lip line."""

    part: Part
    left: float
    right: float
    top: float
    bottom: float
    squareness: float  # exponent of the superellipse: 2 is an ellipse


# Sized for a jaw drop of .55 mouth widths. Teeth are seen .1 (upper) and .04 (lower) high, hidden above by the lip.
TEETH_AND_TONGUE = (
    Blob("mouth_lower", -0.36, 0.36, -0.05, 0.2, 4.0),
    Blob("tongue", -0.3, 0.3, -0.05, 0.4, 2.2),
    Blob("mouth_upper", -0.42, 0.42, -0.2, 0.1, 4.0),
)


def mouth_interior(points: NDArray[np.float64], rgb: NDArray[np.uint8]) -> list[LocalPath]:
    """Paths in painter's order for landmarks [68, 2] on uint8 [H, W, 3], both in portrait pixels.

    None for an open mouth without a whole pixel: it has no colour of its own.
    """
    _, outline, closed = core.opening_outlines(points)[MOUTH]
    if not closed:
        inside = _inside(outline, rgb)
        if not inside.any():
            return []
        return [_cavity(points, INNER_LIP_ANCHORS, OPEN_CAVITY_GROWTH, cavity_colour(rgb, inside))]
    colours = _mouth_colours(points, rgb)
    cavity = _cavity(points, OUTER_LIP_ANCHORS, 1.0, colours["mouth_cavity"])
    return [cavity, *(_band(blob, points, colours[blob.part]) for blob in TEETH_AND_TONGUE)]


def smile_floor(points: NDArray[np.float64], rgb: NDArray[np.uint8]) -> list[Patch]:
    """A dark floor below what a smile shows; none for other mouths.

    The teeth of a smile stay with the skull when the jaw drops, and their paths go on below the lip that hid them.
    """
    _, outline, closed = core.opening_outlines(points)[MOUTH]
    width, gape = np.ptp(outline, axis=0)
    across = points[RIGHT_CORNER] - points[LEFT_CORNER]
    inside = _inside(outline, rgb)
    if closed or gape > MOST_SMILE_GAPE * width or not inside.any():
        return []
    down = np.array([-across[1], across[0]])
    lip = points[[60, 67, 66, 65, 64]] + FLOOR_GAP * down
    ends = lip[[-1, 0]] + np.array([1, -1])[:, None] * across * FLOOR_REACH
    corners = np.concatenate([ends[1:], lip, ends[:1], ends[:1] + down, ends[1:] + down])
    return [Patch(corners, cavity_colour(rgb, inside))]


def eyeballs(points: NDArray[np.float64], rgb: NDArray[np.uint8]) -> list[LocalPath]:
    """A disc of the eye's white for each open eye, to put beneath what the picture shows of it."""
    balls = []
    for part, (_, outline, closed) in zip(EYES, core.opening_outlines(points), strict=False):
        inside = _inside(outline, rgb)
        if not closed and inside.any():
            low, high = outline.min(axis=0), outline.max(axis=0)
            radius = BALL_SCALE * (high[0] - low[0]) / 2
            ring = (low + high) / 2 + radius * _unit_ring(2.0)
            balls.append(_closed_path(part, ring, _white(rgb, inside)))
    return balls


def _inside(outline: Array, rgb: NDArray[np.uint8]) -> NDArray[np.bool_]:
    """Pixels [H, W] that an outline covers by more than half."""
    return core.coverage(outline.astype(np.float32), rgb.shape[1], rgb.shape[0]) > 0.5


def _mouth_colours(points: Array, rgb: NDArray[np.uint8]) -> dict[Part, Array]:
    """OKLab: cavity of the lips' hue at L .22, teeth at L .85-.92 tinted by the brightest skin, tongue at L .55.

    Lips that are drawn as a line, or in the skin's colour, have no hue of their own: red is mixed into the skin's.
    A drawing in ink has no red, and its mouths are black with white teeth.
    """
    lips = _samples(points, LIP_PAIRS, rgb)
    skin = _samples(points, CHEEKS, rgb)
    flesh, highlight = np.median(skin, axis=0)[1:], skin[skin[:, 0].argmax()]
    ink = max(np.linalg.norm(lips[:, 1:], axis=1).max(), np.linalg.norm(skin[:, 1:], axis=1).max()) < LEAST_TINT
    red = np.zeros(2) if ink else flesh / 2 + REDDER
    lip = np.median(lips, axis=0)[1:]
    lip = lip if np.linalg.norm(lip - flesh) > LEAST_LIP_HUE and np.linalg.norm(lip) > LEAST_LIP_CHROMA else red
    cavity = np.array([0.22, *lip * 0.6])
    teeth = np.array([np.clip(highlight[0] + 0.08, 0.85, 0.92), *highlight[1:] * 0.35])
    tongue = cavity if ink else np.array([0.55, *lip * 1.2])
    palette = _palette(rgb)
    if palette is not None:
        cavity, teeth, tongue = (_snapped(lab, palette) for lab in (cavity, teeth, tongue))
    return {"mouth_cavity": cavity, "mouth_lower": teeth - [0.04, 0, 0], "tongue": tongue, "mouth_upper": teeth}


def _snapped(lab: NDArray[np.float64], palette: NDArray[np.float64]) -> NDArray[np.float64]:
    """The palette's colour most like it, hue before lightness; itself if none is near."""
    distance = np.linalg.norm((palette - lab) * [1, HUE_WEIGHT, HUE_WEIGHT], axis=1)
    return palette[distance.argmin()] if distance.min() < MAX_SNAP else lab


def _samples(
    points: NDArray[np.float64], pairs: tuple[tuple[int, int], ...], rgb: NDArray[np.uint8]
) -> NDArray[np.float64]:
    """OKLab [n, 3] of the pixels half-way between pairs of landmarks."""
    a, b = np.array(pairs).T
    middle = (points[a] + points[b]) / 2
    columns = middle[:, 0].astype(int).clip(0, rgb.shape[1] - 1)
    rows = middle[:, 1].astype(int).clip(0, rgb.shape[0] - 1)
    return to_oklab(rgb[rows, columns] / 255)


def _palette(rgb: NDArray[np.uint8]) -> NDArray[np.float64] | None:
    """OKLab [n, 3] of a drawing's few colours; None if the picture has more than MAX_PALETTE."""
    codes = (rgb >> 4).astype(np.int64) @ np.array([256, 16, 1])
    _, inverse, counts = np.unique(codes.ravel(), return_inverse=True, return_counts=True)
    order = counts.argsort()[::-1]
    n_needed = int(np.searchsorted(counts[order].cumsum(), PALETTE_SHARE * codes.size)) + 1
    if n_needed > MAX_PALETTE:
        return None
    pixels = rgb.reshape(-1, 3)
    return to_oklab(np.array([np.median(pixels[inverse == k], axis=0) for k in order[:n_needed]]) / 255)


def cavity_colour(rgb: NDArray[np.uint8], inside: NDArray[np.bool_]) -> NDArray[np.float64]:
    """OKLab behind the teeth of an open mouth: median of its darkest quarter, darkened where teeth fill it."""
    lab = to_oklab(rgb[inside] / 255)
    dark = np.median(lab[lab[:, 0] <= np.percentile(lab[:, 0], 25)], axis=0)
    return dark * min(1.0, MAX_CAVITY_LIGHTNESS / max(dark[0], 1e-6))


def _white(rgb: NDArray[np.uint8], inside: NDArray[np.bool_]) -> NDArray[np.float64]:
    lab = to_oklab(rgb[inside] / 255)
    return np.median(lab[lab[:, 0] >= np.percentile(lab[:, 0], WHITEST)], axis=0)


def _cavity(
    points: NDArray[np.float64], anchors: tuple[tuple[int, int], ...], growth: float, lab: NDArray[np.float64]
) -> LocalPath:
    """The ring through the middles of landmark pairs, enlarged about its centre."""
    a, b = np.array(anchors).T
    ring = (points[a] + points[b]) / 2
    return _closed_path("mouth_cavity", ring.mean(axis=0) + growth * (ring - ring.mean(axis=0)), lab)


def _band(blob: Blob, points: NDArray[np.float64], lab: NDArray[np.float64]) -> LocalPath:
    """The blob in the mouth's own frame, bent along the lip line."""
    left, right = points[LEFT_CORNER], points[RIGHT_CORNER]
    across = right - left
    down = np.array([-across[1], across[0]])
    middle = (left + right) / 2
    line = (points[UPPER_MIDDLE] + points[LOWER_MIDDLE]) / 2 - middle
    sag = float(line @ down) / float(down @ down)
    half = np.array([blob.right - blob.left, blob.bottom - blob.top]) / 2
    centre = np.array([blob.left + blob.right, blob.top + blob.bottom]) / 2
    ring = centre + half * _unit_ring(blob.squareness)
    bent = ring[:, 1] + sag * (1 - (2 * ring[:, 0]) ** 2).clip(0, 1)
    return _closed_path(blob.part, middle + ring[:, :1] * across + bent[:, None] * down, lab)


def _unit_ring(squareness: float) -> NDArray[np.float64]:
    """Eight anchors [8, 2] of a superellipse of half-widths 1."""
    angle = 2 * np.pi * np.arange(SEGMENTS) / SEGMENTS
    xy = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return np.sign(xy) * np.abs(xy) ** (2 / squareness)


def _closed_path(part: Part, anchors: NDArray[np.float64], lab: NDArray[np.float64]) -> LocalPath:
    """Catmull-Rom cubics through the anchors [8, 2], one colour."""
    tangent = (np.roll(anchors, -1, axis=0) - np.roll(anchors, 1, axis=0)) / 6
    following = np.roll(anchors, -1, axis=0)
    chain = np.stack([anchors, anchors + tangent, following - np.roll(tangent, -1, axis=0)], axis=1)
    red, green, blue = np.rint(to_srgb(lab) * 255).astype(int)
    fill = SolidFill(colour=f"#{red:02x}{green:02x}{blue:02x}")
    return LocalPath(points=[float(v) for v in chain.reshape(-1).round(2)], fill=fill, part=part)
