"""Drawn irises on a synthetic eye: the ellipse takes in what is dark, and leaves the white."""

from __future__ import annotations

import numpy as np
import pytest
from vectortalker.irises import STROKE, light_part, radius_map, seen_iris
from vectortalker.landmarks import IrisDisc

SIDE = 96
Y, X = np.mgrid[:SIDE, :SIDE] + 0.5
OPENING = (np.hypot((X - 48) / 40, (Y - 48) / 32) < 1).astype(np.float32)


def eye(across: float, along: float) -> np.ndarray:
    """f32 [SIDE, SIDE, 3]: a blue ellipse with these radii on white."""
    iris = np.hypot((X - 48) / across, (Y - 48) / along) < 1
    return np.where(iris[..., None], [0.1, 0.1, 0.5], 0.95).astype(np.float32)


@pytest.mark.parametrize(("across", "along"), [(12, 12), (12, 24), (20, 12)])
def test_iris_holds_what_is_dark_and_the_detected_disc(across: float, along: float) -> None:
    seen = seen_iris(eye(across, along), OPENING, IrisDisc((48.0, 48.0), 12.0))
    assert seen.centre == pytest.approx((48, 48), abs=1)
    assert seen.radii == pytest.approx((max(across, 12), max(along, 12)), abs=1.5)


def test_strokes_along_the_lids_are_no_iris() -> None:
    picture = eye(12, 60)
    seen = seen_iris(picture, OPENING, IrisDisc((48.0, 48.0), 12.0))
    assert seen.radii[1] == pytest.approx(32 - STROKE * 64, abs=1.5)


def test_lash_line_that_the_iris_touches_does_not_move_with_it() -> None:
    picture = eye(24, 24)
    picture[Y < 25] = 0.1  # from the opening's edge at 16
    seen = seen_iris(picture, OPENING, IrisDisc((48.0, 48.0), 24.0))
    assert seen.radii == (24, 24)


def test_eye_of_one_colour_keeps_its_disc() -> None:
    seen = seen_iris(np.full((SIDE, SIDE, 3), 0.2, np.float32), OPENING, IrisDisc((40.0, 50.0), 9.0))
    assert (seen.centre, seen.radii) == ((40.0, 50.0), (9.0, 9.0))


def test_white_is_what_lies_outside_the_iris() -> None:
    picture, inside = eye(12, 24), OPENING > 0.98
    white = light_part(picture, inside)
    radius = radius_map(seen_iris(picture, OPENING, IrisDisc((48.0, 48.0), 12.0)), white.shape)
    assert not (white & (radius < 0.95)).any()
    assert white[inside & (radius > 1.1)].all()


@pytest.mark.parametrize("centre", [(-30.0, 48.0), (48.0, -30.0), (130.0, 48.0), (48.0, 130.0)])
def test_iris_beyond_the_picture_keeps_its_disc(centre: tuple[float, float]) -> None:
    picture = np.where(((X < 2) | (Y < 2))[..., None], 0.1, eye(12, 12)).astype(np.float32)
    seen = seen_iris(picture, np.ones((SIDE, SIDE), np.float32), IrisDisc(centre, 9.0))
    assert (seen.centre, seen.radii) == (centre, (9.0, 9.0))
