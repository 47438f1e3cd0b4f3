"""What goes wrong with a posed portrait, counted: holes, tears, moving scenery, open eyes, bent irises and teeth."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw
from scipy.ndimage import binary_dilation

from vectortalker.animate.drawing import Drawing, Points
from vectortalker.animate.frames import FrameRenderer
from vectortalker.animate.rigged import RiggedScene, frame_points
from vectortalker.bench.posed_parts import EYEBALLS, LEAST_AREA, Blot, IrisLook, PaintedParts, coloured
from vectortalker.bench.posed_tears import GROUNDS, SEES_THROUGH, Tears, on_both
from vectortalker.bench.posed_views import FULL_BLINK, IRISES, TEETH
from vectortalker.schema import HexColour, Landmarks, Part, Pose, Scene

TOLERANCE = 2  # of 255
ROW_NOISE = 16  # of 255: how much Skia's antialiasing of an outline depends on what else crosses the row
BORDER = 2  # px of antialiasing round a region
EYE_PARTS = (*EYEBALLS.keys(), *EYEBALLS.values())

SHUT = Pose(articulators=FULL_BLINK)

Mask = NDArray[np.bool_]


@dataclass(frozen=True)
class PoseFigures:
    """Of one pose, in pixels: `holes` through the picture and `tears` in the fore layer that rest lacks, `strayed`
    changes outside moved triangles and openings, `eyes` of the eyeballs' paths that show when these are shut.

    Largest change against rest, as a share: `iris_shape` of an iris's roundness, `iris_size` and `teeth_size` of an
    area, `iris_look` of the irises' pixels that have another colour. `held`: share of the motion that was carried out.
    """

    holes: int
    tears: int
    strayed: int
    eyes: int
    iris_shape: float
    iris_size: float
    iris_look: float
    teeth_size: float
    held: float


class Sitting:
    """A rigged portrait rendered at `size` px, with its rest pose to compare with."""

    def __init__(self, rigged: RiggedScene, scene: Scene, landmarks: Landmarks, size: tuple[int, int]) -> None:
        self._rigged, self._scale = rigged, size[0] / scene.width
        drawing = rigged.drawing
        nowhere: list[Part | None] = [None] * (len(scene.back) + len(scene.fore))
        parts = [*nowhere, *(path.part for path in scene.local)]
        self._over = [FrameRenderer(drawing, size, colour) for colour in GROUNDS]
        self._eyes = [FrameRenderer(self._eyes_painted(parts, colour), size) for colour in GROUNDS]
        self._tears = Tears(rigged, size)
        self._parts = PaintedParts(drawing, parts)
        irises = landmarks.irises or ()
        self._looks = [IrisLook(rigged, parts, iris.radius, eye) for eye, iris in enumerate(irises)]
        self._rest, self._rest_holes = on_both(self._over, rigged.rest)
        self._rest_parts = self._parts.blots(rigged.rest, (*IRISES, *TEETH))

    def figures(self, pose: Pose, parts: tuple[Part, ...]) -> PoseFigures:
        """`parts`: those whose shape and size are measured, irises or teeth."""
        posed = self._rigged.rig.vertices(pose)
        points = frame_points(self._rigged, posed.vertices)
        picture, holes = on_both(self._over, points)
        changed = np.abs(picture - self._rest).max(axis=2) > ROW_NOISE
        now = self._parts.blots(points, parts)
        looks = self._looks if parts == IRISES else []
        return PoseFigures(
            holes=int(((holes > TOLERANCE) & (self._rest_holes <= TOLERANCE)).sum()),
            tears=self._tears.count(points, posed.vertices),
            strayed=int((changed & ~self._moved_region(posed.vertices)).sum()),
            eyes=int((on_both(self._eyes, points)[1] > SEES_THROUGH).sum()) if pose == SHUT else 0,
            iris_shape=self._largest_change(now, IRISES, lambda blot: blot.roundness),
            iris_size=self._largest_change(now, IRISES, lambda blot: blot.area),
            iris_look=max((look.unlike(points, posed.vertices) for look in looks), default=0.0),
            teeth_size=self._largest_change(now, TEETH, lambda blot: blot.area),
            held=posed.scale,
        )

    def _eyes_painted(self, parts: list[Part | None], colour: HexColour) -> Drawing:
        fills = zip(self._rigged.drawing.fills, parts, strict=True)
        painted = tuple(coloured(fill, colour) if part in EYE_PARTS else fill for fill, part in fills)
        return replace(self._rigged.drawing, fills=painted)

    def _largest_change(self, now: dict[Part, Blot], parts: tuple[Part, ...], value: Callable[[Blot], float]) -> float:
        """Of the parts that were measured and paint anything at rest, as a share."""
        rest = {part: blot for part, blot in self._rest_parts.items() if blot.area >= LEAST_AREA}
        measured: list[Part] = [part for part in parts if part in now and part in rest]
        return max((abs(value(now[part]) / value(rest[part]) - 1) for part in measured), default=0.0)

    def _moved_region(self, vertices: Points) -> Mask:
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


def _polyline(chain: Points) -> Points:
    """Points of a closed cubic chain [3S, 2], eight a segment."""
    t = np.linspace(0, 1, 8, endpoint=False)[:, None]
    controls = [np.roll(chain, -k, axis=0)[::3] for k in range(4)]
    basis = ((1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3)
    curves = sum(weight * control[:, None] for weight, control in zip(basis, controls, strict=True))
    return np.asarray(curves).reshape(-1, 2)
