"""The edge of an opening: fore and local are mixed there as renderers do it, and useless local paths are moved."""

from __future__ import annotations

import numpy as np
from vectortalker import metrics
from vectortalker.scene import STOPS, LayeredScene, to_wire
from vectortalker.svg import to_svg
from vectortalker.vectorize.layering import layer_images, layered_level
from vectortalker.vectorize.level import BACK, FIRST_LOCAL, FORE, LID, TOP, Level
from vectortalker.vectorize.losses import Fidelity, merged_picture
from vectortalker.vectorize.optimise import LEAST_IMPORTANCE, LOCAL_KEPT, least_important
from vectortalker.vectorize.population import Population, fresh
from vectortalker.vectorize.starts import circle

SIDE = 48
NOTHING = np.zeros((0, 2))
SKIN, EYE = np.array([0.9, 0.7, 0.6], np.float32), np.array([0.1, 0.1, 0.3], np.float32)


def level_with_an_eye() -> Level:
    """Skin all over the frame and a dark eye of 10 px, whose opening follows it."""
    y, x = np.mgrid[:SIDE, :SIDE] + 0.5
    picture = np.where((np.hypot(x - 24.3, y - 24.1) < 10)[..., None], EYE, SKIN).astype(np.float32)
    eye = circle((24.3, 24.1), 10, 4).astype(np.float64)
    openings = (eye, NOTHING, NOTHING)
    images = layer_images(picture, np.ones((SIDE, SIDE), np.float32), None, (), openings)
    return layered_level(images, picture, openings, SKIN)


def skin_and_stacked_eye() -> Population:
    """One path of skin, and three of the eye that all reach beyond its opening."""
    discs = [((24.0, 24.0), 60.0), ((24.0, 24.0), 14.0), ((23.0, 25.0), 15.0), ((25.0, 24.0), 16.0)]
    points = np.stack([circle(centre, radius, 8) for centre, radius in discs])
    colours = np.stack([np.append(SKIN, 1), *[np.append(EYE, 0.8)] * 3]).astype(np.float32)
    group = np.array([FORE] + [FIRST_LOCAL] * 3)
    axis, gradient = np.zeros((4, 4), np.float32), np.zeros(4, np.bool_)
    return fresh(points, np.repeat(colours[:, None], STOPS, axis=1), axis, gradient, group)


def test_edges_of_openings_look_as_renderers_paint_them() -> None:
    level, population = level_with_an_eye(), skin_and_stacked_eye()
    layers = (population.layer(*groups) for groups in ((BACK, FORE), (FORE, FIRST_LOCAL), (FIRST_LOCAL, TOP)))
    svg = to_svg(to_wire(LayeredScene(SIDE, SIDE, level.canvas, *layers)), level.openings, "eye", (SIDE, SIDE))
    painted = metrics.render(svg, SIDE, SIDE).astype(np.float32) / 255
    edge = (level.opening > 0.1) & (level.opening < 0.9)
    difference = np.abs(merged_picture(population, level, Fidelity(4)) - painted)[edge]
    assert edge.sum() > 30
    assert difference.mean() < 0.03  # clipping each path by itself is 0.1 off


def test_both_layers_aim_at_the_picture_at_an_opening_edge() -> None:
    level = level_with_an_eye()
    _, fore, _, merged = level.sheets
    edge = (level.opening > 0) & (level.opening < 0.95)
    assert np.allclose(fore.target[edge], merged.target[edge], atol=1e-6)
    assert fore.target[24, 24].mean() > 0.6 > merged.target[24, 24].mean()


def test_local_paths_are_moved_while_there_are_many_but_never_the_lowest_of_a_part() -> None:
    group = np.repeat([FORE, FIRST_LOCAL, FIRST_LOCAL + 1], (80, 12, 8))
    importance = np.ones(100)
    importance[80:] = LEAST_IMPORTANCE / 2
    moved = least_important(importance, group)
    assert len(moved) == 7 and moved.min() > 80 and 92 not in moved


def test_lids_are_never_moved_nor_counted() -> None:
    group = np.repeat([FORE, LID, FIRST_LOCAL], (50, 10, 40))
    importance = np.where(group == FORE, 1.0, 0.0)
    assert group[least_important(importance, group)].tolist() == [FIRST_LOCAL] * 7


def test_few_local_paths_stay_where_they_are() -> None:
    few = int(100 * LOCAL_KEPT)
    group = np.repeat([FORE, FIRST_LOCAL], (100 - few, few))
    importance = np.where(group == FORE, 1.0, 0.0)
    importance[3] = 0.1
    assert least_important(importance, group).tolist() == [3]
