"""A fitted mesh becomes a measure of how far it can be trusted.

The network's own face flag is 1.00 on fits that are plainly wrong. What tells them apart is how far views of the face
disagree that are drawn again from the mesh itself, larger and turned. Mean over nine of them, in outer-eye distances:
photographs, renderings and most paintings 1.1-2.0 %, paintings with hidden brows or chin 2.5-3.1 %, flat drawings
2.9-8 %. Medians over the views are no better fits than the first: what is wrong is wrong in all of them.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import product

import numpy as np
from numpy.typing import NDArray

from vectortalker.landmarks.ibug import depth_towards_viewer, ibug_points, outer_eye_distance
from vectortalker.landmarks.mesh import FaceMesh, fit_mesh, roi_around

ROI_MARGINS = (1.25, 1.5)
VIEW_MARGINS, VIEW_TURNS = (1.25, 1.5, 1.75), (0.0, -0.2, 0.2)  # of the mesh's size; radians
MAX_DISAGREEMENT = 0.022
MIN_CLEAR_SCORE = 0.8
MAX_YAW_DEGREES = 40.0  # beyond it the far eye and the far half of the mouth are guesses


def wobble(image: NDArray[np.uint8], mesh: FaceMesh) -> float:
    """Mean shift of the 68 points, in outer-eye distances, when the mesh is fitted again in regions of its own."""
    points = ibug_points(mesh.points)
    shifts = []
    for margin in ROI_MARGINS:
        again = ibug_points(fit_mesh(image, roi_around(mesh, margin)).points)
        shifts.append(np.linalg.norm(again[:, :2] - points[:, :2], axis=1).mean())
    return float(np.mean(shifts)) / outer_eye_distance(points)


def disagreement(image: NDArray[np.uint8], mesh: FaceMesh) -> float:
    """Mean distance of the 68 points from their median over views of the mesh's region, in outer-eye distances."""
    fits = []
    for margin, turn in product(VIEW_MARGINS, VIEW_TURNS):
        roi = roi_around(mesh, margin)
        fits.append(ibug_points(fit_mesh(image, replace(roi, angle=roi.angle + turn)).points)[:, :2])
    views = np.stack(fits)
    apart = np.linalg.norm(views - np.median(views, axis=0), axis=2)
    return float(apart.mean()) / outer_eye_distance(ibug_points(mesh.points))


def fit_is_doubtful(image: NDArray[np.uint8], mesh: FaceMesh, score: float) -> bool:
    """True if the user should check the landmarks or place the five pins. Views are asked last: they cost most."""
    if score * mesh.presence < MIN_CLEAR_SCORE or abs(_yaw(mesh)) > MAX_YAW_DEGREES:
        return True
    return disagreement(image, mesh) > MAX_DISAGREEMENT


def _yaw(mesh: FaceMesh) -> float:
    """Degrees the line of the outer eye corners is turned about the vertical."""
    depth = depth_towards_viewer(ibug_points(mesh.points))
    return float(np.degrees(np.arctan(depth[36] - depth[45])))
