"""Fitting the mel axis: exact where a stretch is known, and chosen by how sure the network is."""

from __future__ import annotations

import numpy as np
import pytest
from vectortalker.speech import vocal_tract
from vectortalker.speech.features import N_MELS
from vectortalker.speech.network import Heard
from vectortalker.speech.visemes import CHANNELS, VISEMES


def ramp(n_frames: int) -> np.ndarray:
    """Frames whose band i is at i: what a stretch moves can be read off."""
    return np.tile(np.arange(N_MELS, dtype=np.float32), (n_frames, 1))


@pytest.mark.parametrize("stretch", vocal_tract.STRETCHES)
def test_band_is_what_was_at_its_place_times_the_stretch(stretch: float) -> None:
    expected = np.minimum(np.arange(N_MELS) * stretch, N_MELS - 1)
    assert vocal_tract.stretched(ramp(3), stretch)[1] == pytest.approx(expected, abs=1e-4)


def test_stretch_of_least_doubt_is_taken_where_somebody_speaks(monkeypatch: pytest.MonkeyPatch) -> None:
    def hear(frames: np.ndarray) -> Heard:
        """Sure of a vowel as band 20 is near 20 · 1.06; sure of silence, which says nothing, at 0.88."""
        away = abs(float(frames[0, 20]) - 20 * 1.06)
        is_silent = frames[0, 20] < 20 * 0.9
        logits = np.zeros((len(frames) // 2, len(VISEMES)))
        logits[:, 0 if is_silent else 10] = 9 if is_silent else 8 - away
        log_posteriors = logits - np.log(np.exp(logits).sum(axis=1, keepdims=True))
        articulators = np.zeros((len(logits), len(CHANNELS)), np.float32)
        return Heard(log_posteriors.astype(np.float32), articulators, np.zeros(len(logits), np.float32))

    monkeypatch.setattr(vocal_tract, "hear", hear)
    assert vocal_tract.fitted(ramp(8))[0, 20] == pytest.approx(20 * 1.06)


def test_speaker_is_told_by_the_loudest_excerpt(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(vocal_tract, "EXCERPT", 10)
    frames = np.repeat(np.array([-9.0, 2.0, -9.0]), 10)[:, None] * np.ones(N_MELS)
    np.testing.assert_array_equal(vocal_tract._loudest(frames), frames[10:20])


def test_clip_without_frames_stays_empty() -> None:
    assert vocal_tract.fitted(np.empty((0, N_MELS), np.float32)).shape == (0, N_MELS)
