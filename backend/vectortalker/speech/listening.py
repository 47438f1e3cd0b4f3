"""Turns a recording into viseme blocks: what the network hears in it, or where the words of a transcript are."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

from vectortalker.errors import VectorTalkerError
from vectortalker.schema import Span
from vectortalker.speech.alignment import align
from vectortalker.speech.audio import mono_chunks
from vectortalker.speech.coarticulation import FPS, JAW, articulate
from vectortalker.speech.decoding import decode
from vectortalker.speech.features import levels, log_mels, normalised
from vectortalker.speech.network import Heard, hear
from vectortalker.speech.styles import STYLES
from vectortalker.speech.visemes import Block, cut
from vectortalker.speech.vocal_tract import fitted

Progress = Callable[[str, float], None]  # told the stage and the done share, 0 to 1; may raise to stop the work

JAW_WEIGHTS = (0.6, 1.4)  # of a block: how far the jaw heard may depart from the viseme's
LISTENING_SHARE = 0.8  # of the work


@dataclass(frozen=True)
class Listened:
    """What the network makes of a recording, and its loudness [n] in nats, both at FPS."""

    heard: Heard
    loudness: NDArray[np.float64]

    @property
    def duration(self) -> float:
        """Seconds."""
        return len(self.loudness) / FPS


def listen(sound: Path | BinaryIO, progress: Progress) -> Listened:
    """Raises `bad_audio` for a file that is no sound, empty, shorter than a frame or over 10 minutes."""
    progress("listening", 0.0)
    frames = log_mels(mono_chunks(sound))
    heard = hear(fitted(normalised(frames)), lambda done: progress("listening", LISTENING_SHARE * done))
    n_frames = len(heard.articulators)
    if n_frames == 0:
        raise VectorTalkerError("bad_audio", "The recording is shorter than 20 ms: nothing can be said in that.")
    progress("forming visemes", LISTENING_SHARE)
    return Listened(heard, levels(frames)[::2][:n_frames].astype(float))


def blocks_heard(heard: Heard, words: list[list[str]] | None) -> list[Block]:
    """Blocks that fill the clip: the most probable, or those of `words`. Raises `bad_option` (`alignment.align`)."""
    sound = heard.log_posteriors, heard.edges
    return weighted(decode(*sound) if words is None else align(*sound, words), heard)


def blocks_heard_again(heard: Heard, words: list[list[str]] | None, part: Span, known: list[Block]) -> list[Block]:
    """`known` blocks with those within `part` heard anew; `words` are those of the part.

    Raises `bad_option` for a part without a frame, and as `blocks_heard` does.
    """
    n_frames = len(heard.articulators)
    first, last = round(part.start * FPS), min(n_frames, round(part.end * FPS))
    if last <= first:
        raise VectorTalkerError(
            "bad_option", f"The part from {part.start:g} s to {part.end:g} s is not within {n_frames / FPS:g} s."
        )
    excerpt = Heard(heard.log_posteriors[first:last], heard.articulators[first:last], heard.edges[first:last])
    anew = [replace(block, start=block.start + first / FPS) for block in blocks_heard(excerpt, words)]
    return cut(known, 0.0, first / FPS) + anew + cut(known, last / FPS, n_frames / FPS)


def weighted(blocks: list[Block], heard: Heard) -> list[Block]:
    """Blocks whose jaw opens as far on average as the network hears it open there."""
    n_frames = len(heard.articulators)
    expected = articulate(blocks, n_frames, STYLES["normal"].blend)[:, JAW]
    return [_weighted(block, heard.articulators[:, JAW], expected) for block in blocks]


def _weighted(block: Block, jaw: NDArray[np.float32], expected: NDArray[np.float64]) -> Block:
    span = slice(round(block.start * FPS), max(round(block.end * FPS), round(block.start * FPS) + 1))
    formed = float(expected[span].mean()) if expected[span].size else 0.0
    if block.viseme in ("sil", "PP", "FF") or formed <= 0:
        return block
    return replace(block, weight=float(np.clip(jaw[span].mean() / formed, *JAW_WEIGHTS)))
