"""A drawing's eyes get lids and lash lines in its own colours, hidden by the eyeballs until the eyes close.

Where skin is of one colour, what lies round an eye are lines: warped shut, the arch of a lash line crumples into a
blot, which a lid covers. Shaded skin keeps the lids that are warped from the picture, which carry its shading.
"""

from __future__ import annotations

import numpy as np
import vectortalker_core as core
from numpy.typing import NDArray

from vectortalker.landmarks.islands import cheeks, colour_of_most
from vectortalker.oklab import to_oklab
from vectortalker.patch import Patch
from vectortalker.schema import Landmarks

PLAIN = 0.015  # OKLab distance within which skin is of one colour …
LEAST_PLAIN = 0.75  # … for this share of the cheeks; flat drawings have .8 to 1, paintings and photographs up to .3
INSET = 0.96  # of the opening's size: the rig takes what lies wholly within an opening for a cover of the eye
FADE = 0.3  # of the lid's height: strands of hair above the eye end softly on the lid
NEAR = 0.3  # of the eye's width: skin this far around it …
LIKE_SKIN = 0.08  # … and this like the cheeks' in OKLab gives the lid its colour
LASH_SPAN = (0.08, 0.92)  # of the upper edge
LASH_STEPS = 32
LASH_STRIP = (0.05, 0.16)  # of the way from the upper to the lower edge; the rig takes the first fifth for lashes
DARKEST = 5  # per cent of the eye and what is around it
CHORDS = 16  # a cubic

Array = NDArray[np.float64]


def lids(landmarks: Landmarks, rgb: NDArray[np.uint8]) -> list[Patch]:
    """Lid and lash line of each eye on `rgb` u8 [H, W, 3], in painter's order.

    None for shaded skin, and none for an eye that rests shut or beyond the picture.
    """
    points = np.array(landmarks.points, np.float64)
    skin = colour_of_most(cheeks(rgb, points), PLAIN, LEAST_PLAIN)
    if skin is None:
        return []
    patches = []
    for _, outline, closed in core.opening_outlines(points)[:2]:
        opening = _polyline(outline)
        if not closed and len(_rectangle(rgb, opening, 0)):
            patches += [_lid(opening, skin, rgb), Patch(_lash_line(opening), _line_colour(rgb, opening))]
    return patches


def _lid(opening: Array, skin: Array, rgb: NDArray[np.uint8]) -> Patch:
    low, high = opening.min(axis=0), opening.max(axis=0)
    middle = (low + high) / 2
    outline = middle + INSET * (opening - middle)
    top = opening[len(opening) // 4]
    bottom = opening[-len(opening) // 4]
    return Patch(outline, _colour_around(rgb, opening, skin), np.stack([top, top + FADE * (bottom - top)]))


def _colour_around(rgb: NDArray[np.uint8], opening: Array, skin: Array) -> Array:
    """Median OKLab of skin beside the opening, which may lie in a fringe's shade."""
    margin = NEAR * float(np.ptp(opening[:, 0]))
    pixels = _rectangle(rgb, opening, margin)
    like = pixels[np.linalg.norm(pixels - skin, axis=1) < LIKE_SKIN]
    return np.median(like, axis=0) if len(like) else skin


def _lash_line(opening: Array) -> Array:
    """There along the strip's upper side and back along its lower one, pointed at both ends."""
    half = len(opening) // 2
    upper, lower = opening[: half + 1], np.roll(opening[::-1], 1, axis=0)[: half + 1]
    at = np.linspace(*LASH_SPAN, LASH_STEPS) * half
    upper, lower = (
        np.stack([np.interp(at, np.arange(half + 1), v) for v in edge.T], axis=1) for edge in (upper, lower)
    )
    bow = np.sqrt(np.sin(np.pi * np.linspace(0, 1, LASH_STEPS)))[:, None]
    top, thickness = LASH_STRIP[0], (LASH_STRIP[1] - LASH_STRIP[0]) * bow
    return np.concatenate([upper + top * (lower - upper), (upper + (top + thickness) * (lower - upper))[::-1]])


def _line_colour(rgb: NDArray[np.uint8], opening: Array) -> Array:
    """OKLab of what is darkest in the eye's rectangle: lash line, outline or pupil."""
    lab = _rectangle(rgb, opening, 0)
    return np.median(lab[lab[:, 0] <= np.percentile(lab[:, 0], DARKEST)], axis=0)


def _rectangle(rgb: NDArray[np.uint8], opening: Array, margin: float) -> Array:
    """OKLab [n, 3] of the pixels of its rectangle, wider by `margin` px on every side; empty beyond the picture."""
    left, top = np.floor(opening.min(axis=0) - margin).astype(int).clip(0)
    right, bottom = np.ceil(opening.max(axis=0) + margin).astype(int).clip(0)
    return to_oklab(rgb[top:bottom, left:right].reshape(-1, 3) / 255)


def _polyline(chain: Array) -> Array:
    """Points along a closed chain of cubics [3S, 2]."""
    t = (np.arange(CHORDS) / CHORDS)[:, None]
    a, b, c, d = (np.roll(chain, -k, axis=0)[::3, None] for k in range(4))
    return ((1 - t) ** 3 * a + 3 * t * (1 - t) ** 2 * b + 3 * t**2 * (1 - t) * c + t**3 * d).reshape(-1, 2)
