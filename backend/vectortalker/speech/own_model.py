"""Turns a recording into a landmark track by an audio-to-landmark net of the user's own.

The net's single input is the recording at 16 kHz, f32 [1, n] in −1..1. Its first output holds the 68 landmarks of
every frame, [1, frames, 136], [1, frames, 68, 2] or [1, frames, 68, 3], y down, in any unit; the frames are spread
evenly over the recording. Offsets are from the frame whose lips are nearest to closed, as in tracks of a tracked face.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from vectortalker.models.own import open_own
from vectortalker.schema import N_LANDMARKS, Track
from vectortalker.speech.audio import RATE, mono_chunks
from vectortalker.speech.listening import Progress
from vectortalker.tracks.points_csv import MAX_FPS, Points, track_of_points

KNOWN_SHAPES = f"[1, frames, {2 * N_LANDMARKS}] or [1, frames, {N_LANDMARKS}, 2 or 3]"


def track_by_model(sound: Path, model_file: Path, progress: Progress) -> Track:
    """Raises `bad_audio` as `mono_chunks`, `bad_option` for a file that is no such net, `bad_track` for no face."""
    model = open_own(model_file)
    if len(model.inputs) != 1:
        raise model.refusal("it does not take one recording [1, n]")
    progress("listening", 0.0)
    samples = np.concatenate(list(mono_chunks(sound)))
    answer = model.run({model.inputs[0].name: samples[None].astype(np.float32)})[0]
    points = _points(answer)
    if points is None:
        raise model.refusal(f"it gives {list(answer.shape)}, not {KNOWN_SHAPES}")
    fps = len(points) * RATE / len(samples)
    if fps > MAX_FPS:
        raise model.refusal(f"it gives {fps:g} frames a second; limit: {MAX_FPS:g}")
    progress("done", 1.0)
    return track_of_points(points, fps, sound.stem)


def _points(answer: NDArray[np.float32]) -> Points | None:
    if answer.ndim == 3 and answer.shape[2] == 2 * N_LANDMARKS:
        answer = answer.reshape(*answer.shape[:2], N_LANDMARKS, 2)
    if answer.ndim != 4 or len(answer) != 1 or answer.shape[2] != N_LANDMARKS or answer.shape[3] not in (2, 3):
        return None
    return answer[0, :, :, :2].astype(np.float64)
