"""Turns viseme posteriors into blocks: the most probable sequence, a change of viseme having its price.

A hidden Markov model of one state a viseme, decoded by Viterbi's algorithm; a change is cheap where the network hears
the edge of a sound. Least or usual durations, and frequencies of pairs, do not make it more accurate: the network sees
the neighbours that they tell of.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from vectortalker.speech.coarticulation import FPS
from vectortalker.speech.visemes import VISEMES, Block

# Share of the improbability of an edge, in nats, that a change of viseme costs there: set on lines by training voices
# (part `tuning` of the corpus).
EDGE_WEIGHT = 0.5
CLOSURE_BIAS = 0.3  # nats for PP and FF: a missed closure is seen more than a brief one too many

_IS_CHANGE = 1 - np.eye(len(VISEMES))
Posteriors = NDArray[np.float32]  # log, [n, 15]
Edges = NDArray[np.float32]  # [n], log probability that a sound ends between a frame and the next


def decode(log_posteriors: Posteriors, edges: Edges) -> list[Block]:
    """Blocks that fill the clip, silence among them. O(n · 15²)."""
    return blocks_of_classes(viterbi(log_posteriors, edges))


def viterbi(log_posteriors: Posteriors, edges: Edges) -> NDArray[np.int64]:
    """Viseme number [n] of each frame on the best path."""
    scores = log_posteriors.astype(np.float64).copy()
    scores[:, [VISEMES.index("PP"), VISEMES.index("FF")]] += CLOSURE_BIAS
    n_frames, n_classes = scores.shape
    sources = np.zeros((n_frames, n_classes), np.int64)  # viseme of the frame before, on the best path to each
    best = scores[0] if n_frames else np.zeros(n_classes)
    for frame in range(1, n_frames):
        ways = best[:, None] + EDGE_WEIGHT * float(edges[frame - 1]) * _IS_CHANGE
        sources[frame] = ways.argmax(axis=0)
        best = ways.max(axis=0) + scores[frame]
    classes = np.empty(n_frames, np.int64)
    current = int(best.argmax())
    for frame in range(n_frames - 1, -1, -1):
        classes[frame] = current
        current = int(sources[frame, current])
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
