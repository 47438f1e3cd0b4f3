"""Blinks, head and brows: seeded, within their ranges, and quiet where nothing is said."""

from __future__ import annotations

import numpy as np
import pytest
from vectortalker.speech.coarticulation import FPS
from vectortalker.speech.motion import BLINK_INTERVAL, motion

SECONDS = 60
N_FRAMES = round(SECONDS * FPS)
SYLLABLES = 3.0 * np.sin(2 * np.pi * 4 * np.arange(N_FRAMES) / FPS)  # loudness of four a second
SPEAKING = np.zeros(N_FRAMES, bool)


def test_same_seed_same_motion_and_another_seed_another() -> None:
    first, again, other = (motion(SYLLABLES, SPEAKING, seed)["yaw"] for seed in (1, 1, 2))
    np.testing.assert_array_equal(first, again)
    assert np.abs(first - other).max() > 1


def test_blinks_close_fully_and_come_as_often_as_people_blink() -> None:
    blink = motion(SYLLABLES, SPEAKING, seed=3)["blink_left"]
    shut = blink > 0.99
    n_blinks = int((shut[1:] & ~shut[:-1]).sum())
    assert SECONDS / BLINK_INTERVAL[1] - 1 <= n_blinks <= SECONDS / BLINK_INTERVAL[0] + 1
    assert blink.min() == 0


def test_head_begins_and_ends_at_rest() -> None:
    channels = motion(np.zeros(N_FRAMES), ~SPEAKING, seed=0)
    for name in ("yaw", "pitch", "roll"):
        assert channels[name][[0, -1]] == pytest.approx([0, 0])


def test_silence_neither_nods_nor_raises_brows() -> None:
    channels = motion(np.zeros(N_FRAMES), ~SPEAKING, seed=0)
    assert not channels["brow_left"].any()
    louder = motion(SYLLABLES, ~SPEAKING, seed=0)
    np.testing.assert_array_equal(louder["pitch"], channels["pitch"])


def test_loud_syllables_nod() -> None:
    spoken, still = (motion(SYLLABLES, silent, seed=0)["pitch"] for silent in (SPEAKING, ~SPEAKING))
    assert np.corrcoef(spoken - still, SYLLABLES)[0, 1] > 0.7


@pytest.mark.parametrize("n_frames", [1, 2, 7])
def test_shortest_clips_have_all_channels(n_frames: int) -> None:
    channels = motion(np.zeros(n_frames), np.zeros(n_frames, bool), seed=0)
    assert {len(curve) for curve in channels.values()} == {n_frames}
