"""Turns viseme posteriors and the visemes of a known text into blocks: forced alignment by dynamic programming."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from vectortalker.errors import VectorTalkerError
from vectortalker.speech.coarticulation import FPS
from vectortalker.speech.decoding import Edges, Posteriors, blocks_of_classes
from vectortalker.speech.durations import settled
from vectortalker.speech.visemes import SILENCE, VISEMES, Block

MAX_CELLS = 200_000_000  # of the table of steps, a byte each: 10 minutes of speech have 180 million
FLOOR = -6.0  # nats: one frame in which the network is sure of something else does not rule an alignment out
SILENT_FLOOR = -12.0  # nats: a voice is not a pause, even where it says something else
LEAST_FIT = -1.8  # mean nats a frame: right texts score -0.6 as a rule and all above -1.65; 1 in 8 wrong ones passes
STAY, STEP, SKIP = 0, 1, 2


def align(log_posteriors: Posteriors, edges: Edges, words: list[list[str]]) -> list[Block]:
    """Blocks of the visemes of `words` in order, with pauses between words where they are heard.

    Raises `bad_option` when the text has more sounds than the recording has frames, or does not fit what is heard.
    """
    states, is_optional = _states(words)
    n_frames = len(log_posteriors)
    if len(states) > n_frames + int(is_optional.sum()) or len(states) * n_frames > MAX_CELLS:
        seconds = n_frames / FPS
        raise VectorTalkerError(
            "bad_option",
            f"The transcript has {len(states)} sounds, too many for {seconds:.1f} s: cut it to what is said.",
        )
    scores = np.maximum(log_posteriors, np.where(np.arange(len(VISEMES)) == SILENCE, SILENT_FLOOR, FLOOR))
    path, total = _best_path(scores[:, states], is_optional)
    fit = total / max(1, n_frames)
    if fit < LEAST_FIT:
        figures = f"fit {fit:.2f}, at least {LEAST_FIT} is needed"
        raise VectorTalkerError(
            "bad_option", f"The transcript does not fit the recording ({figures}): check text and language."
        )
    return blocks_of_states(scores, edges, path, states)


def _states(words: list[list[str]]) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
    """Viseme numbers in order, an optional silence before, between and after the words."""
    numbers, is_optional = [SILENCE], [True]
    for word in words:
        numbers += [VISEMES.index(name) for name in word] + [SILENCE]
        is_optional += [False] * len(word) + [True]
    return np.array(numbers), np.array(is_optional)


def _best_path(scores: NDArray[np.float32], is_optional: NDArray[np.bool_]) -> tuple[NDArray[np.int64], float]:
    """State [n_frames] of each frame, never falling, and its total score. Only optional states may be left out."""
    n_frames, n_states = scores.shape
    steps = np.zeros((n_frames, n_states), np.uint8)
    best = np.full(n_states, -np.inf)
    best[0] = scores[0, 0]
    best[1:2] = scores[0, 1:2]  # the first pause may be left out
    for frame in range(1, n_frames):
        options = np.full((3, n_states), -np.inf)
        options[STAY] = best
        options[STEP, 1:] = best[:-1]
        options[SKIP, 2:] = np.where(is_optional[1:-1], best[:-2], -np.inf)
        steps[frame] = options.argmax(axis=0)
        best = options.max(axis=0) + scores[frame]
    state = n_states - 1 if n_states < 2 or best[-1] >= best[-2] else n_states - 2
    total = float(best[state])
    path = np.empty(n_frames, np.int64)
    for frame in range(n_frames - 1, -1, -1):
        path[frame] = state
        state -= int(steps[frame, state])
    return path, total


def blocks_of_states(
    scores: NDArray[np.float32], edges: Edges, path: NDArray[np.int64], states: NDArray[np.int64]
) -> list[Block]:
    """Blocks of the visemes of `states` along `path`, settled by `scores` [n, 15], `edges` and usual lengths."""
    starts = np.concatenate([[0], np.flatnonzero(np.diff(path)) + 1])
    classes = states[path[starts]]
    ends = settled(scores.astype(np.float64), edges, classes, np.append(starts[1:], len(path)))
    return blocks_of_classes(np.repeat(classes, np.diff(ends, prepend=0)))
