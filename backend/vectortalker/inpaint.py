"""A picture with unknown parts becomes a whole one: a smooth membrane over the gaps, by push and pull in a pyramid."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from scipy.ndimage import uniform_filter

RELAXATIONS = 2  # smoothing rounds a level, which take the pyramid's blocks out
RELAXED_SIDE = 256  # finer levels are smooth enough as they come
EMPTY = 1e-6


def fill(image: NDArray[np.float32], trust: NDArray[np.float32]) -> NDArray[np.float32]:
    """f32 [H, W, 3] that equals `image` where `trust` [H, W] is 1 and continues it smoothly where it is 0.

    Push: averages weighted by trust, halved until one pixel is left. Pull: each level takes what is missing from the
    coarser one. Without any trusted pixel the picture's mean colour is the answer.
    """
    if float(trust.max()) < EMPTY:
        return np.broadcast_to(image.mean(axis=(0, 1)), image.shape).astype(np.float32)
    height, width = trust.shape
    if max(height, width) == 1:
        return image
    coarse_image, coarse_trust = _halve(image, trust)
    coarse = fill(coarse_image, coarse_trust)
    size = (width, height)
    channels = [np.asarray(Image.fromarray(coarse[..., k]).resize(size, Image.Resampling.BILINEAR)) for k in range(3)]
    pulled = np.stack(channels, axis=-1)
    share = trust[..., None]
    filled = share * image + (1 - share) * pulled
    for _ in range(RELAXATIONS if max(height, width) <= RELAXED_SIDE else 0):
        blurred = [uniform_filter(filled[..., k], size=3, mode="nearest") for k in range(3)]
        filled = share * image + (1 - share) * np.stack(blurred, axis=-1)
    return filled.astype(np.float32)


def _halve(image: NDArray[np.float32], trust: NDArray[np.float32]) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Trust-weighted means of 2x2 blocks. A block is as trusted as its best pixel: a thin known rim survives."""
    height, width = trust.shape
    padding = ((0, height % 2), (0, width % 2))
    weight = np.pad(trust, padding)
    weighted = np.pad(image * trust[..., None], (*padding, (0, 0)))
    shape = (weight.shape[0] // 2, 2, weight.shape[1] // 2, 2)
    total = weight.reshape(shape).sum(axis=(1, 3))
    colour = weighted.reshape(*shape, 3).sum(axis=(1, 3)) / np.maximum(total, EMPTY)[..., None]
    return colour.astype(np.float32), weight.reshape(shape).max(axis=(1, 3))
