"""A drawing's eyes get lids in its own skin and line colours, hidden by the eyeballs until the eyes close.

Where skin is of one colour, what lies round an eye are lines: warped shut, the arch of a lash line crumples into a
blot, which a lid covers. Shaded skin keeps the lids that are warped from the picture, which carry its shading.
"""

from __future__ import annotations

import numpy as np
import vectortalker_core as core
from numpy.typing import NDArray

from vectortalker.landmarks.drawn import cheeks, colour_of_most
from vectortalker.oklab import to_oklab
from vectortalker.rig import build_rig
from vectortalker.schema import Landmarks, Pose, Scene

PLAIN = 0.015  # OKLab distance within which skin is of one colour …
LEAST_PLAIN = 0.75  # … for this share of the cheeks; flat drawings have .8 to 1, paintings and photographs up to .3
INSET = 0.92  # of the opening's size: the rig takes what lies wholly within an opening for a lid
SHUT = Pose(articulators={"blink_left": 1, "blink_right": 1})
LINE_SPAN = (0.1, 0.9)  # of the line along which the lids meet
LINE_STEPS = 32
LINE_THICKNESS = 0.09  # of the mean of the eye's width and height
DARKEST = 5  # per cent of the eye and what is around it
CHORDS = 16  # a cubic

Array = NDArray[np.float64]


def lids(landmarks: Landmarks, rgb: NDArray[np.uint8]) -> list[tuple[Array, Array]]:
    """Skin and lash line of each eye on `rgb` u8 [H, W, 3], in painter's order: outlines [n, 2] in px, OKLab colours.

    None for shaded skin, and none for an eye that rests shut.
    """
    points = np.array(landmarks.points, np.float64)
    skin = colour_of_most(cheeks(rgb, points), PLAIN, LEAST_PLAIN)
    if skin is None:
        return []
    patches = []
    for (_, outline, closed), meeting in zip(core.opening_outlines(points)[:2], _shut(landmarks, rgb), strict=True):
        if not closed:
            opening, line = _polyline(outline), _polyline(meeting)
            middle = (opening.min(axis=0) + opening.max(axis=0)) / 2
            patches.append((middle + INSET * (opening - middle), skin))
            crescent = _crescent(line[: len(line) // 2 + 1], LINE_THICKNESS * float(np.ptp(opening, axis=0).mean()))
            patches.append((crescent, _line_colour(rgb, opening)))
    return patches


def _shut(landmarks: Landmarks, rgb: NDArray[np.uint8]) -> list[Array]:
    """Outlines [3S, 2] of the eyes as the rig closes them."""
    empty = Scene(width=rgb.shape[1], height=rgb.shape[0], canvas="#000000", back=[], fore=[], local=[])
    rig = build_rig(empty, landmarks)
    return rig.openings(rig.vertices(SHUT).vertices)[:2]


def _crescent(line: Array, thickness: float) -> Array:
    """There along the line and back below it, `thickness` apart in the middle."""
    at = np.linspace(*LINE_SPAN, LINE_STEPS) * (len(line) - 1)
    along = np.stack([np.interp(at, np.arange(len(line)), axis) for axis in line.T], axis=1)
    across = line[-1] - line[0]
    up = np.array([across[1], -across[0]]) / np.linalg.norm(across)
    bow = thickness / 2 * np.sqrt(np.sin(np.pi * np.linspace(0, 1, LINE_STEPS)))[:, None] * up
    return np.concatenate([along + bow, (along - bow)[::-1]])


def _line_colour(rgb: NDArray[np.uint8], opening: Array) -> Array:
    """OKLab of what is darkest in the eye's rectangle: lash line, outline or pupil."""
    left, top = np.floor(opening.min(axis=0)).astype(int).clip(0)
    right, bottom = np.ceil(opening.max(axis=0)).astype(int)
    lab = to_oklab(rgb[top:bottom, left:right].reshape(-1, 3) / 255)
    return np.median(lab[lab[:, 0] <= np.percentile(lab[:, 0], DARKEST)], axis=0)


def _polyline(chain: Array) -> Array:
    """Points along a closed chain of cubics [3S, 2]."""
    t = (np.arange(CHORDS) / CHORDS)[:, None]
    a, b, c, d = (np.roll(chain, -k, axis=0)[::3, None] for k in range(4))
    return ((1 - t) ** 3 * a + 3 * t * (1 - t) ** 2 * b + 3 * t**2 * (1 - t) * c + t**3 * d).reshape(-1, 2)
