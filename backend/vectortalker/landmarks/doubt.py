"""A fitted mesh becomes a measure of how far it can be trusted.

The network's own face flag is 1.00 on fits that are plainly wrong. What tells them apart is how far the landmarks move
when the region of interest is drawn again from the mesh itself: photographs and paintings .8-3 % of the outer-eye
distance, anime and line drawings 3-5 %, manga, masks and profiles 5-16 %.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from vectortalker.landmarks.ibug import depth_towards_viewer, ibug_points, outer_eye_distance
from vectortalker.landmarks.mesh import FaceMesh, fit_mesh, roi_around

ROI_MARGINS = (1.25, 1.5)
MAX_WOBBLE = 0.03
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


def fit_is_doubtful(mesh: FaceMesh, score: float, mesh_wobble: float) -> bool:
    """True if the user should check the landmarks or place the five pins."""
    return score * mesh.presence < MIN_CLEAR_SCORE or mesh_wobble > MAX_WOBBLE or abs(_yaw(mesh)) > MAX_YAW_DEGREES


def _yaw(mesh: FaceMesh) -> float:
    """Degrees the line of the outer eye corners is turned about the vertical."""
    depth = depth_towards_viewer(ibug_points(mesh.points))
    return float(np.degrees(np.arctan(depth[36] - depth[45])))
