"""Tears of a posed portrait: spots where the fore layer lets the back through that it hides at rest.

A layer of paths is nowhere quite opaque, and what is translucent at rest stretches with its triangles. Each pixel is
therefore compared with the place where it rests.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw
from scipy.ndimage import binary_fill_holes, maximum_filter

from vectortalker.animate.drawing import Points
from vectortalker.animate.frames import FrameRenderer
from vectortalker.animate.rigged import RiggedScene
from vectortalker.bench.posed_parts import hidden
from vectortalker.rig import Rig
from vectortalker.schema import HexColour

GROUNDS: tuple[HexColour, HexColour] = ("#ff00ff", "#00ff00")
SEES_THROUGH = 16  # of 255 between both grounds: a sixteenth of what lies behind
NEIGHBOURS = 3  # px across: resampling and antialiasing move an edge by less

Picture = NDArray[np.int16]  # [h, w, 3]
SeeThrough = NDArray[np.int16]  # [h, w], 0 opaque … 255


class Tears:
    """Counts the tears of a rigged portrait at `size` px."""

    def __init__(self, rigged: RiggedScene, size: tuple[int, int]) -> None:
        drawing = rigged.drawing
        back, others = drawing.fills[: drawing.n_back], drawing.fills[drawing.n_back :]
        in_front = replace(drawing, fills=(*map(hidden, back), *others))
        self._rig, self._scale = rigged.rig, size[0] / drawing.width
        self._fore = [FrameRenderer(in_front, size, colour) for colour in GROUNDS]
        self._rest = maximum_filter(on_both(self._fore, rigged.rest)[1], NEIGHBOURS)

    def count(self, points: Points, vertices: Points) -> int:
        """Pixels of the frame `points` [N, 2] of `vertices` [V, 2], enclosed by fore paint, that let the back through
        by a sixteenth more than their resting places, which hide it; skin that a cover stills rests where it is.
        """
        now = on_both(self._fore, points)[1]
        places = resting_places(self._rig, vertices, self._scale, now.shape)
        columns, rows = (places[..., axis].clip(0, now.shape[1 - axis] - 1) for axis in (0, 1))
        at_rest = np.maximum(self._rest[rows, columns], self._rest)
        enclosed = np.asarray(binary_fill_holes(now <= SEES_THROUGH), bool)
        return int((enclosed & (at_rest <= SEES_THROUGH) & (now - at_rest > SEES_THROUGH)).sum())


def on_both(renderers: list[FrameRenderer], points: Points) -> tuple[Picture, SeeThrough]:
    """A frame's picture by the first of two renderers, and how far apart both are."""
    first, second = (renderer.render(points)[..., :3].astype(np.int16) for renderer in renderers)
    return first, np.abs(first - second).max(axis=2)


def resting_places(rig: Rig, vertices: Points, scale: float, shape: tuple[int, ...]) -> NDArray[np.int64]:
    """Pixels [h, w, 2] (x, y) of the resting picture that `vertices` [V, 2] take to each pixel; itself off the mesh.

    `scale`: pixels per portrait pixel.
    """
    height, width = shape
    numbers = Image.new("I", (width, height))
    pen = ImageDraw.Draw(numbers)
    for number, corners in enumerate(vertices[rig.triangles], start=1):
        pen.polygon((corners * scale - 0.5).ravel().tolist(), fill=number)
    number = np.asarray(numbers)
    triangles = rig.triangles[np.maximum(number - 1, 0)]
    a, b, c = (vertices[triangles[..., k]] for k in range(3))
    rest_a, rest_b, rest_c = (rig.rest_vertices[triangles[..., k]] for k in range(3))
    here = (np.stack(np.meshgrid(np.arange(width), np.arange(height)), axis=-1) + 0.5) / scale
    area = _cross(b - a, c - a)
    whole = (number > 0) & (area != 0)
    area = np.where(whole, area, 1)
    to_b, to_c = (_cross(here - a, c - a) / area)[..., None], (_cross(b - a, here - a) / area)[..., None]
    rest = rest_a + to_b * (rest_b - rest_a) + to_c * (rest_c - rest_a)
    return np.floor(np.where(whole[..., None], rest, here) * scale).astype(np.int64)


def _cross(u: Points, v: Points) -> Points:
    return u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]
