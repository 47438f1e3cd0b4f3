"""A picture becomes its faces with landmarks, largest first, each with a confidence and whether a fit by hand is advised."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from vectortalker.landmarks.detector import find_faces
from vectortalker.landmarks.ibug import IrisDisc, depth_towards_viewer, ibug_points, iris_discs
from vectortalker.landmarks.mesh import FaceMesh, fit_mesh
from vectortalker.landmarks.views import View, other_views, plain_view

DETECTION_SIDE = 1024  # larger pictures are scaled to it first; the mesh sees 192 px of a face anyway
MIN_SCORE = 0.5
MIN_PRESENCE = 0.5
CLEAR_SCORE = 0.85  # a plain view this good is not looked at again
MIN_TILTED_SCORE, MIN_TILTED_PRESENCE = 0.75, 0.95  # animals and textures reach .73 when turned
TILT_GAIN = 0.08  # a turned view must beat the upright ones by this; an upside-down face scores .8 when read upright


@dataclass(frozen=True)
class FaceDetection:
    """`points` f64 [68, 2] and `mesh` f64 [478, 2] in portrait pixels; `depth` f64 [68] in outer-eye distances."""

    points: NDArray[np.float64]
    depth: NDArray[np.float64]
    irises: tuple[IrisDisc, IrisDisc]
    mesh: NDArray[np.float64]
    confidence: float
    fit_advised: bool

    @property
    def box(self) -> tuple[float, float, float, float]:
        """x, y, width, height of the landmarks."""
        low, high = self.points.min(axis=0), self.points.max(axis=0)
        return float(low[0]), float(low[1]), float(high[0] - low[0]), float(high[1] - low[1])


@dataclass(frozen=True)
class _Found:
    score: float
    mesh: FaceMesh
    view: View


def detect(rgb: NDArray[np.uint8]) -> list[FaceDetection]:
    """Faces of uint8 [H, W, 3]; none is an answer, not an error."""
    small = _scaled(rgb)
    ratio = np.array([rgb.shape[1] / small.shape[1], rgb.shape[0] / small.shape[0]])
    faces = [_detection(found, ratio) for found in _search(small)]
    return sorted(faces, key=lambda face: -face.box[2] * face.box[3])


def _scaled(rgb: NDArray[np.uint8]) -> NDArray[np.uint8]:
    height, width = rgb.shape[:2]
    scale = DETECTION_SIDE / max(height, width)
    if scale >= 1:
        return rgb
    size = (max(1, round(width * scale)), max(1, round(height * scale)))
    return np.asarray(Image.fromarray(rgb).resize(size, Image.Resampling.LANCZOS))


def _search(image: NDArray[np.uint8]) -> list[_Found]:
    """The faces of the view that shows one most clearly."""
    best = _look(plain_view(image))
    if _best_score(best) >= CLEAR_SCORE:
        return best
    for view in other_views(image):
        seen = _look(view)
        needed = _best_score(best) if view.upright else max(MIN_TILTED_SCORE, _best_score(best) + TILT_GAIN)
        if _best_score(seen) > needed:
            best = seen
    return best


def _look(view: View) -> list[_Found]:
    """Faces seen in one view, best first."""
    min_presence = MIN_PRESENCE if view.upright else MIN_TILTED_PRESENCE
    found = []
    for box in find_faces(view.image, view.window):
        if box.score >= MIN_SCORE:
            mesh = fit_mesh(view.image, box.roi)
            if mesh.presence >= min_presence:
                found.append(_Found(box.score, mesh, view))
    return found


def _best_score(found: list[_Found]) -> float:
    return found[0].score if found else 0.0


def _detection(found: _Found, ratio: NDArray[np.float64]) -> FaceDetection:
    """Scales a face of the small picture to portrait pixels. Sample i of the models is the pixel whose centre is i + .5."""
    points = ibug_points(found.mesh.points)
    left, right = iris_discs(found.mesh.points)
    depth = depth_towards_viewer(points)

    def to_portrait(xy: NDArray[np.float64]) -> NDArray[np.float64]:
        return (xy + 0.5) * ratio

    def iris(disc: IrisDisc) -> IrisDisc:
        x, y = to_portrait(np.array(disc.centre))
        return replace(disc, centre=(float(x), float(y)), radius=disc.radius * float(ratio.mean()))

    return FaceDetection(
        points=to_portrait(points[:, :2]),
        depth=depth,
        irises=(iris(left), iris(right)),
        mesh=to_portrait(found.mesh.points[:, :2]),
        confidence=found.score * found.mesh.presence,
        fit_advised=False,
    )
