"""sRGB becomes OKLab and back (Ottosson 2020): L, a, b in which equal steps look equal."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

RGB_TO_LMS = np.array(
    [
        [0.4122214708, 0.5363325363, 0.0514459929],
        [0.2119034982, 0.6806995451, 0.1073969566],
        [0.0883024619, 0.2817188376, 0.6299787005],
    ]
)
LMS_TO_LAB = np.array(
    [
        [0.2104542553, 0.7936177850, -0.0040720468],
        [1.9779984951, -2.4285922050, 0.4505937099],
        [0.0259040371, 0.7827717662, -0.8086757660],
    ]
)


def to_oklab(srgb: NDArray[np.float64]) -> NDArray[np.float64]:
    """[..., 3] of gamma-encoded sRGB in 0..1 to L, a, b."""
    linear = np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)
    return np.cbrt(linear @ RGB_TO_LMS.T) @ LMS_TO_LAB.T


def to_srgb(lab: NDArray[np.float64]) -> NDArray[np.float64]:
    """[..., 3] of L, a, b to gamma-encoded sRGB, clipped to 0..1."""
    linear = (lab @ np.linalg.inv(LMS_TO_LAB).T) ** 3 @ np.linalg.inv(RGB_TO_LMS).T
    linear = linear.clip(0, 1)
    return np.where(linear <= 0.0031308, linear * 12.92, 1.055 * linear ** (1 / 2.4) - 0.055)
