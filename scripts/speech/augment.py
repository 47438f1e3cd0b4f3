"""Turns clean synthetic speech into speech as rooms, microphones, lines and bystanders leave it."""

from __future__ import annotations

import numpy as np
from scipy import fft, signal

SPEEDS = (
    0.82,
    1.22,
)  # pitch, formants and time together, as a tape does: other vocal tracts of the same voice
PAUSES = (0.1, 0.7)  # seconds of silence before and after
SNRS = (3.0, 45.0)  # dB
REVERBERATIONS = (0.08, 0.6)  # seconds to -60 dB
TELEPHONE = (300.0, 3400.0)  # Hz


def spoilt(samples: np.ndarray, rate: int, generator: np.random.Generator) -> np.ndarray:
    """Reverberation, coloration, band limits and noise, each by chance; level random. [n] at `rate`, within -1…1."""
    result = samples
    if generator.random() < 0.45:
        result = _reverberant(result, rate, generator)
    if generator.random() < 0.6:
        result = _coloured(result, rate, generator)
    if generator.random() < 0.25:
        result = _band_limited(result, rate, generator)
    if generator.random() < 0.7:
        result = result + _noise(len(result), generator) * _noise_gain(result, generator)
    peak = float(np.abs(result).max()) or 1.0
    result = result / peak * 10 ** generator.uniform(-1.5, 0)
    if generator.random() < 0.1:
        result = np.clip(result * 3, -0.9, 0.9)
    return result.astype(np.float32)


def sped(samples: np.ndarray, generator: np.random.Generator) -> tuple[np.ndarray, float]:
    """Played faster or slower; the speed by which times are to be divided."""
    n_before = fft.next_fast_len(len(samples))
    n_after = fft.next_fast_len(round(n_before / generator.uniform(*SPEEDS)))
    padded = np.concatenate([samples, np.zeros(n_before - len(samples))])
    return signal.resample(padded, n_after), n_before / n_after


def without_speech(n_samples: int, rate: int, generator: np.random.Generator) -> np.ndarray:
    """Noise, hum, clicks or chords [n]: what a mouth must not move to."""
    kind = generator.integers(4)
    if kind == 0:
        result = _noise(n_samples, generator)
    elif kind == 1:
        result = 0.02 * _noise(n_samples, generator)
        clicks = generator.integers(0, n_samples, 8)
        result[clicks] += generator.uniform(-1, 1, 8)
        result = _reverberant(result, rate, generator)
    elif kind == 2:
        times = np.arange(n_samples) / rate
        hum = sum(np.sin(2 * np.pi * 50 * k * times + generator.uniform(0, 6)) / k for k in range(1, 12))
        result = hum + 0.1 * _noise(n_samples, generator)
    else:
        result = _chords(n_samples, rate, generator)
    return spoilt(result / np.abs(result).max(), rate, generator)


def _noise(n_samples: int, generator: np.random.Generator) -> np.ndarray:
    """Unit power, spectrum falling with f^-k, k from white (0) to brown (2), sometimes swelling."""
    spectrum = np.fft.rfft(generator.standard_normal(n_samples))
    spectrum /= np.maximum(np.arange(len(spectrum)), 20) ** (generator.uniform(0, 2) / 2)
    noise = np.fft.irfft(spectrum, n_samples)
    if generator.random() < 0.3:
        swell = np.interp(
            np.arange(n_samples),
            np.linspace(0, n_samples, 9),
            generator.uniform(0.2, 1, 9),
        )
        noise = noise * swell
    return noise / (noise.std() or 1.0)


def _noise_gain(samples: np.ndarray, generator: np.random.Generator) -> float:
    power = np.abs(samples)
    loud = power[power > 0.1 * power.max()]
    return float(np.sqrt((loud**2).mean())) * 10 ** (-generator.uniform(*SNRS) / 20) if loud.size else 0.0


def _reverberant(samples: np.ndarray, rate: int, generator: np.random.Generator) -> np.ndarray:
    """Exponentially decaying noise as the room, its early sound at time zero so that no label moves."""
    seconds = generator.uniform(*REVERBERATIONS)
    times = np.arange(round(seconds * rate)) / rate
    room = generator.standard_normal(len(times)) * 10 ** (-3 * times / seconds)
    room *= 10 ** (-generator.uniform(3, 15) / 20) / np.sqrt((room**2).sum())
    room[0] += 1
    return signal.fftconvolve(samples, room)[: len(samples)]


def _coloured(samples: np.ndarray, rate: int, generator: np.random.Generator) -> np.ndarray:
    """A smooth random response of ±9 dB between 60 Hz and the top, as microphones have."""
    spectrum = np.fft.rfft(samples)
    hertz = np.fft.rfftfreq(len(samples), 1 / rate)
    knots = np.geomspace(60, rate / 2, 7)
    decibels = np.interp(np.log(np.maximum(hertz, 60)), np.log(knots), generator.uniform(-9, 9, 7))
    return np.fft.irfft(spectrum * 10 ** (decibels / 20), len(samples))


def _band_limited(samples: np.ndarray, rate: int, generator: np.random.Generator) -> np.ndarray:
    """A telephone line, or the low-pass of a lossy codec."""
    if generator.random() < 0.4:
        band = signal.butter(4, TELEPHONE, "bandpass", fs=rate, output="sos")
    else:
        band = signal.butter(
            8,
            min(generator.uniform(3500, 7000), 0.45 * rate),
            "lowpass",
            fs=rate,
            output="sos",
        )
    return np.asarray(signal.sosfilt(band, samples))


def _chords(n_samples: int, rate: int, generator: np.random.Generator) -> np.ndarray:
    """Plucked harmonic notes, a few at a time."""
    result = np.zeros(n_samples)
    for start in np.cumsum(generator.uniform(0.1, 0.6, 40) * rate).astype(int):
        if start >= n_samples:
            break
        times = np.arange(n_samples - start) / rate
        for pitch in 110 * 2 ** (generator.integers(0, 36, 3) / 12):
            for k in range(1, 6):
                result[start:] += np.sin(2 * np.pi * k * pitch * times) * np.exp(-times * (2 + k)) / k
    return result
