"""Turns loudness over time into blinks, head motion and brows: what a talker does besides forming sounds.

Heads nod with stressed syllables and drift between phrases; people blink every few seconds, more at pauses. Loudness
stands for stress here. All is drawn from one seed.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter1d

from vectortalker.speech.coarticulation import FPS

Curve = NDArray[np.float64]  # [n] at FPS

BLINK_INTERVAL = (2.0, 6.0)  # seconds between blinks; adults in conversation blink 15 to 20 times a minute
BLINK_CLOSING, BLINK_SHUT, BLINK_OPENING = 0.07, 0.04, 0.13  # seconds
PAUSE_REACH = 0.5  # seconds around a due blink within which a pause attracts it

SYLLABLE, PHRASE = 0.08, 0.5  # seconds, widths of the smoothing that leaves stress and phrase
NOD_DEGREES, DRIFT_DEGREES = 2.2, (2.5, 1.2, 1.5)  # stress on pitch; yaw, pitch, roll
DRIFT_SECONDS = 1.2  # width of the smoothing of drift
BROW_RAISE = 0.3


def motion(loudness: Curve, is_silent: NDArray[np.bool_], seed: int) -> dict[str, Curve]:
    """Channels by name, for loudness (nats) at FPS. Without speech the face blinks and drifts, but does not nod."""
    generator = np.random.default_rng(seed)
    stress = _stress(loudness, is_silent)
    blink = _blinks(is_silent, generator)
    yaw, pitch, roll = (degrees * _drift(len(loudness), generator) for degrees in DRIFT_DEGREES)
    phrases = gaussian_filter1d(stress, PHRASE * FPS) if len(stress) else stress
    brows = BROW_RAISE * np.clip(1.5 * phrases + 0.4 * stress, 0, 1.5)
    return {
        "blink_left": blink,
        "blink_right": blink,
        "brow_left": brows,
        "brow_right": brows,
        "yaw": yaw,
        "pitch": pitch + NOD_DEGREES * stress,
        "roll": roll,
    }


def _stress(loudness: Curve, is_silent: NDArray[np.bool_]) -> Curve:
    """About 0…1: how much louder a syllable is than its phrase; 0 in silence."""
    if is_silent.all():
        return np.zeros(len(loudness))
    floor = float(loudness[~is_silent].mean()) - 2.0
    voiced = np.where(is_silent, floor, np.maximum(loudness, floor))
    swell = gaussian_filter1d(voiced, SYLLABLE * FPS) - gaussian_filter1d(voiced, PHRASE * FPS)
    speaking = gaussian_filter1d((~is_silent).astype(float), SYLLABLE * FPS)
    return np.clip(swell, 0, 1.5) * speaking


def _drift(n_frames: int, generator: np.random.Generator) -> Curve:
    """Smooth noise of unit deviation that starts and ends at 0, the rest pose."""
    if n_frames == 0:
        return np.zeros(0)
    margin = round(4 * DRIFT_SECONDS * FPS)
    noise = gaussian_filter1d(generator.standard_normal(n_frames + 2 * margin), DRIFT_SECONDS * FPS)[margin:-margin]
    unit = np.sqrt(2 * np.sqrt(np.pi) * DRIFT_SECONDS * FPS)  # undoes what the smoothing took
    ends = np.minimum(np.arange(n_frames), np.arange(n_frames)[::-1]) / FPS / DRIFT_SECONDS
    return noise * unit * np.clip(ends, 0, 1)


def _blinks(is_silent: NDArray[np.bool_], generator: np.random.Generator) -> Curve:
    curve = np.zeros(len(is_silent))
    duration = len(is_silent) / FPS
    due = float(generator.uniform(*BLINK_INTERVAL))
    while due < duration:
        start = _nearest_pause(due, is_silent)
        times = np.arange(len(curve)) / FPS - start
        closing = np.clip(times / BLINK_CLOSING, 0, 1)
        opening = np.clip((times - BLINK_CLOSING - BLINK_SHUT) / BLINK_OPENING, 0, 1)
        curve = np.maximum(curve, closing * closing * (3 - 2 * closing) - opening * opening * (3 - 2 * opening))
        due = start + float(generator.uniform(*BLINK_INTERVAL))
    return curve


def _nearest_pause(due: float, is_silent: NDArray[np.bool_]) -> float:
    """Start of the pause nearest to `due` within PAUSE_REACH, else `due`."""
    starts = np.flatnonzero(is_silent[1:] & ~is_silent[:-1]) / FPS
    near = starts[np.abs(starts - due) <= PAUSE_REACH]
    return float(near[np.abs(near - due).argmin()]) if len(near) else due
