"""L0 smoothing against its slow readable twin, its closed forms, and the order of the stack."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from vectortalker.decode import Portrait, canonical
from vectortalker.smooth import BETA_MAX, KAPPA, PAD, l0_smooth, stack

RNG = np.random.default_rng(5)


def slow_l0_smooth(image: np.ndarray, strength: float) -> np.ndarray:
    """Xu et al. 2011, algorithm 1, in double precision with complex transforms."""
    padded = np.pad(image.astype(float), ((PAD, PAD), (PAD, PAD), (0, 0)), mode="symmetric")
    ky, kx = (2 * np.pi * np.fft.fftfreq(n) for n in padded.shape[:2])
    energy = ((2 - 2 * np.cos(ky))[:, None] + (2 - 2 * np.cos(kx))[None])[..., None]
    smooth, beta = padded, 2 * strength
    while beta < BETA_MAX:
        h = np.roll(smooth, -1, axis=1) - smooth
        v = np.roll(smooth, -1, axis=0) - smooth
        small = (h**2 + v**2).sum(axis=2) < strength / beta
        h[small] = v[small] = 0
        divergence = np.roll(h, 1, axis=1) - h + np.roll(v, 1, axis=0) - v
        right = np.fft.fft2(padded, axes=(0, 1)) + beta * np.fft.fft2(divergence, axes=(0, 1))
        smooth = np.fft.ifft2(right / (1 + beta * energy), axes=(0, 1)).real
        beta *= KAPPA
    return smooth[PAD:-PAD, PAD:-PAD].clip(0, 1)


def test_agrees_with_the_slow_twin() -> None:
    steps = np.kron(RNG.random((3, 4, 3)), np.ones((16, 12, 1)))  # 48 + 2·16 = 80 rows and columns: no extra rim
    image = (steps + 0.02 * RNG.standard_normal(steps.shape)).clip(0, 1).astype(np.float32)
    assert np.abs(l0_smooth(image, 0.01) - slow_l0_smooth(image, 0.01)).max() < 2e-3


def test_flat_picture_stays() -> None:
    flat = np.full((40, 50, 3), 0.3, np.float32)
    assert np.abs(l0_smooth(flat, 0.05) - flat).max() < 1e-5


def test_noise_goes_and_a_strong_edge_stays() -> None:
    edge = np.zeros((64, 64, 3), np.float32)
    edge[:, 32:] = 1
    smooth = l0_smooth(
        (edge + 0.03 * RNG.standard_normal(edge.shape)).clip(0, 1).astype(np.float32),
        0.02,
    )
    assert smooth[:, :30].std() < 0.003
    assert smooth[:, 33].min() - smooth[:, 30].max() > 0.9


def test_stack_comes_nearer_to_the_picture_and_ends_with_it(
    sample: Callable[[str], Portrait],
) -> None:
    image = canonical(sample("astronaut.jpg"), 256).astype(np.float32) / 255
    levels = stack(image, 5)
    errors = [float(((level.image - image) ** 2).mean()) for level in levels]
    assert errors == sorted(errors, reverse=True)
    assert levels[-1].image is image and levels[-1].strength == 0
    assert all(level.image.shape == image.shape for level in levels)


def test_stack_of_one_level_is_the_picture() -> None:
    image = np.zeros((20, 20, 3), np.float32)
    (only,) = stack(image, 1)
    assert only.image is image
