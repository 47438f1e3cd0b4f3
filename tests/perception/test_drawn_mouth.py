"""Drawn mouths on a face made from numbers: open ones take their outlines, shut ones and shades stay with the mesh."""

from __future__ import annotations

import numpy as np
import pytest
from vectortalker.landmarks.drawn_mouth import drawn_mouth
from vectortalker.landmarks.ibug import outer_eye_distance
from vectortalker.rig import fit_pins

SKIN, INK, WHITE, LIPS = (240, 200, 170), (20, 10, 10), (250, 250, 250), (200, 90, 100)
CENTRE, WIDTH, HEIGHT, STROKE = (205.0, 285.0), 45.0, 25.0, 5.0  # half axes of the mouth, thickness of its outline
Y, X = np.mgrid[:400, :400] + 0.5


@pytest.fixture
def points() -> np.ndarray:
    """Landmarks of a face with lips a little higher and wider than the drawn mouth, as the mesh finds them."""
    face = fit_pins([(150, 160), (250, 160), (200, 220), (150, 270), (250, 270)])
    assert face is not None
    return np.array(face.points)


def within(half_width: float, half_height: float) -> np.ndarray:
    return ((X - CENTRE[0]) / half_width) ** 2 + ((Y - CENTRE[1]) / half_height) ** 2 < 1


def drawing(*ellipses: tuple[float, float, tuple[int, int, int]]) -> np.ndarray:
    """Skin with ellipses (half axes, colour) about the mouth's centre, in painter's order."""
    picture = np.full((400, 400, 3), SKIN, np.uint8)
    for half_width, half_height, colour in ellipses:
        picture[within(half_width, half_height)] = colour
    return picture


def open_mouth() -> np.ndarray:
    """An inked outline, white teeth above, a dark cavity below."""
    picture = drawing((WIDTH, HEIGHT, INK), (WIDTH - STROKE, HEIGHT - STROKE, WHITE))
    picture[within(WIDTH, HEIGHT) & (CENTRE[1] < Y)] = INK
    return picture


def extent(ring: np.ndarray) -> np.ndarray:
    return np.concatenate([ring.min(axis=0) - CENTRE, ring.max(axis=0) - CENTRE])


def test_open_mouth_takes_its_drawn_outline(points: np.ndarray) -> None:
    lips = drawn_mouth(open_mouth(), points)
    assert lips is not None
    assert extent(lips[:12]) == pytest.approx([-WIDTH, -HEIGHT, WIDTH, HEIGHT], abs=5)
    assert extent(lips[:12])[2] > extent(lips[12:])[2] > WIDTH - 12, "the outline lies between both edges of the lips"


def test_lips_run_as_ibug_numbers_them(points: np.ndarray) -> None:
    lips = drawn_mouth(open_mouth(), points)
    assert lips is not None
    for ring, n_between in ((lips[:12], 5), (lips[12:], 3)):
        upper, lower = ring[1 : 1 + n_between], ring[2 + n_between :]
        assert (np.diff(upper[:, 0]) > 0).all() and (np.diff(lower[:, 0]) < 0).all()
        assert upper[:, 1].max() < lower[:, 1].min()


def test_mouth_turns_with_the_picture(points: np.ndarray) -> None:
    """Closed form: a quarter turn takes (x, y) to (400 − y, x)."""
    upright = drawn_mouth(open_mouth(), points)
    turned = drawn_mouth(np.ascontiguousarray(np.rot90(open_mouth(), -1)), turn(points))
    assert upright is not None and turned is not None
    assert np.linalg.norm(turned - turn(upright), axis=1).max() < 0.03 * outer_eye_distance(points)


def turn(xy: np.ndarray) -> np.ndarray:
    return np.stack([400 - xy[:, 1], xy[:, 0]], axis=1)


SHUT = {
    "a line": drawing((WIDTH, 1.5, INK)),
    "lips": drawing((WIDTH, 15, LIPS), (WIDTH, 1.5, INK)),
    "outlined lips": drawing((WIDTH, 18, INK), (WIDTH - 4, 14, WHITE), (WIDTH, 2.5, INK)),
    "a shade below": drawing((25, 10, INK)),
    "nothing": drawing(),
}


@pytest.mark.parametrize("picture", SHUT.values(), ids=SHUT.keys())
def test_mouths_that_show_no_inside_stay_with_the_mesh(points: np.ndarray, picture: np.ndarray) -> None:
    assert drawn_mouth(picture, points) is None


def test_shaded_skin_keeps_the_mesh(points: np.ndarray) -> None:
    shade = np.linspace(0.4, 1, 400)[None, :, None]
    assert drawn_mouth((open_mouth() * shade).astype(np.uint8), points) is None


def test_mouth_that_reaches_the_chin_is_a_beard(points: np.ndarray) -> None:
    points[8, 1] = CENTRE[1] + HEIGHT
    assert drawn_mouth(open_mouth(), points) is None
