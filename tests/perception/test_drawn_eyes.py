"""Drawn eyes on a face made from numbers, and on the samples."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from vectortalker.decode import Portrait
from vectortalker.landmarks import detect
from vectortalker.landmarks.drawn_eyes import drawn_eyes
from vectortalker.rig import fit_pins

Sample = Callable[[str], Portrait]
CENTRES = ((150.0, 170.0), (250.0, 170.0))
WIDTH, HEIGHT, IRIS = 30.0, 42.0, 14.0  # half axes of the eyes, radius of the irises


def inside(x0: float, y0: float, half_width: float, half_height: float) -> np.ndarray:
    y, x = np.mgrid[:400, :400] + 0.5
    return ((x - x0) / half_width) ** 2 + ((y - y0) / half_height) ** 2 < 1


@pytest.fixture
def points() -> np.ndarray:
    """Landmarks of the same face with smaller eyes a little too high, as the mesh finds them."""
    face = fit_pins([(148, 158), (254, 160), (200, 225), (165, 270), (237, 270)])
    assert face is not None
    return np.array(face.points)


def drawing() -> np.ndarray:
    picture = np.full((400, 400, 3), (240, 200, 170), np.uint8)
    for x, y in CENTRES:
        picture[inside(x, y, WIDTH, HEIGHT)] = 20
        picture[inside(x, y, WIDTH - 4, HEIGHT - 4)] = 250
        picture[inside(x, y + 5, IRIS, IRIS)] = (40, 60, 150)
    return picture


def test_eyes_take_their_drawn_outlines(points: np.ndarray) -> None:
    eyes = drawn_eyes(drawing(), points)
    assert eyes is not None
    for eye, (x, y) in zip(eyes, CENTRES, strict=True):
        low, high = eye.contour.min(axis=0), eye.contour.max(axis=0)
        assert np.abs((low[0], high[0]) - np.array([x - WIDTH, x + WIDTH])).max() < 3
        assert y - HEIGHT + 3 < low[1] < y - HEIGHT + 15, "the dark rim above goes with the lid"
        assert abs(high[1] - (y + HEIGHT)) < 5
        assert np.hypot(eye.iris.centre[0] - x, eye.iris.centre[1] - (y + 5)) < 4
        assert abs(eye.iris.radius - IRIS) < 5


def test_shaded_skin_keeps_the_mesh(points: np.ndarray) -> None:
    shade = np.linspace(0.5, 1, 400)[:, None, None]
    assert drawn_eyes((drawing() * shade).astype(np.uint8), points) is None


def test_eyes_joined_with_hair_keep_the_mesh(points: np.ndarray) -> None:
    picture = drawing()
    picture[:150] = 20
    assert drawn_eyes(picture, points) is None


@pytest.mark.parametrize("name", ["eileen.png", "toon-head.png"])
def test_large_eyes_of_drawings_are_found_whole(sample: Sample, name: str) -> None:
    face = detect(sample(name).rgb)[0]
    for first in (36, 42):
        eye = face.points[first : first + 6]
        assert np.ptp(eye[:, 1]) > 0.8 * np.ptp(eye[:, 0]), "as high as wide, unlike any eye of a photograph"
    assert face.fit_advised


def test_photographs_keep_the_mesh(sample: Sample) -> None:
    picture = sample("astronaut.jpg").rgb
    assert drawn_eyes(picture, detect(picture)[0].points) is None
