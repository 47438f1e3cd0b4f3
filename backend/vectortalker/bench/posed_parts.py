"""Irises and teeth of a posed portrait, as they are painted: whether they keep their shape, size and look."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from vectortalker.animate.drawing import Drawing, Points
from vectortalker.animate.frames import FrameRenderer, frame_size
from vectortalker.animate.rigged import RiggedScene, Vertices
from vectortalker.bench.posed_views import IRISES, TEETH
from vectortalker.schema import Fill, HexColour, Part

SIDE = 1024  # px of the longer side: an iris then has hundreds of pixels, and its moments are good to a few per mille
EYEBALLS: dict[Part, Part] = {"left_iris": "left_eye", "right_iris": "right_eye"}  # what irises show among
LEAST_AREA = 30.0  # px² below which antialiasing is all there is to measure
IRIS_SIDE = 96  # px across an iris whose look is compared
UNLIKE = 32  # of 255 in one channel
EYES = ((36, 39), (42, 45))  # corners: vertices by which the rig places an eyeball
FIRST_IRIS = 68  # vertex of the image-left iris
WHOLE = 250  # of 255: a pixel of an opening that is not at its edge

Mask = NDArray[np.bool_]


@dataclass(frozen=True)
class Blot:
    """What a part paints: area in px², and its smaller over its larger spread, 1 for a disc and for next to nothing."""

    area: float
    roundness: float


class PaintedParts:
    """Irises as they show among their eyeball's paths, and teeth; clipped neither by lids nor by lips."""

    def __init__(self, drawing: Drawing, parts: list[Part | None]) -> None:
        size = frame_size(drawing, SIDE, even=False)
        unclipped = replace(drawing, n_fore=len(drawing.fills) - drawing.n_back, canvas="#000000")
        self._renderers: dict[Part, FrameRenderer] = {}
        for shown in (*IRISES, *TEETH):
            colours: dict[Part | None, HexColour] = {shown: "#ffffff"}
            if shown in EYEBALLS:
                colours[EYEBALLS[shown]] = "#000000"
            self._renderers[shown] = FrameRenderer(only(unclipped, parts, colours), size)

    def blots(self, points: Points, parts: Iterable[Part]) -> dict[Part, Blot]:
        """Of these irises and rows of teeth in the frame `points` [N, 2]."""
        return {part: _blot(self._renderers[part].render(points)[..., 0]) for part in parts}


class IrisLook:
    """One eye's iris as it is seen through the opening, brought back to where it rests."""

    def __init__(self, rigged: RiggedScene, parts: list[Part | None], radius: float, eye: int) -> None:
        iris, ball = list(EYEBALLS.items())[eye]
        near = replace(rigged.drawing, width=2 * radius, height=2 * radius, canvas="#000000")
        seen = tuple(f if p in (iris, ball) else hidden(f) for f, p in zip(near.fills, parts, strict=True))
        side = (IRIS_SIDE, IRIS_SIDE)
        self._picture = FrameRenderer(replace(near, fills=seen), side)
        self._visible = FrameRenderer(only(near, parts, {iris: "#ffffff", ball: "#ffffff"}), side)
        self._rigged, self._radius, self._corners, self._centre = rigged, radius, EYES[eye], FIRST_IRIS + eye

    def unlike(self, points: Points, vertices: Vertices) -> float:
        """Share of the iris's disc, where it is seen at rest and in the frame `points`, whose colours differ."""
        before = self._seen(self._rigged.rest, self._rigged.rig.rest_vertices)
        after = self._seen(points, vertices)
        visible = before[1] & after[1]
        changed = np.abs(after[0] - before[0]).max(axis=2) > UNLIKE
        return float((changed & visible).sum() / max(int(visible.sum()), LEAST_AREA))

    def _seen(self, points: Points, vertices: Vertices) -> tuple[NDArray[np.int16], Mask]:
        """Picture of the disc's square, and where the disc shows in it."""
        a, b = (
            state[self._corners[1]] - state[self._corners[0]] for state in (self._rigged.rig.rest_vertices, vertices)
        )
        turn = complex(*a) / complex(*b)
        away = (points - vertices[self._centre]) @ np.array([[turn.real, turn.imag], [-turn.imag, turn.real]])
        placed = away + self._radius
        picture = self._picture.render(placed)[..., :3].astype(np.int16)
        y, x = np.mgrid[:IRIS_SIDE, :IRIS_SIDE] + 0.5 - IRIS_SIDE / 2
        return picture, (self._visible.render(placed)[..., 0] > WHOLE) & (np.hypot(x, y) < IRIS_SIDE / 2)


def only(drawing: Drawing, parts: list[Part | None], colours: Mapping[Part | None, HexColour]) -> Drawing:
    """The parts named in `colours` painted with these, and nothing else."""
    fills = zip(drawing.fills, parts, strict=True)
    return replace(drawing, fills=tuple(coloured(f, colours[p]) if p in colours else hidden(f) for f, p in fills))


def coloured(fill: Fill, colour: HexColour) -> Fill:
    """One colour with the fill's own opacity; a gradient stays one, because frames hold its ends."""
    return _changed(fill, {"colour": colour})


def hidden(fill: Fill) -> Fill:
    """A fill that paints nothing."""
    return _changed(fill, {"opacity": 0.0})


def _changed(fill: Fill, change: dict[str, object]) -> Fill:
    if fill.kind == "solid":
        return fill.model_copy(update=change)
    return fill.model_copy(update={"stops": [stop.model_copy(update=change) for stop in fill.stops]})


def _blot(mask: NDArray[np.uint8]) -> Blot:
    weight = mask / 255
    area = float(weight.sum())
    if area < LEAST_AREA:
        return Blot(area, 1.0)
    rows, columns = weight.sum(axis=1), weight.sum(axis=0)
    y = np.arange(len(rows)) - np.arange(len(rows)) @ rows / area
    x = np.arange(len(columns)) - np.arange(len(columns)) @ columns / area
    mixed = y @ weight @ x
    spread = np.linalg.eigvalsh([[x**2 @ columns, mixed], [mixed, y**2 @ rows]])
    return Blot(area, float(np.sqrt(spread[0] / spread[1])))
