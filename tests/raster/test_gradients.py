"""Gradients against a float64 twin and finite differences; importance against real removal."""

from dataclasses import replace

import numpy as np
import pytest
import torch
import vectortalker_core as core

from tests.raster import twin
from tests.raster.scenes import Checkpoints, Scene, blobs, noise, paint, placed, polygon, solid

WIDTH, HEIGHT = 37, 29


def differentiate(scene: Scene, checkpoints: Checkpoints, **options: object) -> dict[str, np.ndarray]:
    names = ("losses", "image", "points", "stops", "axis", "importance")
    return dict(
        zip(
            names,
            core.loss_and_gradients(**scene.arguments(), checkpoints=placed(checkpoints), **options),
            strict=True,
        )
    )


def checkpoints_of(scene: Scene, seed: int = 5) -> Checkpoints:
    """One half-way up the stack and one at its top, with random targets and weights."""
    n = len(scene.points)
    return [(n // 2, *noise(seed, HEIGHT, WIDTH)), (n, *noise(seed + 1, HEIGHT, WIDTH))]


def twin_of(scene: Scene, checkpoints: Checkpoints, subrows: int) -> dict[str, np.ndarray]:
    leaves = {
        name: torch.tensor(getattr(scene, name), dtype=torch.float64, requires_grad=True)
        for name in ("points", "stops", "axis")
    }
    canvas = torch.tensor(scene.canvas, dtype=torch.float64)
    pictures = twin.rasterize(*leaves.values(), scene.gradient.tolist(), canvas, (HEIGHT, WIDTH), subrows)
    loss = torch.zeros((), dtype=torch.float64)
    for below, target, weight in checkpoints:
        square = (pictures[below] - torch.tensor(target)) ** 2
        loss = loss + (torch.tensor(weight)[..., None] * square).sum() / (3 * HEIGHT * WIDTH)
    loss.backward()
    grads = {name: leaf.grad.numpy() for name, leaf in leaves.items() if leaf.grad is not None}
    return {
        "losses": loss.detach().numpy(),
        "image": pictures[-1].detach().numpy(),
        **grads,
    }


@pytest.mark.parametrize(("seed", "subrows"), [(0, 1), (1, 1), (2, 4), (3, 2)])
def test_all_agree_with_the_twin(seed: int, subrows: int) -> None:
    scene = blobs(seed, 7, WIDTH, HEIGHT, (4, 25), segments=5)  # many cross the borders of the canvas
    checkpoints = checkpoints_of(scene)
    got, expected = (
        differentiate(scene, checkpoints, subrows=subrows),
        twin_of(scene, checkpoints, subrows),
    )
    assert got["losses"].sum() == pytest.approx(float(expected["losses"]), rel=1e-5)
    np.testing.assert_allclose(got["image"], expected["image"], atol=2e-5)
    for name in ("points", "stops", "axis"):
        np.testing.assert_allclose(
            got[name],
            expected[name],
            atol=2e-4 * abs(expected[name]).max(),
            err_msg=name,
        )


def test_points_agree_with_finite_differences_where_chords_cross_the_canvas() -> None:
    corners = [
        (-6.3, 4.2),
        (12.7, -5.1),
        (44.6, 9.4),
        (30.2, 33.3),
        (9.9, 26.2),
    ]  # crosses all four borders
    scene = solid(polygon(*corners), colour=(0.9, 0.2, 0.4), opacity=0.7)
    checkpoints = [(1, *noise(8, HEIGHT, WIDTH))]
    got = differentiate(scene, checkpoints)["points"].reshape(-1)
    step = 0.05  # short enough for the curvature, long enough for f32
    for i in range(got.size):
        up, down = (differentiate(scene.changed("points", i, s), checkpoints)["losses"][0] for s in (step, -step))
        assert got[i] == pytest.approx((up - down) / (2 * step), abs=0.01 * float(abs(got).max()))


def test_horizontal_edge_has_its_vertical_gradient() -> None:
    scene = solid(polygon((2, 3.5), (10, 3.5), (10, 9), (2, 9)))
    target, weight = (
        np.zeros((HEIGHT, WIDTH, 3), np.float32),
        np.ones((HEIGHT, WIDTH), np.float32),
    )
    got = differentiate(scene, [(1, target, weight)])["points"][0, :4, 1].sum()
    # Moving the top side down uncovers 8 half-covered pixels: d(v²) = 2·½ each, in the mean over 29·37.
    assert got == pytest.approx(8 * 2 * 0.5 / (HEIGHT * WIDTH), rel=1e-4)


def test_checkpoints_add_up() -> None:
    scene = blobs(4, 9, WIDTH, HEIGHT, (4, 20))
    low, top = checkpoints_of(scene)
    both, one, two = (differentiate(scene, c) for c in ([low, top], [low], [top]))
    np.testing.assert_allclose(both["losses"], [one["losses"][0], two["losses"][0]])
    np.testing.assert_allclose(both["points"], one["points"] + two["points"], atol=1e-9)


def test_paths_above_the_last_checkpoint_are_painted_but_not_pulled() -> None:
    scene = blobs(4, 9, WIDTH, HEIGHT, (4, 20))
    got = differentiate(scene, [(5, *noise(0, HEIGHT, WIDTH))])
    assert abs(got["stops"][:5]).max() > 0
    assert not got["stops"][5:].any()
    np.testing.assert_array_equal(got["image"], paint(scene, WIDTH, HEIGHT))


@pytest.mark.parametrize("subrows", [1, 4])
def test_importance_is_the_loss_increase_of_removal(subrows: int) -> None:
    scene = blobs(6, 12, WIDTH, HEIGHT, (4, 20))
    scene.stops[3, :, 3] = 1  # opaque: nothing below it may divide by 1 − α
    checkpoints = checkpoints_of(scene)
    got = differentiate(scene, checkpoints, importance=True, subrows=subrows)
    for i, importance in enumerate(got["importance"]):
        removed = differentiate(scene.without(i), checkpoints, subrows=subrows)["losses"].sum()
        assert importance == pytest.approx(removed - got["losses"].sum(), abs=1e-6)


def test_clipped_path_answers_inside_its_mask_only() -> None:
    scene = blobs(7, 3, WIDTH, HEIGHT, (8, 20))
    mask = np.zeros((1, HEIGHT, WIDTH), np.float32)
    clipped = replace(scene, clip=np.array([-1, 0, -1], np.int32), clips=mask)
    target, weight = noise(1, HEIGHT, WIDTH)
    got = differentiate(clipped, [(3, target, weight)])
    assert not got["points"][1].any()
    assert not got["stops"][1].any()
    half = replace(clipped, clips=mask + 0.5)
    faint = replace(
        scene,
        stops=scene.stops * np.array([[[1, 1, 1, 1]], [[1, 1, 1, 0.5]], [[1, 1, 1, 1]]], np.float32),
    )
    one, two = (differentiate(s, [(3, target, weight)]) for s in (half, faint))
    np.testing.assert_allclose(one["points"], two["points"], atol=1e-8)


def test_quantised_gradient_passes_straight_through() -> None:
    scene = blobs(9, 1, WIDTH, HEIGHT, (8, 20))
    target, weight = noise(1, HEIGHT, WIDTH)
    exact, rounded = (differentiate(scene, [(1, target, weight)], quantise=q) for q in (False, True))
    np.testing.assert_allclose(rounded["points"], exact["points"], atol=0.02 * abs(exact["points"]).max())


@pytest.mark.parametrize("every", [2, 3])
def test_samples_of_bands_are_right_on_the_mean(every: int) -> None:
    scene = blobs(11, 30, WIDTH, HEIGHT, (2, 20))
    whole = differentiate(scene, checkpoints_of(scene), importance=True)
    turns = [differentiate(scene, checkpoints_of(scene), importance=True, bands=(every, i)) for i in range(every)]
    for name in ("losses", "points", "stops", "axis", "importance"):
        mean = sum(turn[name] for turn in turns) / every
        np.testing.assert_allclose(mean, whole[name], atol=1e-6 * abs(whole[name]).max())


@pytest.mark.parametrize("threads", [2, 5])
def test_bits_do_not_depend_on_threads(threads: int) -> None:
    scene = blobs(10, 150, WIDTH, HEIGHT, (2, 20))  # outlines are made in parts of 64 paths
    one, many = (differentiate(scene, checkpoints_of(scene), importance=True, threads=t) for t in (1, threads))
    assert all(one[name].tobytes() == many[name].tobytes() for name in one)
