"""Turns a drawing and the points of one frame into pixels, by Skia.

Looks like the static SVG does in a browser: painter's order, gradients interpolated unpremultiplied in sRGB, local
paths clipped by their opening with an antialiased edge.
"""

from __future__ import annotations

from collections.abc import Iterable
from itertools import groupby

import numpy as np
import skia
from numpy.typing import NDArray

from vectortalker.animate.drawing import Drawing, Points
from vectortalker.schema import Fill, HexColour, LinearFill

Rgba = NDArray[np.uint8]  # [height, width, 4], opaque


def frame_size(drawing: Drawing, longer_side: int, *, even: bool) -> tuple[int, int]:
    """Width and height in pixels whose longer one is about `longer_side`; video codecs want both even."""
    scale = longer_side / max(drawing.width, drawing.height)
    unit = 2 if even else 1
    width, height = (max(unit, unit * round(side * scale / unit)) for side in (drawing.width, drawing.height))
    return width, height


def render_frame(drawing: Drawing, points: Points, size: tuple[int, int], background: HexColour | None = None) -> Rgba:
    """Pixels of one frame `points` [N, 2] at `size` (width, height); `background` stands in for the canvas colour."""
    return FrameRenderer(drawing, size, background).render(points)


class FrameRenderer:
    """Renders many frames of one drawing; keeps the picture of the layer that never moves and outlines that rested."""

    def __init__(self, drawing: Drawing, size: tuple[int, int], background: HexColour | None = None) -> None:
        self._drawing = drawing
        self._surface = skia.Surface.MakeRaster(skia.ImageInfo.MakeN32Premul(*size))
        self._background = _colour(background or drawing.canvas)
        self._scale = size[0] / drawing.width, size[1] / drawing.height
        linear = np.flatnonzero(drawing.linear).tolist()
        self._gradient_rows = {path: int(drawing.bounds[-1]) + 2 * rank for rank, path in enumerate(linear)}
        self._visible = [_paints(fill) for fill in drawing.fills]
        self._points: Points | None = None
        self._outlines = [skia.Path() for _ in drawing.bounds[:-1]]
        self._back: skia.Image | None = None

    def render(self, points: Points) -> Rgba:
        """Pixels of the frame `points` [N, 2]."""
        self._update_outlines(points)
        back, fore, local = self._drawing.layers
        canvas = self._surface.getCanvas()
        canvas.save()
        canvas.scale(*self._scale)
        if self._back is None:
            canvas.clear(self._background)
            self._paint(canvas, back, points)
            self._back = self._surface.makeImageSnapshot()
        else:
            canvas.drawImageRect(self._back, skia.Rect(self._drawing.width, self._drawing.height))
        self._paint(canvas, fore, points)
        for opening, run in groupby(local, key=lambda path: int(self._drawing.openings[path])):
            canvas.save()
            canvas.clipPath(self._outlines[len(self._drawing.fills) + opening], skia.ClipOp.kIntersect, True)
            self._paint(canvas, run, points)
            canvas.restore()
        canvas.restore()
        return self._surface.toarray(colorType=skia.kRGBA_8888_ColorType)

    def _paint(self, canvas: skia.Canvas, paths: Iterable[int], points: Points) -> None:
        for path in paths:
            if self._visible[path]:
                canvas.drawPath(self._outlines[path], self._paint_of(path, points))

    def _paint_of(self, path: int, points: Points) -> skia.Paint:
        fill = self._drawing.fills[path]
        paint = skia.Paint(AntiAlias=True)
        if isinstance(fill, LinearFill):
            row = self._gradient_rows[path]
            paint.setShader(_gradient(fill, points[row : row + 2]))
        else:
            paint.setColor(_colour(fill.colour, fill.opacity))
        return paint

    def _update_outlines(self, points: Points) -> None:
        """Rebuild the outlines of paths and openings whose points differ from the last frame's."""
        bounds = self._drawing.bounds
        if self._points is None:
            moved = np.arange(len(bounds) - 1)
        else:
            n_changed = np.concatenate(([0], np.cumsum((points != self._points).any(axis=1))))
            moved = np.flatnonzero(np.diff(n_changed[bounds]))
        for index in moved:
            self._outlines[index] = _outline(points[bounds[index] : bounds[index + 1]])
        self._points = points.copy()


def _outline(points: Points) -> skia.Path:
    """Closed chain of cubics through `points` [3S, 2]."""
    path = skia.Path()
    if len(points) == 0:
        return path
    rows = [*points.tolist(), points[0].tolist()]
    path.moveTo(*rows[0])
    for j in range(1, len(rows), 3):
        path.cubicTo(*rows[j], *rows[j + 1], *rows[j + 2])
    path.close()
    return path


def _paints(fill: Fill) -> bool:
    return fill.opacity > 0 if fill.kind == "solid" else any(stop.opacity > 0 for stop in fill.stops)


def _gradient(fill: LinearFill, ends: Points) -> skia.Shader:
    """Gradient between `ends` [2, 2]; where they coincide the last stop paints all, as SVG 2 says."""
    start, end = ends.tolist()
    colours = [_colour(stop.colour, stop.opacity) for stop in fill.stops]
    if start == end:
        return skia.Shaders.Color(colours[-1])
    return skia.GradientShader.MakeLinear([skia.Point(*start), skia.Point(*end)], colours)


def _colour(colour: HexColour, opacity: float = 1.0) -> int:
    return skia.ColorSetARGB(round(255 * opacity), *bytes.fromhex(colour[1:]))
