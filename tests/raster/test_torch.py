"""The torch face: any loss over the picture, the fused loss, and a scene that learns."""

import numpy as np
import pytest
import torch
from vectortalker import raster

from tests.raster.scenes import Scene, blobs, noise, paint

WIDTH, HEIGHT = 31, 23


def leaves(scene: Scene) -> list[torch.Tensor]:
    return [torch.tensor(getattr(scene, name), requires_grad=True) for name in ("points", "stops", "axis")]


def paint_of(scene: Scene, **options: int) -> raster.Paint:
    canvas = (float(scene.canvas[0]), float(scene.canvas[1]), float(scene.canvas[2]))
    return raster.Paint(gradient=scene.gradient, canvas=canvas, **options)


def test_picture_is_the_core_s() -> None:
    scene = blobs(0, 9, WIDTH, HEIGHT, (3, 12))
    got = raster.rasterize(*leaves(scene), width=WIDTH, height=HEIGHT, paint=paint_of(scene))
    np.testing.assert_array_equal(got.detach().numpy(), paint(scene, WIDTH, HEIGHT))


@pytest.mark.parametrize("subrows", [1, 4])
def test_fused_loss_equals_a_loss_over_the_picture(subrows: int) -> None:
    scene = blobs(1, 9, WIDTH, HEIGHT, (3, 12))
    target, weight = (torch.tensor(a) for a in noise(2, HEIGHT, WIDTH))
    apart, fused = leaves(scene), leaves(scene)
    picture = raster.rasterize(*apart, width=WIDTH, height=HEIGHT, paint=paint_of(scene, subrows=subrows))
    one = (weight[..., None] * (picture - target) ** 2).mean()
    two = raster.loss(*fused, target=target, weight=weight, paint=paint_of(scene, subrows=subrows))
    (3 * one).backward()
    (3 * two).backward()
    assert two.item() == pytest.approx(one.item(), rel=1e-5)
    for a, b in zip(apart, fused, strict=True):
        torch.testing.assert_close(a.grad, b.grad, rtol=1e-3, atol=1e-8)


def test_gradients_keep_the_leaves_type() -> None:
    scene = blobs(1, 3, WIDTH, HEIGHT, (3, 12))
    points = torch.tensor(scene.points, dtype=torch.float64, requires_grad=True)
    raster.rasterize(points, torch.tensor(scene.stops), width=WIDTH, height=HEIGHT).sum().backward()
    assert points.grad is not None
    assert points.grad.dtype == torch.float64


def test_adam_moves_a_disc_onto_another() -> None:
    there = blobs(3, 1, WIDTH, HEIGHT, (6, 6), jitter=0)
    with torch.no_grad():
        target = raster.rasterize(
            torch.tensor(there.points),
            torch.tensor(there.stops),
            width=WIDTH,
            height=HEIGHT,
        )
    points = torch.tensor(there.points + np.float32([2, -1.5]), requires_grad=True)
    optimiser = torch.optim.Adam([points], lr=0.1, eps=1e-12)
    losses = []
    for _ in range(80):
        optimiser.zero_grad()
        loss = raster.loss(points, torch.tensor(there.stops), target=target)
        loss.backward()
        optimiser.step()
        losses.append(loss.item())
    assert losses[-1] < 0.01 * losses[0]
