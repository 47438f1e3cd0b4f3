"""A detected iris becomes the ellipse that the picture shows: drawn irises are often far taller than wide.

What of an iris lies beyond its ellipse counts as eyeball: it stays behind when the eye looks aside.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from vectortalker.landmarks.ibug import IrisDisc

CORE = 0.98  # coverage at which a pixel shows nothing but the opening's inside
BAND = 0.4  # of the radius: half the width of the bands along which the iris's ends are looked for
LEAST_CONTRAST = 0.25  # of lightness between white and iris; an eye with less is all iris
STROKE = 0.15  # of the opening's height: lash lines and outlines along its edge, which irises touch
DARK = 0.35  # of the way from the darkest to the lightest: a white may lie in the shade

Mask = NDArray[np.bool_]


@dataclass(frozen=True)
class SeenIris:
    """Centre (x, y) and radii (horizontal, vertical) in px."""

    centre: tuple[float, float]
    radii: tuple[float, float]


def seen_iris(image: NDArray[np.float32], clip: NDArray[np.float32], disc: IrisDisc) -> SeenIris:
    """The smallest upright ellipse around the disc's box and what is dark above, below and beside it.

    `image` f32 [H, W, 3], `clip` [H, W]: coverage of the eye's opening.
    """
    inside = clip > CORE
    dark = _dark(image, inside)
    stroke = STROKE * float(inside.any(axis=1).sum())
    (x, y), r = disc.centre, disc.radius
    top, bottom = _ends(dark[:, _band(x, r)].T, inside[:, _band(x, r)].T, y, r, stroke)
    left, right = _ends(dark[_band(y, r)], inside[_band(y, r)], x, r, stroke)
    return SeenIris(((left + right) / 2, (top + bottom) / 2), ((right - left) / 2, (bottom - top) / 2))


def radius_map(iris: SeenIris, shape: tuple[int, ...]) -> NDArray[np.float64]:
    """Distance of each pixel centre from the iris's, in its radii: 1 at its edge."""
    y, x = np.mgrid[: shape[0], : shape[1]] + 0.5
    return np.hypot((x - iris.centre[0]) / iris.radii[0], (y - iris.centre[1]) / iris.radii[1])


def light_part(image: NDArray[np.float32], inside: Mask) -> Mask:
    """What of an open eye is its white; all of it where nothing stands out."""
    return inside & ~_dark(image, inside)


def _dark(image: NDArray[np.float32], inside: Mask) -> Mask:
    """Pixels near the darkest inside; none where lightness hardly differs."""
    if not inside.any():
        return inside
    lightness = image.mean(axis=2)
    dark, light = np.percentile(lightness[inside], (5, 95))
    if light - dark < LEAST_CONTRAST:
        return np.zeros(inside.shape, bool)
    return inside & (lightness < dark + DARK * (light - dark))


def _band(middle: float, radius: float) -> slice:
    return slice(max(0, round(middle - BAND * radius)), max(0, round(middle + BAND * radius) + 1))


def _ends(band: Mask, inside: Mask, middle: float, radius: float, stroke: float) -> tuple[float, float]:
    """From `middle` ± `radius` outwards to where less than half of the `band` [w, n] is dark.

    A stroke along the edge of what is `inside` the opening is left out.
    """
    if not band.size:
        return middle - radius, middle + radius
    dark, open_ = band.mean(axis=0) >= 0.5, inside.mean(axis=0) >= 0.5
    below = _reach(dark[::-1], open_[::-1], len(dark) - middle, radius, stroke)
    return middle - below, middle + _reach(dark, open_, middle, radius, stroke)


def _reach(dark: Mask, inside: Mask, middle: float, radius: float, stroke: float) -> float:
    """How far beyond `middle` the dark goes on, no less than `radius`."""
    end = start = round(middle + radius)
    while 0 <= end < len(dark) and dark[end]:
        end += 1
    if end == start:
        return radius
    at_edge = end == len(inside) or not inside[end]
    return max(radius, end - middle - (stroke if at_edge else 0.0))
