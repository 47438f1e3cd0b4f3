"""The optimiser's state: Adam against torch, painter's order, moves between resolutions."""

from __future__ import annotations

import numpy as np
import pytest
import torch
from vectortalker.vectorize import adam
from vectortalker.vectorize.level import BACK, FIRST_LOCAL, FORE, LID
from vectortalker.vectorize.population import Population, Rates, empty_population, insert, move, rescale
from vectortalker.vectorize.starts import START_OPACITY, Start, circle

RATES = Rates(points=1.0, colour=0.05, opacity=0.05, axis=1.0, beta2=0.99)


def start(x: float) -> Start:
    stops = np.full((3, 4), 0.5, np.float32)
    stops[:, 3] = START_OPACITY
    return Start(circle((x, 10), 5, 4), stops, np.array([x, 0, x + 1, 0], np.float32))


def population(*groups: int) -> Population:
    starts = [start(10.0 * i) for i in range(len(groups))]
    return insert(empty_population(4), starts, np.array(groups), gradient=True)


def test_adam_equals_torch_for_rows_of_one_age() -> None:
    generator = np.random.default_rng(0)
    values = generator.normal(size=(3, 4)).astype(np.float32)
    parameter = torch.nn.Parameter(torch.tensor(values))
    optimiser = torch.optim.Adam([parameter], lr=0.1, betas=(adam.BETA1, 0.99), eps=adam.EPSILON)
    moments, age = adam.Moments.zeros(values.shape), np.zeros(3, np.int64)
    for _ in range(20):
        gradient = generator.normal(size=(3, 4)).astype(np.float32)
        parameter.grad = torch.tensor(gradient)
        optimiser.step()
        age += 1
        adam.step(values, gradient, moments, age, 0.1, 0.99)
    assert np.allclose(values, parameter.detach().numpy(), atol=1e-5)


def test_adam_keeps_each_column_within_its_limits() -> None:
    values = np.zeros((2, 3, 2), np.float32)
    moments, age = adam.Moments.zeros(values.shape), np.ones(2, np.int64)
    limits = (np.array([-1, -9], np.float32), np.array([0.5, 9], np.float32))
    adam.step(values, np.full((2, 3, 2), -1, np.float32), moments, age, 2.0, 0.99, limits)  # a first step is the rate
    assert np.allclose(values, [0.5, 2.0])


def test_adam_refuses_gradients_of_another_shape() -> None:
    values = np.zeros((2, 2), np.float32)
    with pytest.raises(ValueError, match="gradient holds 3 values"):
        adam.step(values, np.zeros(3, np.float32), adam.Moments.zeros((2, 2)), np.ones(2, np.int64), 1.0, 0.99)


def test_insert_puts_new_paths_on_top_of_their_group_without_moments() -> None:
    old = population(BACK, FORE, FIRST_LOCAL)
    old.moments["points"].first[:] = 7
    new = insert(old, [start(100.0), start(200.0)], np.array([FORE, BACK]), gradient=True)
    assert new.group.tolist() == [BACK, BACK, FORE, FORE, FIRST_LOCAL]
    assert new.axis[:, 0].tolist() == [0, 200, 10, 100, 20]
    assert (new.moments["points"].first[[1, 3]] == 0).all()
    assert (new.moments["points"].first[[0, 2, 4]] == 7).all()


def test_below_counts_the_paths_under_a_group() -> None:
    paths = population(BACK, BACK, FORE, FIRST_LOCAL + 2)
    assert [paths.below(group) for group in (BACK, FORE, FIRST_LOCAL, FIRST_LOCAL + 3)] == [0, 2, 3, 4]


def test_lids_stay_between_fore_and_local_where_they_were_made() -> None:
    paths = population(FORE, LID, FIRST_LOCAL)
    paths = insert(paths, [start(100.0)], np.array([FORE]), gradient=True)
    assert paths.group.tolist() == [FORE, FORE, LID, FIRST_LOCAL]
    lid = paths.points[2].copy()
    for _ in range(3):
        push = {name: np.ones_like(getattr(paths, name)) for name in ("points", "stops", "axis")}
        move(paths, push, RATES, (200, 200), opaque=False)
    assert (paths.points[2] == lid).all() and (paths.stops[2, :, :3] == 0.5).all()
    assert (paths.points[[0, 1, 3]] != start(0.0).points).any()


def test_move_keeps_what_svg_can_paint() -> None:
    paths = population(FORE, FORE)
    pull = {name: np.full_like(getattr(paths, name), -1e3) for name in ("points", "stops", "axis")}
    for _ in range(200):
        move(paths, pull, RATES, (20, 20), opaque=False)
    assert paths.stops.max() == 1
    assert paths.points.max() == 20 + 64


def test_opaque_paths_stay_opaque() -> None:
    paths = population(FORE)
    push = {name: np.ones_like(getattr(paths, name)) for name in ("points", "stops", "axis")}
    move(paths, push, RATES, (20, 20), opaque=True)
    assert (paths.stops[..., 3] == 1).all()


def test_rescale_moves_the_paths_and_forgets_the_moments() -> None:
    paths = population(BACK, FORE)
    paths.moments["axis"].second[:] = 3
    paths.age[:] = 5
    larger = rescale(paths, (109, 128), (437, 512))
    assert np.allclose(larger.points[0, 0], paths.points[0, 0] * [437 / 109, 4])
    assert not larger.moments["axis"].second.any() and not larger.age.any()
    back = rescale(larger, (437, 512), (109, 128))
    assert np.allclose(back.points, paths.points, rtol=1e-6)
