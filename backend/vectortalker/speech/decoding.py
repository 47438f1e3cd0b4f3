"""Turns viseme posteriors into blocks: the most probable sequence in which no viseme is shorter than a mouth can be.

A hidden Markov model of one state a viseme and frame of its least duration, decoded by Viterbi's algorithm.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from vectortalker.speech.coarticulation import FPS
from vectortalker.speech.visemes import VISEMES, Block

SWITCH_COST = 1.5  # nats a change of viseme costs; suppresses flicker
LEAST_FRAMES = 2  # 40 ms
CLOSURE_BIAS = 0.3  # nats for PP and FF: a missed closure is seen more than a brief one too many

Posteriors = NDArray[np.float32]  # log, [n, 15]


def decode(log_posteriors: Posteriors) -> list[Block]:
    """Blocks that fill the clip, silence among them. O(n · 15)."""
    classes = viterbi(log_posteriors)
    return blocks_of_classes(classes)


def viterbi(log_posteriors: Posteriors) -> NDArray[np.int64]:
    """Viseme number [n] of each frame on the best path."""
    scores = log_posteriors.astype(np.float64).copy()
    scores[:, [VISEMES.index("PP"), VISEMES.index("FF")]] += CLOSURE_BIAS
    n_frames, n_classes = scores.shape
    if n_frames == 0:
        return np.empty(0, np.int64)
    sums = np.cumsum(np.vstack([np.zeros(n_classes), scores]), axis=0)
    best = np.full((n_frames + 1, n_classes), -np.inf)  # score of paths to frame t that end in a class held long enough
    entered = np.zeros((n_frames + 1, n_classes), np.int64)  # frame at which that class began
    before = np.full((n_frames + 1, n_classes), -1)  # class before it
    for end in range(1, n_frames + 1):
        held = best[end - 1] + scores[end - 1]
        start = end - LEAST_FRAMES
        if end <= LEAST_FRAMES:
            begun, source = (sums[end] if end == min(LEAST_FRAMES, n_frames) else np.full(n_classes, -np.inf)), -1
            start = 0
        else:
            source = int(best[start].argmax())
            begun = best[start, source] - SWITCH_COST + sums[end] - sums[start]
        is_new = begun > held
        best[end] = np.where(is_new, begun, held)
        entered[end] = np.where(is_new, start, entered[end - 1])
        before[end] = np.where(is_new, source, before[end - 1])
    classes = np.empty(n_frames, np.int64)
    end, current = n_frames, int(best[n_frames].argmax())
    while end > 0:
        start = int(entered[end, current])
        classes[start:end] = current
        end, current = start, int(before[end, current])
    return classes


def blocks_of_classes(classes: NDArray[np.int64]) -> list[Block]:
    """Runs of equal viseme numbers as blocks; frame i lasts from (i - 1/2) to (i + 1/2) frames."""
    if len(classes) == 0:
        return []
    cuts = [0, *(np.flatnonzero(np.diff(classes)) + 1).tolist(), len(classes)]
    times = [max(0.0, (cut - 0.5) / FPS) for cut in cuts[:-1]] + [len(classes) / FPS]
    return [
        Block(start, end - start, VISEMES[classes[cut]])
        for cut, start, end in zip(cuts, times, times[1:], strict=False)
    ]
