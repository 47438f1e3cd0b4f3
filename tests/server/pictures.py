"""Pictures and faces that the tests make themselves."""

from __future__ import annotations

import io
import math

import numpy as np
from PIL import Image


def picture(width: int = 96, height: int = 128) -> bytes:
    """A smooth colourful PNG, the same every time."""
    y, x = np.mgrid[0:height, 0:width]
    waves = [128 + 90 * np.sin(x / 17 + k) * np.cos(y / 23 - k) for k in range(3)]
    file = io.BytesIO()
    Image.fromarray(np.stack(waves, axis=-1).astype(np.uint8)).save(file, "PNG")
    return file.getvalue()


def figure(width: int, height: int) -> bytes:
    """The same, cut out to an ellipse: nobody need look for what is in front."""
    y, x = np.mgrid[0:height, 0:width]
    inside = (x / width - 0.5) ** 2 + (y / height - 0.5) ** 2 < 0.4**2
    cut_out = Image.open(io.BytesIO(picture(width, height)))
    cut_out.putalpha(Image.fromarray(np.where(inside, 255, 0).astype(np.uint8)))
    file = io.BytesIO()
    cut_out.save(file, "PNG")
    return file.getvalue()


def face_points(x: float, y: float, size: float = 30) -> list[list[float]]:
    """68 landmarks of a plain round face about (x, y), of `size` px from its middle to a cheek."""
    jaw = [(-math.cos(math.pi * i / 16), 0.1 + math.sin(math.pi * i / 16)) for i in range(17)]
    brows = [(side * 0.45 + (i - 2) * 0.12, -0.5 - 0.03 * (2 - abs(i - 2))) for side in (-1, 1) for i in range(5)]
    nose = [(0, -0.25 + 0.13 * i) for i in range(4)] + [((i - 2) * 0.08, 0.25) for i in range(5)]
    eyes = [(side * 0.42 + dx, -0.25 + dy) for side in (-1, 1) for dx, dy in _ring(6, 0.16, 0.06)]
    mouth = [(dx, 0.55 + dy) for dx, dy in [*_ring(12, 0.32, 0.12), *_ring(8, 0.24, 0.01)]]
    return [[x + size * dx, y + size * dy] for dx, dy in [*jaw, *brows, *nose, *eyes, *mouth]]


def _ring(n: int, width: float, height: float) -> list[tuple[float, float]]:
    """`n` points of an ellipse from its image-left corner over the top."""
    turns = [2 * math.pi * i / n for i in range(n)]
    return [(-width * math.cos(turn), -height * math.sin(turn)) for turn in turns]
