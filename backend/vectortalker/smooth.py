"""A picture becomes its smoothed stack: L0 gradient minimisation (Xu, Lu, Xu, Jia 2011), coarse to fine.

Minimises Σ|S − I|² + λ·#{p : |∂x S| + |∂y S| ≠ 0} by half-quadratic splitting: the auxiliary gradients have a closed
form by thresholding (eq. 12), and the picture one in the Fourier domain (eq. 8).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import fft

PAD = 16  # reflected rim, so that the periodic transform does not join opposite borders
BETA_MAX = 1e3  # 1e5 as published looks the same and costs 7 more rounds
KAPPA = 2.0
FFT_WORKERS = 2
VISIBLE_GRADIENT = 2 / 255
PROBE_SIDE = 160  # strengths are searched on the middle of the picture
PROBE_STRENGTHS = np.geomspace(3e-4, 0.04, 6)

# Shares of pixels with a visible gradient that the coarse levels keep, of the share of the picture itself.
COARSE_SHARES = (0.15, 0.28, 0.42, 0.6)
CEILING_RATIO = 0.4  # each level at most this times as strong as the one before: flat drawings never reach their share


@dataclass(frozen=True)
class Level:
    """One target: `image` f32 [H, W, 3] in 0..1; `strength` is its λ, 0 for the picture itself."""

    image: NDArray[np.float32]
    strength: float


def stack(image: NDArray[np.float32], levels: int = 5) -> list[Level]:
    """Targets coarse to fine of f32 [H, W, 3]; the last is the picture itself.

    λ is not comparable between line art and photographs: it is searched per picture by the gradients it leaves.
    """
    if levels < 1:
        raise ValueError(f"levels is {levels}; at least 1 is needed")
    positions = np.linspace(0, 1, levels)[:-1]
    shares = np.interp(positions, np.linspace(0, 1, len(COARSE_SHARES) + 1), (*COARSE_SHARES, 1.0))
    wanted = _strengths(image, shares)
    ceilings = PROBE_STRENGTHS[-1] * CEILING_RATIO ** np.arange(levels - 1)
    strengths = np.minimum.accumulate(np.minimum(wanted, ceilings)).tolist()
    return [*(Level(l0_smooth(image, strength), strength) for strength in strengths), Level(image, 0.0)]


def l0_smooth(image: NDArray[np.float32], strength: float, beta_max: float = BETA_MAX) -> NDArray[np.float32]:
    """L0-smoothed copy of f32 [H, W, 3], in 0..1, with λ = `strength`."""
    height, width = image.shape[:2]
    rim = min(PAD, height - 1, width - 1)
    rows = fft.next_fast_len(height + 2 * rim, real=True) - height - rim
    cols = fft.next_fast_len(width + 2 * rim, real=True) - width - rim
    # Channel first: the transforms run along contiguous rows.
    padded = np.pad(image.transpose(2, 0, 1), ((0, 0), (rim, rows), (rim, cols)), mode="symmetric").astype(np.float32)
    spectrum = _transform(padded)
    gradient_energy = _gradient_energy(*padded.shape[1:])
    smooth = padded
    beta = 2 * strength
    while beta < beta_max:
        divergence = _thresholded_divergence(smooth, strength / beta)
        weight = np.float32(beta)
        solved = (spectrum + weight * _transform(divergence)) / (1 + weight * gradient_energy)
        smooth = np.asarray(fft.irfft2(solved, s=padded.shape[1:], workers=FFT_WORKERS), np.float32)
        beta *= KAPPA
    cropped = smooth[:, rim : rim + height, rim : rim + width]
    return np.ascontiguousarray(cropped.clip(0, 1).transpose(1, 2, 0), dtype=np.float32)


def visible_share(image: NDArray[np.float32]) -> float:
    """Share of pixels whose largest forward difference in any channel exceeds VISIBLE_GRADIENT."""
    dx = np.abs(np.diff(image, axis=1)).max(axis=2)[:-1]
    dy = np.abs(np.diff(image, axis=0)).max(axis=2)[:, :-1]
    return float((np.maximum(dx, dy) > VISIBLE_GRADIENT).mean())


def _thresholded_divergence(channels: NDArray[np.float32], threshold: float) -> NDArray[np.float32]:
    """divᵀ(h, v) of the periodic forward differences, those with Σ(h² + v²) below the threshold set to zero."""
    dx = np.roll(channels, -1, axis=2) - channels
    dy = np.roll(channels, -1, axis=1) - channels
    kept = np.einsum("chw,chw->hw", dx, dx) + np.einsum("chw,chw->hw", dy, dy) >= threshold
    dx *= kept
    dy *= kept
    return np.roll(dx, 1, axis=2) - dx + np.roll(dy, 1, axis=1) - dy


def _transform(channels: NDArray[np.float32]) -> NDArray[np.complex64]:
    return np.asarray(fft.rfft2(channels, workers=FFT_WORKERS), np.complex64)


def _gradient_energy(height: int, width: int) -> NDArray[np.float32]:
    """|F(∂x)|² + |F(∂y)|² of the periodic forward differences, [height, width // 2 + 1]."""
    ky = 2 - 2 * np.cos(2 * np.pi * fft.fftfreq(height))
    kx = 2 - 2 * np.cos(2 * np.pi * fft.rfftfreq(width))
    return (ky[:, None] + kx[None]).astype(np.float32)


def _strengths(image: NDArray[np.float32], relative_shares: NDArray[np.float64]) -> list[float]:
    """λ for each share of the picture's own visible gradients, by a curve measured on the middle of the picture."""
    if not relative_shares.size:
        return []
    height, width = image.shape[:2]
    top, left = max(0, (height - PROBE_SIDE) // 2), max(0, (width - PROBE_SIDE) // 2)
    probe = image[top : top + PROBE_SIDE, left : left + PROBE_SIDE]
    left_over = [visible_share(l0_smooth(probe, float(strength))) for strength in PROBE_STRENGTHS]
    falling = np.minimum.accumulate(left_over)
    logs = np.interp(relative_shares * visible_share(probe), falling[::-1], np.log(PROBE_STRENGTHS)[::-1])
    return [float(strength) for strength in np.exp(logs)]
