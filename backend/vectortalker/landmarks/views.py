"""A picture becomes the views in which a face may be easier to find than in the picture as it is.

The detector was trained on photographs. Hatching, screentone and hard outlines hide a face from unfiltered sampling;
a smoothed copy shows it again. Exposure is stretched, faces that fill the frame get a margin, and tilted heads are
turned upright.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import radians

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from vectortalker.landmarks.window import Window

SMOOTH_SIDE = 256  # twice the detector's input: outlines survive, hatching does not
MARGIN = 2.0
TILTS = (35, -35, 90, -90, 180)
TILTED_MARGIN = 1.2  # keeps the corners of the turned picture inside
TARGET_MEDIAN = 0.45


@dataclass(frozen=True)
class View:
    """Pixels to detect in, and the window to look through."""

    image: NDArray[np.uint8]
    window: Window
    upright: bool


def plain_view(image: NDArray[np.uint8]) -> View:
    return View(image, Window.square_around(image), upright=True)


def other_views(image: NDArray[np.uint8]) -> Iterator[View]:
    smoothed = _smooth(image)
    for pixels in (smoothed, _smooth(_stretch_exposure(image))):
        yield View(pixels, Window.square_around(image), upright=True)
        yield View(pixels, _enlarged(image, MARGIN, 0), upright=True)
    for tilt in TILTS:
        yield View(image, _enlarged(image, TILTED_MARGIN, tilt), upright=False)
        yield View(smoothed, _enlarged(image, TILTED_MARGIN, tilt), upright=False)


def _enlarged(image: NDArray[np.uint8], factor: float, degrees: float) -> Window:
    square = Window.square_around(image)
    side = square.width * factor
    return Window(square.cx, square.cy, side, side, radians(degrees))


def _smooth(image: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Detail finer than 1 / SMOOTH_SIDE of the long side averaged away, same size."""
    height, width = image.shape[:2]
    scale = SMOOTH_SIDE / max(height, width)
    small = (max(1, round(width * scale)), max(1, round(height * scale)))
    picture = Image.fromarray(image).resize(small, Image.Resampling.BOX)
    return np.asarray(picture.resize((width, height), Image.Resampling.BICUBIC))


def _stretch_exposure(image: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Grey; 1st and 99th percentile to black and white, then the gamma that brings the median to TARGET_MEDIAN."""
    grey = image.mean(axis=2, keepdims=True).repeat(3, axis=2)
    low, high = np.percentile(grey, [1, 99])
    unit = np.clip((grey - low) / max(high - low, 1), 0, 1)
    gamma = np.log(TARGET_MEDIAN) / np.log(np.clip(np.median(unit), 0.02, 0.98))
    return np.rint(255 * unit**gamma).astype(np.uint8)
