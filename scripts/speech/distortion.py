"""Turns log-mel frames of one recording into those of another voice, microphone and place, anew for each batch."""

from __future__ import annotations

import numpy as np
from scipy import fft, ndimage
from vectortalker.speech.features import N_MELS

WARP = (0.88, 1.12)  # of the mel axis
NOISE_BELOW = (1.5, 10.0)  # nats of power (6 to 43 dB) from the clip's loudest moments down to the noise
COLOUR = 0.5  # nats, deviation of the knots of a smooth response
CONTRAST = (0.8, 1.2)  # of log powers: vocoders flatten spectra, diphones do not
SMOOTH_SHARE, CEPSTRA = 0.3, (14, 30)  # of clips whose spectra keep that many cepstral coefficients, as vocoders' do
BLUR_SHARE, BLUR = 0.3, (3, 9)  # of clips smoothed over that many frames, as parametric voices are
COSINES = fft.dct(np.eye(N_MELS, dtype=np.float32), norm="ortho", axis=0)  # [N_MELS, N_MELS], a coefficient a row


def at(rows: np.ndarray, places: np.ndarray) -> np.ndarray:
    """Rows at fractional places, linear between them, the last one beyond the end."""
    places = np.minimum(places, len(rows) - 1)
    below = places.astype(int)
    share = (places - below).astype(np.float32)[:, None]
    return rows[below] * (1 - share) + rows[np.minimum(below + 1, len(rows) - 1)] * share


def noisy(frames: np.ndarray, noise: np.ndarray, generator: np.random.Generator) -> np.ndarray:
    """Frames [n, N_MELS] with a noise, louder or softer, over them: powers add up."""
    start = int(generator.integers(len(noise)))
    added = np.take(noise, start + np.arange(len(frames)), axis=0, mode="wrap").astype(np.float32)
    level = np.quantile(frames.mean(axis=1), 0.95) - generator.uniform(*NOISE_BELOW)
    return np.logaddexp(frames, added - added.mean() + level)


def distorted(frames: np.ndarray, generator: np.random.Generator) -> np.ndarray:
    """Normalised frames [n, N_MELS] with shifted formants, other contrast and colour, blurred, masked in places."""
    bands = np.arange(N_MELS)
    warped = np.ascontiguousarray(at(frames.T, bands * generator.uniform(*WARP)).T) * generator.uniform(*CONTRAST)
    if generator.random() < SMOOTH_SHARE:
        kept = COSINES[: int(generator.integers(*CEPSTRA))]
        warped = warped @ kept.T @ kept
    if generator.random() < BLUR_SHARE:
        window = np.hanning(int(generator.integers(*BLUR)) + 2).astype(np.float32)
        warped = ndimage.convolve1d(warped, window / window.sum(), axis=0, mode="nearest")
    warped += np.interp(bands, np.linspace(0, N_MELS, 5), generator.normal(0, COLOUR, 5)).astype(np.float32)
    if generator.random() < 0.5:
        band = int(generator.integers(N_MELS - 6))
        warped[:, band : band + int(generator.integers(1, 6))] = 0
    if generator.random() < 0.3:
        moment = int(generator.integers(len(frames) - 10))
        warped[moment : moment + int(generator.integers(2, 8))] = 0
    return warped
