"""Float images at another resolution, by area averaging."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from PIL import Image


def resize(image: NDArray[np.float32], frame: tuple[int, int]) -> NDArray[np.float32]:
    """`image` f32 [H, W] or [H, W, C], C ≥ 0, scaled to `frame` (width, height); the same array if it has that size."""
    if (image.shape[1], image.shape[0]) == frame:
        return image
    if image.ndim == 3:
        resized = np.empty((frame[1], frame[0], image.shape[2]), np.float32)
        for channel in range(image.shape[2]):
            resized[..., channel] = resize(np.ascontiguousarray(image[..., channel]), frame)
        return resized
    return np.asarray(Image.fromarray(image).resize(frame, Image.Resampling.BOX))
