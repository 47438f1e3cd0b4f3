"""Turns samples into log-mel frames, and frames of one clip into frames that no level or microphone tells apart."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import cache

import numpy as np
from numpy.typing import NDArray

from vectortalker.speech.audio import RATE, Samples

HOP = 160  # samples: 10 ms
WINDOW = 400  # samples: 25 ms, Hann, centred on its frame
N_FFT = 512
N_MELS = 40
MEL_RANGE = (60.0, 7600.0)  # Hz
FRAMES_PER_SECOND = RATE // HOP
FLOOR = 1e-9  # power of a band, 90 dB below a full-scale sine: digital silence

BLOCK = 2048  # frames of one FFT batch: 2 MB
ACTIVE_RANGE = 3.4  # natural log of band power, 15 dB: frames nearer to the clip's peak are its speech
QUIETEST_PEAK = -13.0  # mean log band power of the loudest frames; a quieter clip is not raised to speech level
PRIOR_FRAMES = 100.0  # a second's weight for the average talker's spectrum

Frames = NDArray[np.float32]  # [n, N_MELS]


def log_mels(chunks: Iterable[Samples]) -> Frames:
    """Natural log of mel band power; frame i is centred on i · 10 ms. Ten minutes make 10 MB; no samples are kept."""
    blocks = [_log_mel_block(samples) for samples in _overlapping(chunks)]
    return np.concatenate(blocks) if blocks else np.empty((0, N_MELS), np.float32)


def normalised(frames: Frames) -> Frames:
    """Take the mean spectrum of the clip's speech out, the average talker's counting as one more second of it.

    Frames within 15 dB of the loudest are taken as speech. The mean is that of cepstral mean subtraction with a
    maximum-a-posteriori estimate; a clip without anything loud keeps its low level and so stays silence.
    """
    if len(frames) == 0:
        return frames
    level = frames.mean(axis=1)
    peak = max(float(np.quantile(level, 0.98)), QUIETEST_PEAK)
    active = frames[level > peak - ACTIVE_RANGE]
    prior = np.full(N_MELS, peak - ACTIVE_RANGE / 2, np.float32)
    mean = (active.sum(axis=0) + PRIOR_FRAMES * prior) / (len(active) + PRIOR_FRAMES)
    return (frames - mean).astype(np.float32)


def levels(frames: Frames) -> NDArray[np.float32]:
    """Loudness [n] of log-mel frames: mean natural log of band power below 4 kHz, where voices are."""
    return frames[:, : N_MELS * 3 // 4].mean(axis=1)


def _overlapping(chunks: Iterable[Samples]) -> Iterator[Samples]:
    """Pieces of up to BLOCK frames; each begins where the window of its first frame does."""
    pending = [np.zeros(WINDOW // 2, np.float32)]
    n_pending = WINDOW // 2
    wanted = (BLOCK - 1) * HOP + WINDOW
    for chunk in chunks:
        pending.append(chunk)
        n_pending += len(chunk)
        while n_pending >= wanted:
            samples = np.concatenate(pending)
            yield samples[:wanted]
            pending = [samples[BLOCK * HOP :]]
            n_pending = len(pending[0])
    n_frames = max(0, n_pending - WINDOW // 2) // HOP
    if n_frames:
        tail = np.concatenate([*pending, np.zeros(WINDOW, np.float32)])
        yield tail[: (n_frames - 1) * HOP + WINDOW]


def _log_mel_block(samples: Samples) -> Frames:
    windows = np.lib.stride_tricks.sliding_window_view(samples, WINDOW)[::HOP]
    spectrum = np.fft.rfft(windows * np.hanning(WINDOW).astype(np.float32), N_FFT)
    power = (spectrum.real**2 + spectrum.imag**2).astype(np.float32) / (WINDOW / 4) ** 2
    return np.log(np.maximum(power @ mel_bank().T, FLOOR)).astype(np.float32)


@cache
def mel_bank() -> NDArray[np.float32]:
    """Triangular filters [N_MELS, N_FFT / 2 + 1] on the HTK mel scale, each summing to one."""
    low, high = (2595 * np.log10(1 + hertz / 700) for hertz in MEL_RANGE)
    edges = 700 * (10 ** (np.linspace(low, high, N_MELS + 2) / 2595) - 1)
    hertz = np.fft.rfftfreq(N_FFT, 1 / RATE)
    rising = (hertz - edges[:-2, None]) / np.diff(edges)[:-1, None]
    falling = (edges[2:, None] - hertz) / np.diff(edges)[1:, None]
    bank = np.maximum(0, np.minimum(rising, falling))
    narrow = bank.sum(axis=1) == 0  # a band between two bins of the FFT takes the nearest
    bank[narrow, np.abs(hertz - edges[1:-1, None]).argmin(axis=1)[narrow]] = 1
    return (bank / bank.sum(axis=1, keepdims=True)).astype(np.float32)
