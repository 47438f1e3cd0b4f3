"""Closed forms of resizing by area averaging."""

from __future__ import annotations

import numpy as np
from vectortalker.vectorize.resize import resize


def test_halving_averages_four_pixels() -> None:
    image = np.arange(16, dtype=np.float32).reshape(4, 4)
    np.testing.assert_allclose(resize(image, (2, 2)), [[2.5, 4.5], [10.5, 12.5]])  # (0 + 1 + 4 + 5) / 4 = 2.5


def test_channels_are_resized_apart() -> None:
    image = np.stack([np.zeros((4, 6), np.float32), np.ones((4, 6), np.float32)], axis=2)
    np.testing.assert_array_equal(resize(image, (3, 2)), np.broadcast_to(np.float32([0, 1]), (2, 3, 2)))


def test_no_channels_stay_none() -> None:
    """Openings of a person without a face."""
    assert resize(np.empty((4, 6, 0), np.float32), (3, 2)).shape == (2, 3, 0)
