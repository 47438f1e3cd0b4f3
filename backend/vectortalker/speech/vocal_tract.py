"""Fits the mel axis to the speaker: vocal tracts differ in length, and formants with them.

Vocal tract length normalisation (Lee and Rose 1996, "Speaker normalization using efficient frequency warping
procedures"): of a few stretches of the axis, that at which the network is surest of what is said.
"""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import NDArray

from vectortalker.speech.features import FRAMES_PER_SECOND, N_MELS, Frames
from vectortalker.speech.network import hear
from vectortalker.speech.visemes import SILENCE

STRETCHES = (1.0, 0.97, 1.03, 0.94, 1.06, 0.91, 1.09, 0.88, 1.12)  # as far as training distorts
EXCERPT = 30 * FRAMES_PER_SECOND  # frames by which a speaker is told: longer clips take no longer to fit


def fitted(frames: Frames) -> Frames:
    """Normalised frames of one speaker [n, N_MELS] as an average vocal tract would have made them."""
    excerpt = _loudest(frames)
    doubts = {stretch: _doubt(hear(stretched(excerpt, stretch)).log_posteriors) for stretch in STRETCHES}
    return stretched(frames, min(doubts, key=doubts.__getitem__))


def stretched(frames: Frames, stretch: float) -> Frames:
    """Frames whose band i is what was at i · stretch, linear between bands, the last one beyond the end."""
    return frames if stretch == 1.0 else frames @ _stretching(stretch)


def _loudest(frames: Frames) -> Frames:
    """The loudest excerpt, in which somebody speaks if anybody does."""
    excerpts = [frames[start : start + EXCERPT] for start in range(0, max(1, len(frames)), EXCERPT)]
    return max(excerpts, key=lambda excerpt: float(np.exp(excerpt).sum()))


def _doubt(log_posteriors: NDArray[np.float32]) -> float:
    """Mean entropy (nats) of the viseme, given that there is one but silence; frames [n, 15] count by how probably."""
    sounds = np.exp(np.delete(log_posteriors, SILENCE, axis=1)) + 1e-9
    speech = sounds.sum(axis=1, keepdims=True)
    given = sounds / speech
    return float(-(given * np.log(given) * speech).sum() / max(1e-6, speech.sum()))


@cache
def _stretching(stretch: float) -> NDArray[np.float32]:
    """Weights [N_MELS, N_MELS] of the old bands (rows) in the new ones (columns)."""
    places = np.minimum(np.arange(N_MELS) * stretch, N_MELS - 1)
    return np.maximum(0, 1 - np.abs(np.arange(N_MELS)[:, None] - places[None])).astype(np.float32)
