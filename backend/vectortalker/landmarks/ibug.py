"""The 478-point mesh becomes the 68 iBUG points, their depth, and the two irises.

An iBUG point is a mesh vertex or lies between two vertices of the same contour (jaw, brow, nose wing, lip edge). The
shares come from the exact projected points of a rendered head, and were checked on hand-annotated drawings and
paintings.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from vectortalker.landmarks.mesh import LEFT_IRIS, RIGHT_IRIS

OUTER_EYES = (36, 45)

# (vertex a, vertex b, share of b) in iBUG order.
# fmt: off
SOURCES = (
    # jaw 0-16
    (127, 162, 0.4), (234, 234, 0.0), (93, 132, 0.25), (132, 58, 0.4), (58, 172, 0.75), (136, 150, 0.5),
    (150, 149, 0.75), (176, 148, 0.4), (152, 152, 0.0), (400, 377, 0.4), (379, 378, 0.75), (365, 379, 0.5),
    (288, 397, 0.75), (361, 288, 0.4), (366, 361, 0.25), (454, 454, 0.0), (356, 389, 0.4),
    # brows 17-26: between the upper and the lower row
    (70, 46, 0.4), (63, 53, 0.4), (105, 52, 0.35), (66, 55, 0.25), (107, 55, 0.3), (336, 285, 0.3),
    (296, 285, 0.25), (334, 282, 0.35), (293, 283, 0.4), (300, 276, 0.4),
    # nose 27-35
    (168, 6, 0.25), (6, 197, 0.5), (195, 195, 0.0), (4, 4, 0.0), (98, 97, 0.4), (97, 97, 0.0), (2, 2, 0.0),
    (326, 326, 0.0), (327, 326, 0.4),
    # eyes 36-47
    (33, 33, 0.0), (160, 160, 0.0), (158, 158, 0.0), (133, 133, 0.0), (153, 153, 0.0), (144, 144, 0.0),
    (362, 362, 0.0), (385, 385, 0.0), (387, 387, 0.0), (263, 263, 0.0), (373, 373, 0.0), (380, 380, 0.0),
    # outer lips 48-59
    (61, 61, 0.0), (40, 39, 0.25), (37, 37, 0.0), (0, 0, 0.0), (267, 267, 0.0), (270, 269, 0.25), (291, 291, 0.0),
    (321, 405, 0.25), (314, 405, 0.25), (17, 17, 0.0), (84, 181, 0.25), (91, 181, 0.25),
    # inner lips 60-67
    (78, 78, 0.0), (81, 81, 0.0), (13, 13, 0.0), (311, 311, 0.0), (308, 308, 0.0), (402, 402, 0.0), (14, 14, 0.0),
    (178, 178, 0.0),
)
# fmt: on


@dataclass(frozen=True)
class IrisDisc:
    """Centre (x, y) and radius in picture pixels."""

    centre: tuple[float, float]
    radius: float


def ibug_points(mesh: NDArray[np.float64]) -> NDArray[np.float64]:
    """[68, 3] of a mesh [478, 3], same axes."""
    table = np.array(SOURCES)
    share = table[:, 2:]
    return mesh[table[:, 0].astype(int)] * (1 - share) + mesh[table[:, 1].astype(int)] * share


def outer_eye_distance(points: NDArray[np.float64]) -> float:
    """Distance of landmarks 36 and 45, the unit of poses and depth."""
    return float(np.linalg.norm(points[OUTER_EYES[0], :2] - points[OUTER_EYES[1], :2]))


def depth_towards_viewer(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """[68] of points [68, 3]: towards the viewer, in outer-eye distances, mean of the four eye corners = 0."""
    z = -points[:, 2]
    return (z - z[[36, 39, 42, 45]].mean()) / outer_eye_distance(points)


def iris_discs(mesh: NDArray[np.float64]) -> tuple[IrisDisc, IrisDisc]:
    """Image-left first; the radius is the mean distance of the four rim points from the centre."""
    discs = []
    for rows in (LEFT_IRIS, RIGHT_IRIS):
        centre, rim = mesh[rows, :2][0], mesh[rows, :2][1:]
        radius = float(np.linalg.norm(rim - centre, axis=1).mean())
        discs.append(IrisDisc((float(centre[0]), float(centre[1])), radius))
    return discs[0], discs[1]
