"""Posteriors become blocks: Viterbi against exhaustive search, forced alignment against known paths."""

from __future__ import annotations

from itertools import pairwise, product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from vectortalker.errors import VectorTalkerError
from vectortalker.speech.alignment import align
from vectortalker.speech.coarticulation import FPS
from vectortalker.speech.decoding import (
    CLOSURE_BIAS,
    EDGE_WEIGHT,
    blocks_of_classes,
    decode,
    viterbi,
)
from vectortalker.speech.visemes import VISEMES

LIVE = 3  # visemes that the exhaustive search tries; all others are impossible


def log_posteriors(weights: np.ndarray) -> np.ndarray:
    return np.log(weights / weights.sum(axis=1, keepdims=True)).astype(np.float32)


def sure_of(names: list[str], confidence: float = 0.9) -> np.ndarray:
    """Log posteriors [n, 15] with `confidence` in each frame's viseme."""
    weights = np.full((len(names), len(VISEMES)), (1 - confidence) / (len(VISEMES) - 1))
    weights[np.arange(len(names)), [VISEMES.index(name) for name in names]] = confidence
    return log_posteriors(weights)


def edges_behind(n_frames: int, *frames: int) -> np.ndarray:
    """Log probabilities [n_frames] of an edge: 0.98 behind `frames`, 0.02 elsewhere."""
    chances = np.full(n_frames, 0.02)
    chances[list(frames)] = 0.98
    return np.log(chances).astype(np.float32)


def edges_of(names: list[str]) -> np.ndarray:
    """Edges wherever a name differs from the next."""
    changes = [index for index, pair in enumerate(pairwise(names)) if pair[0] != pair[1]]
    return edges_behind(len(names), *changes)


def score_of(path: np.ndarray, scores: np.ndarray, edges: np.ndarray) -> float:
    is_change = np.diff(path) != 0
    return float(scores[np.arange(len(path)), path].sum() + EDGE_WEIGHT * edges[:-1][is_change].sum(dtype=float))


@settings(max_examples=30, deadline=None)
@given(st.integers(2, 7), st.integers(0, 2**32 - 1))
def test_path_scores_as_well_as_the_best_of_all(n_frames: int, seed: int) -> None:
    logs = np.full((n_frames, len(VISEMES)), -50.0, np.float32)
    logs[:, :LIVE] = np.random.default_rng(seed).normal(0, 3, (n_frames, LIVE))
    scores = logs.astype(float)
    scores[:, 1:LIVE] += CLOSURE_BIAS  # the live visemes are sil, PP, FF
    edges = np.random.default_rng(seed + 1).uniform(-4, 0, n_frames).astype(np.float32)
    best = max(score_of(np.array(path), scores, edges) for path in product(range(LIVE), repeat=n_frames))
    assert score_of(viterbi(logs, edges), scores, edges) == pytest.approx(best, abs=1e-6)


def test_one_doubtful_frame_does_not_flicker() -> None:
    names = ["aa"] * 10 + ["kk"] + ["aa"] * 10
    assert [block.viseme for block in decode(sure_of(names, 0.3), edges_behind(21))] == ["aa"]


def test_doubtful_sound_between_two_edges_is_heard() -> None:
    names = ["aa"] * 10 + ["kk"] * 2 + ["aa"] * 10
    assert [block.viseme for block in decode(sure_of(names, 0.3), edges_of(names))] == ["aa", "kk", "aa"]


@given(st.lists(st.integers(0, len(VISEMES) - 1), max_size=30))
def test_blocks_fill_the_clip_without_gaps(classes: list[int]) -> None:
    blocks = blocks_of_classes(np.array(classes, int))
    ends = [0.0, *(block.end for block in blocks)]
    assert ends[-1] == pytest.approx(len(classes) / FPS)
    assert [block.start for block in blocks] == pytest.approx(ends[:-1])


def test_single_frame_is_one_block() -> None:
    assert [block.viseme for block in decode(sure_of(["O"]), edges_behind(1))] == ["O"]


def test_alignment_finds_where_each_sound_is() -> None:
    spoken = ["sil"] * 10 + ["PP"] * 5 + ["aa"] * 12 + ["nn"] * 6 + ["sil"] * 8 + ["I"] * 9
    blocks = align(sure_of(spoken, 0.6), edges_of(spoken), [["PP", "aa", "nn"], ["I"]])
    assert [block.viseme for block in blocks] == ["sil", "PP", "aa", "nn", "sil", "I"]
    assert [round(block.start * FPS + 0.5) for block in blocks][1:] == [
        10,
        15,
        27,
        33,
        41,
    ]


def test_words_without_a_pause_between_them_join() -> None:
    spoken = ["PP"] * 5 + ["aa"] * 5 + ["I"] * 5
    blocks = align(sure_of(spoken), edges_of(spoken), [["PP", "aa"], ["I"]])
    assert [block.viseme for block in blocks] == ["PP", "aa", "I"]


def test_a_sound_that_is_not_heard_gets_its_place_all_the_same() -> None:
    spoken = ["aa"] * 20 + ["sil"] * 5
    assert "PP" in [block.viseme for block in align(sure_of(spoken), edges_of(spoken), [["aa", "PP"]])]


def between_s() -> np.ndarray:
    """Log posteriors of s, then ten frames of which nothing tells E from r, then s."""
    weights = np.full((30, len(VISEMES)), 1e-3)
    weights[:10, VISEMES.index("SS")] = weights[20:, VISEMES.index("SS")] = 1.0
    weights[10:20, [VISEMES.index("E"), VISEMES.index("RR")]] = 0.5
    return log_posteriors(weights)


def test_boundary_that_cannot_be_heard_gives_both_sounds_their_usual_length() -> None:
    blocks = align(between_s(), edges_behind(30, 9, 19), [["SS", "E", "RR", "SS"]])
    lengths = {block.viseme: round(block.duration * FPS) for block in blocks[1:3]}
    assert lengths == {"E": 5, "RR": 5}  # medians 68 and 65 ms


def test_boundary_lies_where_an_edge_is_heard() -> None:
    blocks = align(between_s(), edges_behind(30, 9, 12, 19), [["SS", "E", "RR", "SS"]])
    lengths = {block.viseme: round(block.duration * FPS) for block in blocks[1:3]}
    assert lengths == {"E": 3, "RR": 7}


def test_more_sounds_than_frames_are_refused() -> None:
    with pytest.raises(VectorTalkerError, match=r"too many for 0\.1 s"):
        align(sure_of(["aa"] * 5), edges_behind(5), [["aa", "PP"] * 10])


def test_text_of_another_recording_is_refused() -> None:
    spoken = ["SS"] * 50 + ["O"] * 50
    with pytest.raises(VectorTalkerError, match="does not fit"):
        align(sure_of(spoken, 0.99), edges_of(spoken), [["PP", "I", "FF"]])
