"""Faces that the optimiser hardly sees."""

from __future__ import annotations

import numpy as np
import pytest
from vectortalker.decode import Portrait
from vectortalker.schema import Landmarks, VectorizeOptions
from vectortalker.vectorize import vectorize

TINY = VectorizeOptions(paths=16, levels=1, final_iterations=2, working_size=64)


@pytest.mark.parametrize("size", [1.0, 8.0, 40.0, 400.0])
def test_face_of_any_size_is_vectorised(size: float) -> None:
    """A face of `size` portrait px in a portrait of 512, seen at 64 px: from an eighth of a pixel to most of it."""
    y, x = np.mgrid[0:512, 0:512]
    rgb = np.stack([x // 2, y // 2, 128 + 0 * x], axis=-1).astype(np.uint8)
    angle = np.linspace(0, 2 * np.pi, 68)
    points = [(256 + size / 2 * np.cos(a), 256 + size / 2 * np.sin(a)) for a in angle]
    steps = vectorize(Portrait(rgb, None, "ring", ()), Landmarks(points=points), TINY)
    while True:
        try:
            next(steps)
        except StopIteration as end:
            scene = end.value.scene
            break
    assert len(scene.back) + len(scene.fore) + len(scene.local) == 16
