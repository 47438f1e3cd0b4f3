"""Log-mel frames: closed forms, and the same frames however the samples are cut."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from vectortalker.speech.audio import RATE
from vectortalker.speech.features import (
    FLOOR,
    HOP,
    N_FFT,
    N_MELS,
    log_mels,
    mel_bank,
    normalised,
)


def tone(hertz: float, seconds: float, amplitude: float = 1.0) -> np.ndarray:
    return (amplitude * np.sin(2 * np.pi * hertz * np.arange(round(seconds * RATE)) / RATE)).astype(np.float32)


@pytest.mark.parametrize("hertz", [200.0, 1000.0, 5000.0])
def test_tone_is_loudest_in_the_band_of_its_frequency(hertz: float) -> None:
    frames = log_mels([tone(hertz, 0.5)])
    nearest = mel_bank()[:, round(hertz / RATE * N_FFT)].argmax()
    assert np.abs(frames[10:40].argmax(axis=1) - nearest).max() <= 1


def test_ten_times_the_amplitude_adds_the_log_of_a_hundred() -> None:
    quiet, loud = log_mels([tone(1000, 0.2, 0.05)]), log_mels([tone(1000, 0.2, 0.5)])
    assert (loud - quiet).max(axis=1)[3:-3] == pytest.approx(np.log(100), abs=1e-3)


def test_silence_is_the_floor() -> None:
    assert log_mels([np.zeros(RATE, np.float32)]) == pytest.approx(np.log(FLOOR))


@settings(max_examples=20, deadline=None)
@given(st.lists(st.integers(1, 90_000), min_size=1, max_size=5), st.integers(0, 2**32 - 1))
def test_frames_do_not_depend_on_how_samples_are_cut(lengths: list[int], seed: int) -> None:
    samples = np.random.default_rng(seed).standard_normal(sum(lengths)).astype(np.float32)
    pieces = np.split(samples, np.cumsum(lengths)[:-1])
    whole = log_mels([samples])
    assert whole.shape == (len(samples) // HOP, N_MELS)
    np.testing.assert_array_equal(log_mels(pieces), whole)


@pytest.mark.parametrize("gain", [0.1, 4.0])
def test_level_of_a_voice_does_not_matter(gain: float) -> None:
    generator = np.random.default_rng(0)
    voice = (0.2 * generator.standard_normal(2 * RATE)).astype(np.float32)
    np.testing.assert_allclose(
        normalised(log_mels([voice * np.float32(gain)])),
        normalised(log_mels([voice])),
        atol=1e-3,
    )


def test_near_silence_is_not_raised_to_the_level_of_a_voice() -> None:
    generator = np.random.default_rng(0)
    hiss = (1e-4 * generator.standard_normal(2 * RATE)).astype(np.float32)
    voice = (0.2 * generator.standard_normal(2 * RATE)).astype(np.float32)
    assert normalised(log_mels([hiss])).mean() < normalised(log_mels([voice])).mean() - 3


def test_no_samples_make_no_frames() -> None:
    assert normalised(log_mels([])).shape == (0, N_MELS)
