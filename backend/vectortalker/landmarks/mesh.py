"""A face's region of interest becomes the 478-point mesh (face mesh with attention to lips and eyes)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.special import expit

from vectortalker import models
from vectortalker.landmarks.window import Window, sample

INPUT_SIDE = 192
N_MESH, N_POINTS = 468, 478
LEFT_IRIS, RIGHT_IRIS = slice(468, 473), slice(473, 478)  # centre, then four points of the rim
LEFT_OUTER_EYE, RIGHT_OUTER_EYE = 33, 263
N_LID = 16  # the first points of each eye region are its lids

# fmt: off
# Mesh index of each row of the refining outputs; left is image-left.
LIPS = [
    61, 146, 91, 181, 84, 17, 314, 405, 321, 375, 291, 185, 40, 39, 37, 0, 267, 269, 270, 409, 78, 95, 88, 178,
    87, 14, 317, 402, 318, 324, 308, 191, 80, 81, 82, 13, 312, 311, 310, 415, 76, 77, 90, 180, 85, 16, 315, 404,
    320, 307, 306, 184, 74, 73, 72, 11, 302, 303, 304, 408, 62, 96, 89, 179, 86, 15, 316, 403, 319, 325, 292,
    183, 42, 41, 38, 12, 268, 271, 272, 407,
]
LEFT_EYE = [
    33, 7, 163, 144, 145, 153, 154, 155, 133, 246, 161, 160, 159, 158, 157, 173, 130, 25, 110, 24, 23, 22, 26,
    112, 243, 247, 30, 29, 27, 28, 56, 190, 226, 31, 228, 229, 230, 231, 232, 233, 244, 113, 225, 224, 223, 222,
    221, 189, 35, 124, 46, 53, 52, 65, 143, 111, 117, 118, 119, 120, 121, 128, 245, 156, 70, 63, 105, 66, 107,
    55, 193,
]
RIGHT_EYE = [
    263, 249, 390, 373, 374, 380, 381, 382, 362, 466, 388, 387, 386, 385, 384, 398, 359, 255, 339, 254, 253,
    252, 256, 341, 463, 467, 260, 259, 257, 258, 286, 414, 446, 261, 448, 449, 450, 451, 452, 453, 464, 342,
    445, 444, 443, 442, 441, 413, 265, 353, 276, 283, 282, 295, 372, 340, 346, 347, 348, 349, 350, 357, 465,
    383, 300, 293, 334, 296, 336, 285, 417,
]
# fmt: on


@dataclass(frozen=True)
class FaceMesh:
    """`points` f64 [478, 3]: x, y in samples of the picture, z away from the viewer at that scale; `presence` 0..1."""

    points: NDArray[np.float64]
    presence: float


def fit_mesh(image: NDArray[np.uint8], roi: Window) -> FaceMesh:
    """The mesh in a square roi. `presence` rejects nonsense; it says nothing of a poor fit."""
    pixels = sample(image, roi, INPUT_SIDE, extend_border=True) * np.float32(1 / 255)
    names = ["output_mesh_identity", "output_lips", "output_left_eye", "output_right_eye"]
    names += ["output_left_iris", "output_right_iris", "conv_faceflag"]
    mesh, lips, left_eye, right_eye, left_iris, right_iris, flag = models.run(
        "face_landmark_with_attention", pixels, names
    )
    points = np.zeros((N_POINTS, 3))
    points[:N_MESH] = mesh.reshape(N_MESH, 3)
    refined = (
        (LIPS, lips),
        (LEFT_EYE, left_eye),
        (RIGHT_EYE, right_eye),
        (LEFT_IRIS, left_iris),
        (RIGHT_IRIS, right_iris),
    )
    for rows, output in refined:
        points[rows, :2] = output.reshape(-1, 2)
    points[LEFT_IRIS, 2] = points[LEFT_EYE[:N_LID], 2].mean()
    points[RIGHT_IRIS, 2] = points[RIGHT_EYE[:N_LID], 2].mean()
    points /= INPUT_SIDE
    xy = roi.to_picture(points[:, :2])
    return FaceMesh(np.column_stack([xy, points[:, 2] * roi.width]), float(expit(flag.item())))


def roi_around(mesh: FaceMesh, margin: float) -> Window:
    """Square around the mesh, `margin` times its size, turned so that the eyes are level."""
    xy = mesh.points[:, :2]
    dx, dy = xy[RIGHT_OUTER_EYE] - xy[LEFT_OUTER_EYE]
    angle = float(np.arctan2(dy, dx))
    level = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    turned = xy @ level
    low, high = turned.min(axis=0), turned.max(axis=0)
    cx, cy = (low + high) / 2 @ level.T
    side = float((high - low).max()) * margin
    return Window(float(cx), float(cy), side, side, angle)
