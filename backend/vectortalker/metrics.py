"""An SVG text and a portrait become scores (docs/benchmarks.md): what resvg paints at the working size is compared."""

from __future__ import annotations

import gzip
import io

import numpy as np
import resvg_py
from numpy.typing import NDArray
from PIL import Image
from scipy.ndimage import correlate1d

MIN_MSE = 1e-12  # identical pictures score 120 dB, not infinity
SSIM_SIGMA = 1.5  # Wang et al. 2004, section III-B
SSIM_RADIUS = 5  # their 11 × 11 window
C1, C2 = 0.01**2, 0.03**2  # their K1, K2 for a data range of 1


def render(svg: str, width: int, height: int) -> NDArray[np.uint8]:
    """Picture of an SVG over white by resvg, uint8 [height, width, 3]."""
    png = resvg_py.svg_to_bytes(svg_string=svg, width=width, height=height)
    picture = Image.open(io.BytesIO(bytes(png))).convert("RGBA")
    white = Image.new("RGBA", picture.size, "white")
    white.alpha_composite(picture)
    return np.asarray(white.convert("RGB"))


def mse(picture: NDArray[np.uint8], target: NDArray[np.uint8]) -> float:
    """Mean squared error of values in [0, 1]."""
    return float(np.mean((picture.astype(np.float64) - target.astype(np.float64)) ** 2)) / 255**2


def psnr(mean_squared_error: float) -> float:
    """Peak signal-to-noise ratio in dB for a peak of 1."""
    return float(-10 * np.log10(max(mean_squared_error, MIN_MSE)))


def ssim(picture: NDArray[np.uint8], target: NDArray[np.uint8]) -> float:
    """Structural similarity with Wang's Gaussian window, mean over channels; equal to scikit-image's so set (tested).

    Both [H, W, 3]. Where a side is shorter than the window, its border pixels count too.
    """
    x, y = picture.astype(np.float64) / 255, target.astype(np.float64) / 255
    mean_x, mean_y = _window_mean(x), _window_mean(y)
    variance_x = _window_mean(x * x) - mean_x**2
    variance_y = _window_mean(y * y) - mean_y**2
    covariance = _window_mean(x * y) - mean_x * mean_y
    luminance = (2 * mean_x * mean_y + C1) / (mean_x**2 + mean_y**2 + C1)
    structure = (2 * covariance + C2) / (variance_x + variance_y + C2)
    rows, columns = (slice(SSIM_RADIUS, -SSIM_RADIUS) if n > 2 * SSIM_RADIUS else slice(None) for n in x.shape[:2])
    return float((luminance * structure)[rows, columns].mean())


def _window_mean(image: NDArray[np.float64]) -> NDArray[np.float64]:
    offsets = np.arange(-SSIM_RADIUS, SSIM_RADIUS + 1)
    weights = np.exp(-0.5 * (offsets / SSIM_SIGMA) ** 2)
    weights /= weights.sum()
    return correlate1d(correlate1d(image, weights, axis=0), weights, axis=1)


def file_sizes(svg: str) -> tuple[int, int]:
    """Bytes of the text and of its gzip."""
    data = svg.encode()
    return len(data), len(gzip.compress(data, 6, mtime=0))
