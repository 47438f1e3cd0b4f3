"""The ground: one opaque path under all others, so that a portrait that moves never uncovers what lies behind it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from vectortalker.scene import NO_PART, STOPS, Layer
from vectortalker.vectorize.starts import circle

REACH = 1.02  # of half the frame's diagonal: more than what renderers round the frame's sides by


def with_ground(back: Layer, canvas: NDArray[np.float32], width: float, height: float) -> Layer:
    """The layer, in px of a frame of `width` × `height`, on a disc that holds the frame in the colour `canvas` f32 [3].

    The optimiser paints over a canvas of that colour, so the picture at rest stays what it fitted.
    """
    radius = REACH * np.hypot(width, height) / 2
    disc = circle((width / 2, height / 2), radius, back.points.shape[1] // 3)
    return Layer(
        np.concatenate([disc[None], back.points]),
        np.concatenate([np.tile(np.append(canvas, np.float32(1)), (1, STOPS, 1)), back.stops]),
        np.concatenate([np.zeros((1, 4), np.float32), back.axis]),
        np.append(False, back.gradient),
        np.append(NO_PART, back.part),
    )
