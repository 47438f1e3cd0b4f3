"""A picture becomes its faces with landmarks, largest first, each with a confidence and whether to check it by hand."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from vectortalker.landmarks.detector import find_faces
from vectortalker.landmarks.doubt import fit_is_doubtful, wobble
from vectortalker.landmarks.drawn_eyes import drawn_eyes, with_eyes
from vectortalker.landmarks.drawn_mouth import MOUTH, drawn_mouth
from vectortalker.landmarks.ibug import IrisDisc, depth_towards_viewer, ibug_points, iris_discs, outer_eye_distance
from vectortalker.landmarks.mesh import FaceMesh, fit_mesh, roi_around
from vectortalker.landmarks.views import View, other_views, plain_view
from vectortalker.landmarks.window import Window

DETECTION_SIDE = 1024  # larger pictures are scaled to it first; the mesh sees 192 px of a face anyway
MIN_SCORE = 0.5
MIN_PRESENCE = 0.5
CLEAR_SCORE = 0.85  # a plain view this good is not looked at again
MIN_TILTED_SCORE, MIN_TILTED_PRESENCE = 0.75, 0.95  # animals and textures reach .73 when turned
PRESENCE_SLACK = 0.95  # the plain picture's fit may be this much less certain than the view's
TURNED_ROI_MARGIN = 1.4
MAX_SURPRISE = 0.06  # outer-eye distances between the mesh's eyes or mouth and the drawn ones
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
    roi: Window
    mesh: FaceMesh
    image: NDArray[np.uint8]


def detect(rgb: NDArray[np.uint8]) -> list[FaceDetection]:
    """Faces of uint8 [H, W, 3]; none is an answer, not an error."""
    small = _scaled(rgb)
    ratio = np.array([rgb.shape[1] / small.shape[1], rgb.shape[0] / small.shape[0]])
    faces = [_as_drawn(_detection(found, small, ratio), rgb) for found in _search(small)]
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
    best = _look(plain_view(image), MIN_SCORE)
    if _best_score(best) >= CLEAR_SCORE:
        return best
    for view in other_views(image):
        best_score = max(_best_score(best), MIN_SCORE)
        needed = best_score if view.upright else max(MIN_TILTED_SCORE, best_score + TILT_GAIN)
        best = _look(view, needed) or best
    return best


def _look(view: View, needed: float) -> list[_Found]:
    """Faces seen in one view, best first; none if the best does not reach the score `needed`."""
    min_presence = MIN_PRESENCE if view.upright else MIN_TILTED_PRESENCE
    found: list[_Found] = []
    for box in find_faces(view.image, view.window):
        if box.score > (MIN_SCORE if found else needed):
            mesh = fit_mesh(view.image, box.roi)
            if mesh.presence < min_presence:
                continue
            roi = box.roi
            if not view.upright:  # the eyes of a box far from upright are too coarse to turn the mesh by
                roi = roi_around(mesh, TURNED_ROI_MARGIN)
                mesh = fit_mesh(view.image, roi)
            found.append(_Found(box.score, roi, mesh, view.image))
    return found


def _best_score(found: list[_Found]) -> float:
    return found[0].score if found else 0.0


def _detection(found: _Found, picture: NDArray[np.uint8], ratio: NDArray[np.float64]) -> FaceDetection:
    """Scales a face of the small picture to portrait pixels. The models' sample i is the pixel centred at i + .5."""
    mesh, image = _steadiest_fit(found, picture)
    points = ibug_points(mesh.points)

    def to_portrait(xy: NDArray[np.float64]) -> NDArray[np.float64]:
        return (xy + 0.5) * ratio

    def iris(disc: IrisDisc) -> IrisDisc:
        x, y = to_portrait(np.array(disc.centre))
        return IrisDisc((float(x), float(y)), disc.radius * float(ratio.mean()))

    left, right = iris_discs(mesh.points)
    return FaceDetection(
        points=to_portrait(points[:, :2]),
        depth=depth_towards_viewer(points),
        irises=(iris(left), iris(right)),
        mesh=to_portrait(mesh.points[:, :2]),
        confidence=found.score * mesh.presence,
        fit_advised=fit_is_doubtful(image, mesh, found.score),
    )


def _as_drawn(face: FaceDetection, rgb: NDArray[np.uint8]) -> FaceDetection:
    """The face of a flat drawing with eyes and mouth as drawn; where they surprise the mesh, the rest may too."""
    points, irises = face.points, face.irises
    eyes, mouth = drawn_eyes(rgb, face.points), drawn_mouth(rgb, face.points)
    if eyes is not None:
        points, irises = with_eyes(points, eyes), (eyes[0].iris, eyes[1].iris)
    if mouth is not None:
        points = points.copy()
        points[MOUTH] = mouth
    off = np.linalg.norm(points - face.points, axis=1) / outer_eye_distance(face.points)
    surprised = max(off[36:48].mean(), off[MOUTH].mean()) > MAX_SURPRISE
    return replace(face, points=points, irises=irises, fit_advised=face.fit_advised or bool(surprised))


def _steadiest_fit(found: _Found, picture: NDArray[np.uint8]) -> tuple[FaceMesh, NDArray[np.uint8]]:
    """The view's fit or the plain picture's, whichever wobbles less, with its picture: a view helps to find, not
    always to fit.
    """
    if found.image is picture:
        return found.mesh, picture
    mesh = fit_mesh(picture, found.roi)
    plain_is_as_sure = mesh.presence >= found.mesh.presence * PRESENCE_SLACK
    if plain_is_as_sure and wobble(picture, mesh) < wobble(found.image, found.mesh):
        return mesh, picture
    return found.mesh, found.image
