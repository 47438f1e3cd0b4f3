"""Control points and fills become a picture that torch can differentiate: exact coverage, exact gradients, any loss.

Tensors are on the CPU. Colours are sRGB in [0, 1]; points are pixels (x, y), y down, pixel centres at +0.5. The canvas,
the clip masks and the flags are constants. What is refused, and why, is a `ValueError` naming value and limit.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import torch
import vectortalker_core as core
from numpy.typing import NDArray
from torch import Tensor
from torch.autograd.function import once_differentiable

WHITE = (1.0, 1.0, 1.0)

Floats = NDArray[np.float32]
Grads = tuple[Tensor | None, ...]
Arguments = tuple[Floats, Floats, Floats, NDArray[np.bool_], NDArray[np.int32], Floats, Floats]


@dataclass(frozen=True)
class Paint:
    """What is not differentiated.

    `gradient` bool [n]: linear fill from stop to stop along the axis, else the first stop alone. `clip` i32 [n]: mask
    of `clips` f32 [k, H, W] that multiplies a path's opacity, −1 for none. `subrows` 1, 2 or 4: finer resolution of the
    nonzero rule where paths fold over themselves. `quantise`: round to 8 bits after every blend, as renderers do,
    gradients passing straight through. `threads` 0: all cores; the bits do not depend on it.
    """

    gradient: NDArray[np.bool_] | None = None
    clip: NDArray[np.int32] | None = None
    clips: NDArray[np.float32] | None = None
    canvas: tuple[float, float, float] = WHITE
    subrows: int = 1
    quantise: bool = False
    threads: int = 0


def rasterize(
    points: Tensor, stops: Tensor, axis: Tensor | None = None, *, width: int, height: int, paint: Paint | None = None
) -> Tensor:
    """Picture f32 [height, width, 3] of `points` [n, 3S, 2], `stops` [n, 2 or 3, 4], `axis` [n, 4] (x1, y1, x2, y2).

    Stops are RGBA, evenly spaced along the axis.
    """
    axis = torch.zeros(len(points), 4) if axis is None else axis
    return _Rasterize.apply(points, _with_middle(stops), axis, width, height, paint or Paint())


def loss(
    points: Tensor,
    stops: Tensor,
    axis: Tensor | None = None,
    *,
    target: Tensor,
    weight: Tensor | None = None,
    paint: Paint | None = None,
) -> Tensor:
    """Squared error to `target` [H, W, 3], `Σ weight·|C − target|² / 3HW`; one pass instead of two."""
    axis = torch.zeros(len(points), 4) if axis is None else axis
    weight = torch.ones(target.shape[:2]) if weight is None else weight
    return _Loss.apply(points, _with_middle(stops), axis, target, weight, paint or Paint())


def _with_middle(stops: Tensor) -> Tensor:
    """Three stops [n, 3, 4] that paint as `stops` do: between two, their mean."""
    return torch.stack([stops[:, 0], stops.mean(1), stops[:, 1]], 1) if stops.shape[1] == 2 else stops


class _Rasterize(torch.autograd.Function):
    """Forward paints; backward paints again with the upstream gradient, band by band in cache."""

    @staticmethod
    def forward(ctx: Any, points: Tensor, stops: Tensor, axis: Tensor, width: int, height: int, paint: Paint) -> Tensor:
        ctx.save_for_backward(points, stops, axis)
        ctx.paint, ctx.size = paint, (height, width)
        arrays = _arrays(points, stops, axis, paint, ctx.size)
        image = core.rasterize(*arrays, width, height, paint.subrows, paint.threads, paint.quantise)
        return torch.from_numpy(image)

    @staticmethod
    @once_differentiable  # hides the parameters' names from pyright
    def backward(ctx: Any, *grad_outputs: Tensor) -> Grads:  # pyright: ignore[reportIncompatibleMethodOverride]
        points, stops, axis = ctx.saved_tensors
        arrays = _arrays(points, stops, axis, ctx.paint, ctx.size)
        paint = ctx.paint
        found = core.gradients(*arrays, _array(grad_outputs[0]), paint.subrows, paint.threads, paint.quantise)
        grads = (
            torch.from_numpy(grad).to(of.dtype) for grad, of in zip(found[2:5], (points, stops, axis), strict=True)
        )
        return (*grads, None, None, None)


class _Loss(torch.autograd.Function):
    """Forward finds loss and gradients in one pass; backward scales them."""

    @staticmethod
    def forward(
        ctx: Any, points: Tensor, stops: Tensor, axis: Tensor, target: Tensor, weight: Tensor, paint: Paint
    ) -> Tensor:
        height, width = target.shape[:2]
        arrays = _arrays(points, stops, axis, paint, (height, width))
        checkpoints = [(len(points), core.Target(_array(target), _array(weight)))]
        found = core.loss_and_gradients(
            *arrays, checkpoints, paint.subrows, paint.threads, importance=False, quantise=paint.quantise
        )
        grads = zip(found[2:5], (points, stops, axis), strict=True)
        ctx.save_for_backward(*(torch.from_numpy(grad).to(of.dtype) for grad, of in grads))
        return points.new_tensor(found[0][0])

    @staticmethod
    @once_differentiable  # hides the parameters' names from pyright
    def backward(ctx: Any, *grad_outputs: Tensor) -> Grads:  # pyright: ignore[reportIncompatibleMethodOverride]
        return (*(grad_outputs[0] * grad for grad in ctx.saved_tensors), None, None, None)


def _arrays(points: Tensor, stops: Tensor, axis: Tensor, paint: Paint, size: tuple[int, int]) -> Arguments:
    """The core's first seven arguments."""
    n = len(points)
    gradient = np.zeros(n, np.bool_) if paint.gradient is None else paint.gradient
    clip = np.full(n, -1, np.int32) if paint.clip is None else paint.clip
    clips = np.zeros((0, *size), np.float32) if paint.clips is None else paint.clips
    return _array(points), _array(stops), _array(axis), gradient, clip, clips, np.asarray(paint.canvas, np.float32)


def _array(tensor: Tensor) -> NDArray[np.float32]:
    return tensor.detach().to(torch.float32).contiguous().numpy()
