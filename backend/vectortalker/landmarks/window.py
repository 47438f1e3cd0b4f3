"""A rotated rectangle of a picture becomes the square input of a model.

The nets were trained behind one sampling rule; half a pixel of shift or a smoothing filter costs .7-.9 % of the eye
distance. Output pixel i reads the rectangle at i / size (no half-pixel shift, no antialiasing), bilinearly, at places
rounded to 1/32 px, and the result is rounded to 8 bits.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

SUB_PIXELS = 32


@dataclass(frozen=True)
class Window:
    """Rectangle in picture pixels (sample i of a row at x = i), rotated clockwise on screen by `angle` radians."""

    cx: float
    cy: float
    width: float
    height: float
    angle: float = 0.0

    @classmethod
    def square_around(cls, image: NDArray[np.uint8], angle: float = 0.0) -> Window:
        """The square of the longer side, centred: a letterbox."""
        height, width = image.shape[:2]
        side = float(max(width, height))
        return cls(width / 2, height / 2, side, side, angle)

    def to_picture(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Points [..., 2] in window units (0..1 across) to picture pixels."""
        u = (points[..., 0] - 0.5) * self.width
        v = (points[..., 1] - 0.5) * self.height
        cos, sin = np.cos(self.angle), np.sin(self.angle)
        return np.stack([self.cx + cos * u - sin * v, self.cy + sin * u + cos * v], axis=-1)


def sample(image: NDArray[np.uint8], window: Window, size: int, *, extend_border: bool) -> NDArray[np.float32]:
    """f32 [1, size, size, 3] of values 0..255; outside the picture: its border, or black."""
    fixed = _fixed_positions(_to_picture_matrix(window, size), size)
    whole, part = fixed // SUB_PIXELS, fixed % SUB_PIXELS
    fx, fy = part[..., 0, None], part[..., 1, None]
    x, y = whole[..., 0], whole[..., 1]

    def tap(rows: NDArray[np.int64], cols: NDArray[np.int64]) -> NDArray[np.int64]:
        height, width = image.shape[:2]
        values = image[rows.clip(0, height - 1), cols.clip(0, width - 1)].astype(np.int64)
        if extend_border:
            return values
        inside = (rows >= 0) & (rows < height) & (cols >= 0) & (cols < width)
        return values * inside[..., None]

    top = (SUB_PIXELS - fx) * tap(y, x) + fx * tap(y, x + 1)
    bottom = (SUB_PIXELS - fx) * tap(y + 1, x) + fx * tap(y + 1, x + 1)
    total = (SUB_PIXELS - fy) * top + fy * bottom
    return ((total + SUB_PIXELS**2 // 2) // SUB_PIXELS**2).astype(np.float32)[None]


def _to_picture_matrix(window: Window, size: int) -> NDArray[np.float64]:
    """Homography [3, 3], output pixels to picture pixels, found through the four corners as the reference chain does.

    For some picture sizes every sample lies on a rounding tie, and which way it falls is decided by the rounding errors
    of single-precision corners, an 8x8 solve and an inversion: the closed form would move the mesh by up to .7 %.
    """
    single = np.float32
    degrees = single(float(single(window.angle) * single(180)) / np.pi)
    radians = float(degrees) * np.pi / 180
    half_cos, half_sin = single(single(np.cos(radians)) * single(0.5)), single(single(np.sin(radians)) * single(0.5))
    cx, cy, width, height = (single(v) for v in (window.cx, window.cy, window.width, window.height))
    low_left = (cx - half_sin * height - half_cos * width, cy + half_cos * height - half_sin * width)
    top_left = (cx + half_sin * height - half_cos * width, cy - half_cos * height - half_sin * width)
    opposite = [(2 * cx - x, 2 * cy - y) for x, y in (low_left, top_left)]
    rows_x, rows_y, targets = [], [], []
    for (x, y), (u, v) in zip(
        (low_left, top_left, *opposite), ((0, size), (0, 0), (size, 0), (size, size)), strict=True
    ):
        rows_x.append([x, y, 1, 0, 0, 0, -x * u, -y * u])
        rows_y.append([0, 0, 0, x, y, 1, -x * v, -y * v])
        targets.append((u, v))
    solution = _solve(np.array(rows_x + rows_y, np.float64), np.array(targets, np.float64).T.ravel())
    return _invert(np.append(solution, 1.0).reshape(3, 3))


def _solve(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
    """Gaussian elimination with partial pivoting, in the reference's order of operations."""
    n = len(b)
    for i in range(n):
        pivot = i + int(np.argmax(np.abs(a[i:, i])))
        a[[i, pivot]], b[[i, pivot]] = a[[pivot, i]], b[[pivot, i]]
        for j in range(i + 1, n):
            factor = a[j, i] * (-1 / a[i, i])
            a[j, i + 1 :] += factor * a[i, i + 1 :]
            b[j] += factor * b[i]
    for i in reversed(range(n)):
        for k in range(i + 1, n):
            b[i] -= a[i, k] * b[k]
        b[i] /= a[i, i]
    return b


def _invert(matrix: NDArray[np.float64]) -> NDArray[np.float64]:
    """Inverse [3, 3] by cofactors, in the reference's order of operations."""
    (a, b, c), (d, e, f), (g, h, i) = matrix
    scale = 1 / (a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g))
    cofactors = [
        [e * i - f * h, c * h - b * i, b * f - c * e],
        [f * g - d * i, a * i - c * g, c * d - a * f],
        [d * h - e * g, b * g - a * h, a * e - b * d],
    ]
    return np.array(cofactors) * scale


def _fixed_positions(matrix: NDArray[np.float64], size: int) -> NDArray[np.int64]:
    """Picture positions [size, size, 2] (x, y) of all output pixels in units of 1 / SUB_PIXELS px."""
    row, block, within = np.arange(size)[:, None], np.arange(size) // 64 * 64, np.arange(size) % 64

    def linear(k: int) -> NDArray[np.float64]:
        return matrix[k, 0] * block + matrix[k, 1] * row + matrix[k, 2] + matrix[k, 0] * within

    scale = SUB_PIXELS / linear(2)
    return np.rint(np.stack([linear(0) * scale, linear(1) * scale], axis=-1)).astype(np.int64)
