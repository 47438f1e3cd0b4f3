"""Completed layers on scenes whose hidden parts are known, and mouth interiors of the samples."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import vectortalker_core as core
from vectortalker.decode import Portrait
from vectortalker.inpaint import fill
from vectortalker.interior import eyeballs, mouth_interior
from vectortalker.irises import SeenIris
from vectortalker.landmarks import detect
from vectortalker.layers import targets
from vectortalker.oklab import to_oklab, to_srgb
from vectortalker.vectorize.layering import layer_images

Sample = Callable[[str], Portrait]
SIDE = 128


def distance_from(x0: float, y0: float) -> np.ndarray:
    y, x = np.mgrid[:SIDE, :SIDE] + 0.5
    return np.hypot(x - x0, y - y0)


def test_fill_keeps_what_is_trusted_and_continues_a_ramp() -> None:
    ramp = np.broadcast_to(np.linspace(0, 1, SIDE, dtype=np.float32)[None, :, None], (SIDE, SIDE, 3)).copy()
    hidden = distance_from(64, 64) < 20
    broken = ramp.copy()
    broken[hidden] = 0
    filled = fill(broken, (~hidden).astype(np.float32))
    assert (filled[~hidden] == ramp[~hidden]).all()
    assert np.abs(filled - ramp).max() < 0.06  # the gap hides a rise of .31


def test_fill_without_trust_is_the_mean() -> None:
    image = np.array([[[0.0, 0, 0], [1, 1, 1]]], np.float32)
    assert (fill(image, np.zeros((1, 2), np.float32)) == 0.5).all()


def test_back_holds_no_colour_of_the_person() -> None:
    person = distance_from(64, 80) < 40
    image = np.where(person[..., None], (1.0, 0, 0), (0, 0, 1.0)).astype(np.float32)
    back = targets(image, person.astype(np.float32), np.zeros((0, SIDE, SIDE), np.float32)).back
    assert np.abs(back - (0, 0, 1.0)).max() < 1e-4


def test_eye_is_closed_with_skin_and_its_iris_completed() -> None:
    """A round iris under half-closed lids: the lids' colour covers the opening, the iris goes on under them."""
    skin, white, blue = (0.8, 0.6, 0.5), (0.9, 0.9, 0.9), (0.1, 0.2, 0.8)
    iris = distance_from(64, 64) < 12
    y, x = np.mgrid[:SIDE, :SIDE] + 0.5
    opening = (np.abs(y - 64) < 7) & (np.abs(x - 64) < 26)
    image = np.where(opening[..., None], np.where(iris[..., None], blue, white), skin).astype(np.float32)
    clips = opening[None].astype(np.float32)
    made = targets(image, np.ones((SIDE, SIDE), np.float32), clips, [SeenIris((64, 64), (12, 12))], 100.0)
    assert np.abs(made.fore - skin).max() < 1e-3
    assert np.abs(made.local[54, 64] - blue).max() < 0.02  # 10 px above the centre, under the lid
    assert np.abs(made.local[54, 40] - white).max() < 0.05
    assert (made.local[opening] == image[opening]).all()


def test_without_person_back_is_the_picture() -> None:
    image = np.random.default_rng(0).random((SIDE, SIDE, 3)).astype(np.float32)
    made = targets(image, np.zeros((SIDE, SIDE), np.float32), np.zeros((0, SIDE, SIDE), np.float32))
    assert (made.back == image).all()


def test_closed_mouth_gets_all_parts_dark_to_light(sample: Sample) -> None:
    portrait = sample("mona-lisa.jpg")
    paths = mouth_interior(detect(portrait.rgb)[0].points, portrait.rgb)
    assert [path.part for path in paths] == [
        "mouth_cavity",
        "mouth_lower",
        "tongue",
        "mouth_upper",
    ]
    assert all(len(path.points) == 2 * 3 * 8 for path in paths)
    cavity, _, tongue, upper = (_lightness(path.fill.colour) for path in paths)
    assert cavity < 0.3 < tongue < 0.75 < upper


def test_open_mouth_gets_a_dark_cavity_only(sample: Sample) -> None:
    portrait = sample("astronaut.jpg")
    (cavity,) = mouth_interior(detect(portrait.rgb)[0].points, portrait.rgb)
    assert cavity.part == "mouth_cavity" and _lightness(cavity.fill.colour) <= 0.31


def test_eyeballs_cover_both_openings(sample: Sample) -> None:
    portrait = sample("astronaut.jpg")
    points = detect(portrait.rgb)[0].points
    left, right = eyeballs(points, portrait.rgb)
    for ball, corners in ((left, (36, 39)), (right, (42, 45))):
        x = np.array(ball.points).reshape(-1, 2)[:, 0]
        assert x.min() < points[corners[0], 0] and x.max() > points[corners[1], 0]


def test_oklab_round_trip_and_white() -> None:
    colours = np.random.default_rng(2).random((50, 3))
    assert np.abs(to_srgb(to_oklab(colours)) - colours).max() < 1e-6
    assert np.abs(to_oklab(np.ones(3)) - (1, 0, 0)).max() < 1e-4


def _lightness(colour: str) -> float:
    return float(to_oklab(np.array([int(colour[k : k + 2], 16) for k in (1, 3, 5)]) / 255)[0])


def test_closed_mouth_leaves_its_paths_without_gradients(sample: Sample) -> None:
    """Adam moves paths by its full rate however small their gradients are: they must be exactly zero."""
    portrait = sample("mona-lisa.jpg")
    face = detect(portrait.rgb)[0]
    image = portrait.rgb.astype(np.float32) / 255
    outlines = tuple(outline for _, outline, _ in core.opening_outlines(face.points))
    images = layer_images(image, np.ones(image.shape[:2], np.float32), face.points, face.irises, outlines)
    assert images.clips[:2].max() > 0.99
    assert (images.clips[2] == 0).all()


def test_lids_take_no_colour_of_hair_beside_the_eye() -> None:
    """A black fringe hangs to just above the opening; the lid is skin all the same."""
    skin = np.array((0.9, 0.7, 0.6), np.float32)
    image = np.broadcast_to(skin, (SIDE, SIDE, 3)).copy()
    opening = distance_from(64, 64) < 20
    image[opening] = 1
    image[:40] = 0
    lid = targets(image, np.ones((SIDE, SIDE), np.float32), opening[None].astype(np.float32)).fore
    assert np.abs(lid[opening] - skin).max() < 0.05
