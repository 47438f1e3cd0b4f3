"""Moves the boundaries of aligned visemes to where edges are heard and the usual lengths of visemes agree.

Posteriors change slowly from one sound to the next alike (vowel to r, l or n), and the best path then gives one of
the two a single frame. A log-normal prior on each length, at the clip's own rate of speech, settles such boundaries: a
hidden semi-Markov model (Levinson 1986, "Continuously variable duration hidden Markov models in automatic speech
recognition"), searched around a first path.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from vectortalker.speech.coarticulation import FPS
from vectortalker.speech.visemes import SILENCE, VISEMES

REACH = 10  # frames a boundary may move either way: 200 ms
WEIGHT = 1.0  # of the prior against the posteriors
EDGE_WEIGHT = 2.0  # of edges heard; like WEIGHT set on lines by training voices
# Median length (ms) and deviation of its logarithm in the training corpus, which `scripts/speech/corpus.py` prints.
_LENGTHS = {
    "PP": (76, 0.40), "FF": (72, 0.34), "TH": (49, 0.54), "DD": (66, 0.44), "kk": (76, 0.41), "CH": (97, 0.33),
    "SS": (83, 0.36), "nn": (67, 0.39), "RR": (65, 0.40), "aa": (86, 0.48), "E": (68, 0.51), "I": (68, 0.51),
    "O": (88, 0.45), "U": (73, 0.49), "sil": (0, np.inf),
}  # fmt: skip
DEVIATIONS = np.array([_LENGTHS[name][1] for name in VISEMES])
MEDIANS = np.array([np.log(max(_LENGTHS[name][0], 1) / 1000 * FPS) for name in VISEMES])  # log frames


def settled(
    scores: NDArray[np.float64], edges: NDArray[np.float32], classes: NDArray[np.int64], ends: NDArray[np.int64]
) -> NDArray[np.int64]:
    """Ends [k] of segments of viseme numbers `classes` [k], at least a frame each, in order; the last stays.

    `scores` [n, 15] are log posteriors, `edges` [n] log probabilities of an edge behind a frame. O(k · REACH²).
    """
    sums = np.vstack([np.zeros(len(VISEMES)), np.cumsum(scores, axis=0)])
    candidates = [np.zeros(1, np.int64)]
    candidates += [np.unique(np.clip(end + np.arange(-REACH, REACH + 1), 1, len(scores) - 1)) for end in ends[:-1]]
    candidates += [ends[-1:]]
    rate = _rate(classes, ends)
    best, sources = np.zeros(1), []
    for viseme, starts, stops in zip(classes, candidates, candidates[1:], strict=False):
        lengths = stops[None] - starts[:, None]
        surprise = (np.log(np.maximum(lengths, 1)) - MEDIANS[viseme] - rate) / DEVIATIONS[viseme]
        totals = best[:, None] + (sums[stops, viseme][None] - sums[starts, viseme][:, None]) - WEIGHT / 2 * surprise**2
        totals[lengths < 1] = -np.inf
        totals += EDGE_WEIGHT * edges[stops - 1]
        sources.append(totals.argmax(axis=0))
        best = totals.max(axis=0)
    settled_ends, choice = np.empty(len(classes), np.int64), 0
    for index in range(len(classes) - 1, -1, -1):
        settled_ends[index] = candidates[index + 1][choice]
        choice = sources[index][choice]
    return settled_ends


def _rate(classes: NDArray[np.int64], ends: NDArray[np.int64]) -> float:
    """By how much the logarithm of lengths exceeds the usual: the median of all sounds."""
    is_sound = classes != SILENCE
    if not is_sound.any():
        return 0.0
    lengths = np.diff(ends, prepend=0)
    return float(np.median(np.log(lengths[is_sound]) - MEDIANS[classes[is_sound]]))
