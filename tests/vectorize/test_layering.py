"""Layers: what each is fitted to, who seeds where, and that fore leaves the scenery alone."""

from __future__ import annotations

import numpy as np
import pytest
import vectortalker_core as core
from vectortalker.landmarks.ibug import IrisDisc
from vectortalker.schema import VectorizeOptions
from vectortalker.vectorize.layering import LayerImages, layer_images, layered_level
from vectortalker.vectorize.level import BACK, FIRST_LOCAL, FORE, LID, TOP, Level
from vectortalker.vectorize.losses import Fidelity
from vectortalker.vectorize.optimise import Start, Step, optimise
from vectortalker.vectorize.options import resolve
from vectortalker.vectorize.population import Population, empty_population
from vectortalker.vectorize.resize import resize
from vectortalker.vectorize.schedule import RECIPES, LevelPlan, plan
from vectortalker.vectorize.seeding import seed
from vectortalker.vectorize.starts import circle

SIDE = 96
CANVAS = np.full(3, 0.5, np.float32)


@pytest.fixture(scope="module")
def picture() -> np.ndarray:
    """A red head before striped scenery, with one white eye and a dark iris."""
    y, x = np.mgrid[:SIDE, :SIDE] + 0.5
    image = np.where((x // 12 % 2)[..., None] > 0, [0.2, 0.5, 0.3], [0.3, 0.7, 0.9])
    image[np.hypot(x - 48, y - 54) < 30] = [0.8, 0.3, 0.2]
    image[np.hypot((x - 48) / 2, y - 50) < 6] = 1.0
    image[np.hypot(x - 48, y - 50) < 4] = 0.1
    return image.astype(np.float32)


@pytest.fixture(scope="module")
def images(picture: np.ndarray) -> LayerImages:
    y, x = np.mgrid[:SIDE, :SIDE] + 0.5
    mask = (np.hypot(x - 48, y - 54) < 30).astype(np.float32)
    eye = circle((48, 50), 6, 4).astype(np.float64)
    eye[:, 0] = 48 + 2 * (eye[:, 0] - 48)
    nothing = np.zeros((0, 2))
    return layer_images(picture, mask, None, (IrisDisc((48.0, 50.0), 4.0),), (eye, nothing, nothing))


def run(images: LayerImages, picture: np.ndarray) -> Step:
    options = VectorizeOptions(paths=40, levels=2, iterations=40, final_iterations=120, working_size=SIDE)
    settings = resolve(options)
    plans = plan(settings, (SIDE, SIDE))

    def level_at(_: int, level_plan: LevelPlan) -> Level:
        return layered_level(images, resize(picture, level_plan.frame), (), CANVAS)

    steps = optimise(level_at, plans, settings, Start(empty_population(8), 0, 0), 0, lambda: False)
    while True:
        try:
            next(steps)
        except StopIteration as end:
            return end.value


def test_every_layer_equals_the_picture_where_it_is_seen(images: LayerImages, picture: np.ndarray) -> None:
    level = layered_level(images, picture, (), CANVAS)
    back, fore, _, merged = level.sheets
    person, opening = images.mask > 0.5, images.clips[0] > 0
    assert np.allclose(back.target[~person], picture[~person], atol=1e-6)
    assert np.allclose(fore.target[person & ~opening], picture[person & ~opening], atol=1e-6)
    assert merged.target is picture


def test_hidden_parts_are_completed_by_their_surroundings(images: LayerImages, picture: np.ndarray) -> None:
    back, fore, ball, _ = layered_level(images, picture, (), CANVAS).sheets
    assert back.target[54, 48, 0] < 0.4
    assert np.allclose(fore.target[50, 48], [0.8, 0.3, 0.2], atol=0.1)
    assert ball.target[50, 48].min() > 0.8


def test_eyeball_under_its_iris_counts_as_what_is_seen(images: LayerImages, picture: np.ndarray) -> None:
    """Counted less, the ball is painted as the iris, which keeps a hole there when it moves."""
    weight = layered_level(images, picture, (), CANVAS).sheets[2].weight
    assert weight[50, 48] == 1
    assert weight[50, 38] == 0, "beside the iris the picture shows it"


def test_each_layer_claims_its_own_pixels(images: LayerImages, picture: np.ndarray) -> None:
    level = layered_level(images, picture, (), CANVAS)
    back, fore, _, local = level.sheets
    assert [sheet.below for sheet in level.sheets] == [FORE, LID, FIRST_LOCAL + 2, TOP]
    assert back.claim[2, 2] == 1 and fore.claim[2, 2] == 0 and local.claim[2, 2] == 0
    assert fore.claim[70, 48] == 1 and back.claim[70, 48] < 0.5
    assert local.claim[50, 38] > 0.9 and local.owner[50, 38] == FIRST_LOCAL
    assert local.owner[50, 48] == FIRST_LOCAL + 2
    assert back.owner[2, 2] == BACK and fore.owner[70, 48] == FORE


def test_at_a_soft_silhouette_back_and_fore_together_are_fitted_to_the_picture(picture: np.ndarray) -> None:
    y, x = np.mgrid[:SIDE, :SIDE] + 0.5
    soft = np.clip((38 - np.hypot(x - 48, y - 54)) / 16, 0, 1).astype(np.float32)
    level = layered_level(layer_images(picture, soft, None, (), ()), picture, (), CANVAS)
    back_and_fore = level.sheets[1]
    np.testing.assert_allclose(back_and_fore.target, picture, atol=1e-6)
    assert (back_and_fore.weight[(soft > 0) & (soft < 1)] > 0).all()


@pytest.mark.parametrize(("group", "expects_local"), [(FORE, True), (FIRST_LOCAL, False)])
def test_no_more_paths_start_in_openings_once_many_are_there(
    images: LayerImages, picture: np.ndarray, group: int, expects_local: bool
) -> None:
    level = layered_level(images, picture, (), CANVAS)
    generator = np.random.default_rng(0)

    def grown(population: Population, count: int) -> Population:
        return seed(population, level, count, 6.0, RECIPES["best"], True, Fidelity(), generator)

    population = grown(empty_population(8), 20)
    population.group[:] = group
    assert (
        (grown(population, 20).group >= FIRST_LOCAL).sum() > len(population) * (group >= FIRST_LOCAL)
    ) == expects_local


def test_teeth_of_an_open_mouth_belong_to_skull_and_jaw(picture: np.ndarray) -> None:
    mouth = circle((48, 60), 10, 4).astype(np.float64)
    image = picture.copy()
    image[50:71, 38:59] = [0.2, 0.05, 0.05]
    image[52:56, 40:57] = image[65:68, 40:57] = 0.9
    image[59:62, 44:53] = [0.9, 0.4, 0.4]
    nothing = np.zeros((0, 2))
    parts = layer_images(image, np.ones((SIDE, SIDE), np.float32), None, (), (nothing, nothing, mouth)).parts
    assert [parts[row, 48] - FIRST_LOCAL for row in (54, 60, 66, 58)] == [7, 4, 5, 4]


def test_all_that_a_smile_shows_stays_with_the_skull(picture: np.ndarray) -> None:
    mouth = circle((48, 60), 10, 4).astype(np.float64)
    mouth[:, 1] = 60 + 0.3 * (mouth[:, 1] - 60)
    image = picture.copy()
    image[56:65, 38:59] = [0.2, 0.05, 0.05]
    image[58:62, 42:55] = 0.9
    nothing = np.zeros((0, 2))
    parts = layer_images(image, np.ones((SIDE, SIDE), np.float32), None, (), (nothing, nothing, mouth)).parts
    assert {int(part) - FIRST_LOCAL for part in parts[58:62, 42:55].ravel()} == {7}


def test_fore_leaves_the_scenery_and_hides_the_back(images: LayerImages, picture: np.ndarray) -> None:
    population = run(images, picture).population
    fore = slice(population.below(FORE), population.below(FIRST_LOCAL))
    assert fore.stop > fore.start and len(population) == 40
    screens = [np.zeros(3, np.float32), np.ones(3, np.float32)]
    shown = [
        core.rasterize(
            population.points[fore],
            population.stops[fore],
            population.axis[fore],
            population.gradient[fore],
            np.full(fore.stop - fore.start, -1, np.int32),
            np.zeros((0, SIDE, SIDE), np.float32),
            screen,
            SIDE,
            SIDE,
        )
        for screen in screens
    ]
    transmitted = (shown[1] - shown[0]).mean(axis=2)
    y, x = np.mgrid[:SIDE, :SIDE] + 0.5
    distance = np.hypot(x - 48, y - 54)
    assert transmitted[distance > 36].mean() > 0.98
    assert transmitted[distance < 24].mean() < 0.05
