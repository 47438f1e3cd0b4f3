"""What goes wrong with a posed portrait, counted: holes, tears, moving scenery, open eyes, bent irises and teeth."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw
from scipy.ndimage import binary_dilation, binary_fill_holes
from vectortalker.animate.drawing import Drawing
from vectortalker.animate.frames import FrameRenderer
from vectortalker.animate.rigged import RiggedScene, frame_points
from vectortalker.schema import Fill, Pose, Scene, SolidFill

MAGENTA, GREEN = "#ff00ff", "#00ff00"
TOLERANCE = 2  # of 255
SEES_THROUGH = 16  # of 255 between magenta and green: a sixteenth of what lies behind
ROW_NOISE = 16  # of 255: how much Skia's antialiasing of an outline depends on what else crosses the row
BORDER = 2  # px of antialiasing round a region
EYE_PARTS = ("left_eye", "right_eye", "left_iris", "right_iris")

Mask = NDArray[np.bool_]
Array = NDArray[np.float64]


@dataclass(frozen=True)
class PoseFigures:
    """Of one pose, in pixels: `holes` through the picture and `tears` in the fore layer that rest lacks, `strayed`
    changes outside moved triangles and openings, `eyes` of the eyeballs' paths that show. `iris`, `teeth`: largest
    change of shape and of size, as a share. `held`: share of the motion that was carried out.
    """

    holes: int
    tears: int
    strayed: int
    eyes: int
    iris: float
    teeth: float
    held: float


class Sitting:
    """A rigged portrait rendered at `size` px, with its rest pose to compare with."""

    def __init__(self, rigged: RiggedScene, scene: Scene, size: tuple[int, int]) -> None:
        self._rigged, self._scale = rigged, size[0] / scene.width
        self._parts = [None] * (len(scene.back) + len(scene.fore)) + [path.part for path in scene.local]
        drawing = rigged.drawing
        self.renderer = FrameRenderer(drawing, size)
        self._over = [FrameRenderer(drawing, size, colour) for colour in (MAGENTA, GREEN)]
        self._fore = [FrameRenderer(_without_back(drawing), size, colour) for colour in (MAGENTA, GREEN)]
        self._eyes = [FrameRenderer(self._eyes_painted(colour), size) for colour in (MAGENTA, GREEN)]
        self._rest = self.renderer.render(rigged.rest).astype(np.int16)
        self._rest_holes = _apart(self._over, rigged.rest) > TOLERANCE
        self._rest_tears = int(_tears(self._fore, rigged.rest).sum())

    def figures(self, pose: Pose) -> PoseFigures:
        posed = self._rigged.rig.vertices(pose)
        points = frame_points(self._rigged, posed.vertices)
        changed = np.abs(self.renderer.render(points).astype(np.int16) - self._rest).max(axis=2) > ROW_NOISE
        iris, teeth = self._shapes(points)
        return PoseFigures(
            holes=int(((_apart(self._over, points) > TOLERANCE) & ~self._rest_holes).sum()),
            tears=max(0, int(_tears(self._fore, points).sum()) - self._rest_tears),
            strayed=int((changed & ~self._moved_region(posed.vertices)).sum()),
            eyes=int((_apart(self._eyes, points) > SEES_THROUGH).sum()),
            iris=iris,
            teeth=teeth,
            held=posed.scale,
        )

    def picture(self, points: Array, size: tuple[int, int]) -> NDArray[np.uint8]:
        """One frame u8 [H, W, 4] at another size."""
        return FrameRenderer(self._rigged.drawing, size).render(points)

    def _eyes_painted(self, colour: str) -> Drawing:
        fills = self._rigged.drawing.fills
        painted = [SolidFill(colour=colour) if p in EYE_PARTS else f for p, f in zip(self._parts, fills, strict=True)]
        return replace(self._rigged.drawing, fills=_all_linear_kept(fills, painted))

    def _moved_region(self, vertices: Array) -> Mask:
        """Triangles with a vertex that moved and the openings, before and after."""
        rest, rig = self._rigged.rig.rest_vertices, self._rigged.rig
        triangles = rig.triangles[(vertices != rest).any(axis=1)[rig.triangles].any(axis=1)]
        outlines = [_polyline(outline) for state in (rest, vertices) for outline in rig.openings(state)]
        height, width = self._rest.shape[:2]
        region = Image.new("1", (width, height))
        pen = ImageDraw.Draw(region)
        for corners in (*rest[triangles], *vertices[triangles], *outlines):
            pen.polygon((corners * self._scale - 0.5).ravel().tolist(), fill=1)
        return np.asarray(binary_dilation(np.asarray(region), iterations=BORDER), bool)

    def _shapes(self, points: Array) -> tuple[float, float]:
        """Largest change of an iris path's spread ratio and of a tooth path's size against rest."""
        bounds, rest = self._rigged.drawing.bounds, self._rigged.rest
        iris = teeth = 0.0
        for path, part in enumerate(self._parts):
            span = slice(bounds[path], bounds[path + 1])
            if part in ("left_iris", "right_iris"):
                iris = max(iris, abs(_ratio(points[span]) / _ratio(rest[span]) - 1))
            elif part in ("mouth_upper", "mouth_lower"):
                teeth = max(teeth, abs(_extent(points[span]) / _extent(rest[span]) - 1))
        return iris, teeth


def _apart(renderers: list[FrameRenderer], points: Array) -> NDArray[np.int16]:
    first, second = (renderer.render(points)[..., :3].astype(np.int16) for renderer in renderers)
    return np.abs(first - second).max(axis=2)


def _tears(renderers: list[FrameRenderer], points: Array) -> Mask:
    """Places enclosed by the fore layer at which it lets through what lies behind."""
    opaque = _apart(renderers, points) <= SEES_THROUGH
    return np.asarray(binary_fill_holes(opaque), bool) & ~opaque


def _without_back(drawing: Drawing) -> Drawing:
    """The same drawing with the back layer's paths painted with nothing."""
    nothing: Fill = SolidFill(colour="#000000", opacity=0)
    hidden = [nothing] * drawing.n_back + list(drawing.fills[drawing.n_back :])
    return replace(drawing, fills=_all_linear_kept(drawing.fills, hidden))


def _all_linear_kept(before: tuple[Fill, ...], after: list[Fill]) -> tuple[Fill, ...]:
    """`after` with a gradient of one colour where `before` has a gradient: frames hold the ends of just as many."""
    kept = []
    for old, new in zip(before, after, strict=True):
        if old.kind == "linear" and new.kind == "solid":
            stop = {"colour": new.colour, "opacity": new.opacity}
            new = old.model_copy(update={"stops": tuple(type(old.stops[0]).model_validate(stop) for _ in old.stops)})
        kept.append(new)
    return tuple(kept)


def _ratio(points: Array) -> float:
    """Of the smaller to the larger spread of control points: 1 for a circle, unchanged by similarities."""
    spread = np.linalg.eigvalsh(np.cov(points.T))
    return float(np.sqrt(spread[0] / max(spread[1], 1e-12)))


def _extent(points: Array) -> float:
    return float(np.sqrt(np.trace(np.cov(points.T))))


def _polyline(chain: Array) -> Array:
    """Points of a closed cubic chain [3S, 2], eight a segment."""
    t = np.linspace(0, 1, 8, endpoint=False)[:, None]
    controls = [np.roll(chain, -k, axis=0)[::3] for k in range(4)]
    basis = ((1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3)
    curves = sum(weight * control[:, None] for weight, control in zip(basis, controls, strict=True))
    return np.asarray(curves).reshape(-1, 2)
