"""Answers the contract's requests about speech."""

from __future__ import annotations

from pathlib import PurePath
from typing import BinaryIO

import numpy as np

from vectortalker.schema import SpeechRequest, SpeechResult, Track, VisemeTrackRequest
from vectortalker.speech.coarticulation import FPS
from vectortalker.speech.landmarks import as_landmarks
from vectortalker.speech.listening import Progress, blocks_heard, blocks_heard_again, listen
from vectortalker.speech.track import check_gains, track_from_blocks
from vectortalker.speech.transcript import words_of
from vectortalker.speech.wire import from_wire, options_of, to_wire

LOUDNESS_DECIMALS = 2  # hundredths of a neper


def answer(request: SpeechRequest, sound: BinaryIO, name: str, progress: Progress) -> SpeechResult:
    """Listen to all or to a part. Raises what `listen`, `blocks_heard_again`, `words_of` and `check_gains` raise."""
    options = options_of(request.options, request.transcript)
    check_gains(options)
    words = words_of(options.transcript, options.language) if options.transcript is not None else None
    listened = listen(sound, progress)
    if request.part is None:
        blocks = blocks_heard(listened.heard, words)
    else:
        known = from_wire(request.visemes or [], listened.duration)
        blocks = blocks_heard_again(listened.heard, words, request.part, known)
    loudness = listened.loudness.round(LOUDNESS_DECIMALS)
    return SpeechResult(
        track=track_from_blocks(blocks, loudness, options, PurePath(name).stem),
        visemes=to_wire(blocks),
        loudness=loudness.tolist(),
        tier="audio" if words is None else "transcript",
    )


def track_of_visemes(request: VisemeTrackRequest) -> Track:
    """The track of edited blocks. Raises `bad_option` for gains of channels that there are not."""
    options = options_of(request.options, None)
    check_gains(options)
    n_frames = max(1, round(request.duration * FPS))
    loudness = np.array((request.loudness or [])[:n_frames] or [0.0], float)
    loudness = np.pad(loudness, (0, n_frames - len(loudness)), mode="edge")
    track = track_from_blocks(from_wire(request.visemes, n_frames / FPS), loudness, options, request.name)
    return as_landmarks(track) if request.kind == "landmarks" else track
