"""Where the portrait lies in the working picture: the fit of a renderer that scales the SVG to the picture's size."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from vectortalker.scene import Layer


@dataclass(frozen=True)
class Frame:
    """Working picture of `width` × `height` px that shows a portrait, uniformly scaled by `scale` and centred.

    Its sides are rounded to whole pixels, so up to half a pixel is left over: `offset_x`, `offset_y`.
    """

    width: int
    height: int
    scale: float
    offset_x: float
    offset_y: float


def fit(portrait_width: int, portrait_height: int, width: int, height: int) -> Frame:
    """SVG's `preserveAspectRatio="xMidYMid meet"`."""
    scale = min(width / portrait_width, height / portrait_height)
    return Frame(width, height, scale, (width - scale * portrait_width) / 2, (height - scale * portrait_height) / 2)


def to_frame(points: NDArray[np.float64], frame: Frame) -> NDArray[np.float64]:
    """Portrait px [..., 2] to working px."""
    return points * frame.scale + np.array([frame.offset_x, frame.offset_y])


def layer_to_level(layer: Layer, frame: Frame, level: tuple[int, int]) -> Layer:
    """Portrait px to pixels of a level (width, height), which shows the whole working picture."""
    stretch = np.array(level) / (frame.width, frame.height)
    points = (to_frame(layer.points.astype(np.float64), frame) * stretch).astype(np.float32)
    ends = to_frame(layer.axis.astype(np.float64).reshape(-1, 2, 2), frame) * stretch
    return Layer(points, layer.stops, ends.reshape(-1, 4).astype(np.float32), layer.gradient, layer.part)


def layer_to_portrait(layer: Layer, frame: Frame, level: tuple[int, int]) -> Layer:
    """Pixels of a level (width, height), which shows the whole working picture, to portrait px."""
    stretch = np.array([frame.width, frame.height]) / np.array(level) / frame.scale
    offset = np.array([frame.offset_x, frame.offset_y]) / frame.scale
    points = (layer.points * stretch - offset).astype(np.float32)
    axis = (layer.axis * np.tile(stretch, 2) - np.tile(offset, 2)).astype(np.float32)
    return Layer(points, layer.stops, axis, layer.gradient, layer.part)
