"""Seed centres become the first shape and fill of new paths: circles, or outlines of the residual's component."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import vectortalker_core as core
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter

from vectortalker.scene import STOPS

WINDOW = 2.5  # half side of the window a component may fill, in radii
COMPONENT_BLUR = 0.2  # standard deviation that smooths the component's outline, in radii
COMPONENT_LEVEL = 0.4  # outline at this share of the mean residual over the disc
MIN_COMPONENT = 6  # px; smaller components start as circles
START_OPACITY = 0.9
FIT_RIDGE = 1e-3  # keeps colour slopes of a few pixels finite, in px² a pixel

# Handles of the cubic through a, b, c, d at t = 0, 1/3, 2/3, 1.
THROUGH = np.array([[-5, 18, -9, 2], [2, -9, 18, -5]], np.float64) / 6


@dataclass(frozen=True)
class Start:
    """A new path: `points` f32 [3S, 2], `stops` f32 [3, 4], `axis` f32 [4]."""

    points: NDArray[np.float32]
    stops: NDArray[np.float32]
    axis: NDArray[np.float32]


def circle(centre: tuple[float, float], radius: float, segments: int) -> NDArray[np.float32]:
    """Control points [3S, 2] of a circle of `segments` cubics, within 1e-5 radii for 8."""
    step = 2 * np.pi / segments
    reach = 4 / 3 * np.tan(step / 4)
    angle = step * np.arange(segments)
    points = np.empty((segments, 3, 2))
    radial = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    tangent = np.stack([-radial[:, 1], radial[:, 0]], axis=1)
    points[:, 0] = radial
    points[:, 1] = radial + reach * tangent
    points[:, 2] = np.roll(radial - reach * tangent, -1, axis=0)
    return (np.asarray(centre) + radius * points.reshape(-1, 2)).astype(np.float32)


def circle_start(target: NDArray[np.float32], centre: tuple[int, int], radius: float, segments: int) -> Start:
    """Circle with the mean colour of `target` [H, W, 3] over 0.7 radii."""
    window, (x0, y0) = _window(target, centre, 0.7 * radius)
    y, x = np.mgrid[: window.shape[0], : window.shape[1]]
    inside = (x + x0 - centre[0]) ** 2 + (y + y0 - centre[1]) ** 2 <= max(1.0, 0.7 * radius) ** 2
    colour = window[inside].mean(axis=0)
    stops = np.tile(np.append(colour, START_OPACITY), (STOPS, 1)).astype(np.float32)
    middle = (centre[0] + 0.5, centre[1] + 0.5)
    axis = np.array([middle[0] - radius, middle[1], middle[0] + radius, middle[1]], np.float32)
    return Start(circle(middle, radius, segments), stops, axis)


def contour_start(
    target: NDArray[np.float32],
    residual: NDArray[np.float32],
    claimed: NDArray[np.bool_],
    centre: tuple[int, int],
    radius: float,
    segments: int,
) -> Start:
    """Outline and colours of the residual's component at `centre`; a circle where it has none to speak of.

    The component is the 4-connected set of pixels whose blurred residual (`residual` [H, W, 3] = target − picture where
    `claimed` [H, W], else 0), taken along its own mean direction over the disc, passes `COMPONENT_LEVEL` of that mean.
    """
    reach = WINDOW * radius
    (error, (x0, y0)), (near, _) = (_claimed_window(residual, claimed, centre, r) for r in (reach, 0.8 * radius))
    direction = near.reshape(-1, 3).mean(axis=0)
    strength = float(np.linalg.norm(direction))
    if strength == 0:
        return circle_start(target, centre, radius, segments)
    blurred = gaussian_filter(error @ (direction / strength), max(0.5, COMPONENT_BLUR * radius), mode="nearest")
    found = core.contour(np.asarray(blurred, np.float32), centre[0] - x0, centre[1] - y0, COMPONENT_LEVEL * strength)
    if found is None or np.count_nonzero(found[0]) < MIN_COMPONENT:
        return circle_start(target, centre, radius, segments)
    component, outline = found
    closed = np.concatenate([outline, outline[:1]]).astype(np.float64)
    points = through_samples(closed + np.array([x0 + 0.5, y0 + 0.5]), segments)
    window, _ = _window(target, centre, reach)
    stops, axis = affine_fill(window, component, (x0, y0))
    return Start(points, stops, axis)


def _window(image: NDArray, centre: tuple[int, int], reach: float) -> tuple[NDArray, tuple[int, int]]:
    half = max(1, round(reach))
    x0, y0 = max(0, centre[0] - half), max(0, centre[1] - half)
    return image[y0 : centre[1] + half + 1, x0 : centre[0] + half + 1], (x0, y0)


def _claimed_window(
    residual: NDArray[np.float32], claimed: NDArray[np.bool_], centre: tuple[int, int], reach: float
) -> tuple[NDArray[np.float32], tuple[int, int]]:
    error, corner = _window(residual, centre, reach)
    return error * _window(claimed, centre, reach)[0][..., None], corner


def through_samples(outline: NDArray[np.float64], segments: int) -> NDArray[np.float32]:
    """Control points [3S, 2] of cubics through 3S samples at equal arc lengths of a closed `outline` [m, 2]."""
    lengths = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(outline, axis=0), axis=1)))
    at = np.linspace(0, lengths[-1], 3 * segments, endpoint=False)
    samples = np.stack([np.interp(at, lengths, outline[:, axis]) for axis in (0, 1)], axis=1)
    quads = np.stack([np.roll(samples, -k, axis=0)[::3] for k in range(4)], axis=1)  # [S, 4, 2]
    points = np.empty((segments, 3, 2))
    points[:, 0] = quads[:, 0]
    points[:, 1:] = np.einsum("hk,skd->shd", THROUGH, quads)
    return points.reshape(-1, 2).astype(np.float32)


def affine_fill(
    window: NDArray[np.float32], inside: NDArray[np.bool_], origin: tuple[int, int]
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Gradient nearest to the colours of `window` [h, w, 3] where `inside`: stops [3, 4] and axis [4].

    Least squares colour = mean + slope·(p − centre) per channel; the axis follows the direction in which the channels
    change most together and spans the pixels' extent along it. Colours are cut to [0, 1].
    """
    y, x = np.nonzero(inside)
    colours = window[inside].astype(np.float64)
    position = np.stack([x, y], axis=1).astype(np.float64)
    middle = position.mean(axis=0)
    offset = position - middle
    mean = colours.mean(axis=0)
    moments = offset.T @ offset + FIT_RIDGE * len(offset) * np.eye(2)
    slope = np.linalg.solve(moments, offset.T @ (colours - mean))  # [2, 3]
    direction = np.linalg.eigh(slope @ slope.T)[1][:, -1]
    along = offset @ direction
    reach = max(1.0, float(np.abs(along).max()))
    change = (direction @ slope) * reach
    limit = np.minimum(mean, 1 - mean).clip(min=0)
    change = np.clip(change, -limit, limit)
    stops = np.empty((STOPS, 4), np.float32)
    stops[:, :3] = mean + np.linspace(-1, 1, STOPS)[:, None] * change
    stops[:, 3] = START_OPACITY
    centre = middle + origin + 0.5
    return stops, np.concatenate([centre - reach * direction, centre + reach * direction]).astype(np.float32)
