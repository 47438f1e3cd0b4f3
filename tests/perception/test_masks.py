"""Masks of figures made here, of the samples, and of pictures that hold nobody."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from vectortalker.decode import Portrait, canonical
from vectortalker.landmarks import detect
from vectortalker.masks import face_outline, segment

Sample = Callable[[str], Portrait]


def disc(side: int = 100, radius: float = 30.0) -> np.ndarray:
    y, x = np.mgrid[:side, :side] + 0.5
    return np.hypot(x - side / 2, y - side / 2) < radius


def test_plain_background_is_cut_to_the_pixel() -> None:
    figure = disc()
    picture = np.where(figure[..., None], (200, 80, 40), (10, 200, 90)).astype(np.uint8)
    picture[40:60, 40:60] = (
        10,
        200,
        90,
    )  # of the background's colour, but inside: a hole too large to fill
    picture[10:12, 10:12] = (0, 0, 0)  # a speck
    masks = segment(picture)
    assert masks.source == "plain"
    want = figure.copy()
    want[40:60, 40:60] = True  # not joined to the border, so it belongs to the figure
    assert ((masks.fore > 0.5) == want).all()


def test_meaningful_alpha_is_the_mask() -> None:
    alpha = (disc() * 255).astype(np.uint8)
    masks = segment(np.full((100, 100, 3), 77, np.uint8), alpha=alpha)
    assert masks.source == "alpha"
    assert ((masks.fore > 0.5) == disc()).all()


def test_opaque_alpha_says_nothing() -> None:
    masks = segment(np.full((100, 100, 3), 77, np.uint8), alpha=np.full((100, 100), 255, np.uint8))
    assert masks.source == "none"
    assert not masks.fore.any()


@pytest.mark.parametrize(
    ("name", "source"),
    [
        ("astronaut.jpg", "selfie"),
        ("mona-lisa.jpg", "selfie"),
        ("toon-head.png", "plain"),
    ],
)
def test_sample_foreground_holds_the_face_and_leaves_scenery(sample: Sample, name: str, source: str) -> None:
    portrait = sample(name)
    picture = canonical(portrait, 256)
    points = detect(portrait.rgb)[0].points * picture.shape[1] / portrait.width
    masks = segment(picture, points)
    assert masks.source == source
    assert (masks.fore[face_outline(points, picture.shape)] > 0.5).all()
    assert 0.2 < (masks.fore > 0.5).mean() < 0.8
    assert masks.fore[:8, :8].max() < 0.5  # the top corner is scenery in all of them
