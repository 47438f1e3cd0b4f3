"""Turns a recording of speech into a track: visemes heard or aligned, a mouth that forms them, and a head that nods."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from vectortalker.errors import VectorTalkerError
from vectortalker.schema import Track
from vectortalker.speech.alignment import align
from vectortalker.speech.audio import mono_chunks
from vectortalker.speech.coarticulation import FPS, JAW, PRESS, Blend, articulate
from vectortalker.speech.decoding import decode
from vectortalker.speech.features import levels, log_mels, normalised
from vectortalker.speech.motion import motion
from vectortalker.speech.network import Heard, hear
from vectortalker.speech.styles import CHANNEL_GROUPS, STYLES, Options, Style
from vectortalker.speech.transcript import words_of
from vectortalker.speech.visemes import CHANNELS, SILENCE, Block, classes_at

Progress = Callable[[str, float], None]  # told the stage and the done share, 0 to 1; may raise to stop the work

JAW_WEIGHTS = (0.6, 1.4)  # of a block: how far the jaw heard may depart from the viseme's
DECIMALS = 4
GROUP_OF = {
    **dict.fromkeys(CHANNELS, "mouth"),
    **dict.fromkeys(("blink_left", "blink_right"), "blink"),
    **dict.fromkeys(("yaw", "pitch", "roll"), "head"),
    **dict.fromkeys(("brow_left", "brow_right"), "brows"),
}


def track_from_audio(path: Path, options: Options, progress: Progress) -> Track:
    """Articulators at 50 frames a second, and `visemes` beside them: the blocks that an editor shows.

    Raises `bad_audio` for a file that is no sound, empty or over 10 minutes; `bad_option` and `unsupported` for the
    transcript (`transcript.words_of`, `alignment.align`) and for gains of channels that there are not.
    """
    _check_gains(options)
    words = words_of(options.transcript, options.language) if options.transcript is not None else None
    progress("listening", 0.0)
    frames = log_mels(mono_chunks(path))
    heard = hear(normalised(frames), lambda done: progress("listening", 0.8 * done))
    n_frames = len(heard.articulators)
    if n_frames == 0:
        raise VectorTalkerError("bad_audio", f"{path.name} is shorter than 20 ms: nothing can be said in that.")
    progress("forming visemes", 0.8)
    blocks = decode(heard.log_posteriors) if words is None else align(heard.log_posteriors, words)
    blocks = weighted(blocks, heard)
    track = track_from_blocks(blocks, levels(frames)[::2][:n_frames].astype(float), options, path.stem)
    progress("done", 1.0)
    return track


def track_from_blocks(blocks: list[Block], loudness: NDArray[np.float64], options: Options, name: str) -> Track:
    """The track of blocks, as decoded or as edited; `loudness` [n] in nats at 50 frames a second moves the head."""
    style = STYLES[options.style]
    n_frames = len(loudness)
    curves = _styled(articulate(blocks, n_frames, _smoothed(style, options)), style, options.amplitude)
    is_silent = classes_at(blocks, np.arange(n_frames) / FPS) == SILENCE
    channels = dict(zip(CHANNELS, curves.T, strict=True)) | _scaled(motion(loudness, is_silent, options.seed), style)
    articulators = {
        channel: (curve * _gain(channel, options)).round(DECIMALS).tolist() for channel, curve in channels.items()
    } | {"neutral": [1.0] * n_frames}
    data = {
        "visemes": [_wire(block) for block in blocks],
        "tier": "audio" if options.transcript is None else "transcript",
    }
    return Track.model_validate(
        {"name": name, "duration": n_frames / FPS, "fps": FPS, "articulators": articulators} | data
    )


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


def _smoothed(style: Style, options: Options) -> Blend:
    return replace(
        style.blend,
        attack=style.blend.attack * options.smoothing,
        release=style.blend.release * options.smoothing,
    )


def _styled(curves: NDArray[np.float64], style: Style, amplitude: float) -> NDArray[np.float64]:
    """Curves [n, 7] scaled; closures stay closures whatever the style."""
    factors = np.full(len(CHANNELS), style.lips * amplitude)
    factors[JAW] = style.jaw * amplitude
    factors[PRESS] = 1.0
    return np.clip(curves * factors, -1, 1)


def _scaled(channels: dict[str, NDArray[np.float64]], style: Style) -> dict[str, NDArray[np.float64]]:
    factors = {"blink": 1.0, "head": style.head, "brows": style.brows}
    return {name: curve * factors[GROUP_OF[name]] for name, curve in channels.items()}


def _wire(block: Block) -> dict[str, float | str]:
    return {
        "t": round(block.start, 3),
        "d": round(block.duration, 3),
        "viseme": block.viseme,
        "weight": round(block.weight, 2),
    }


def _gain(channel: str, options: Options) -> float:
    return options.gains.get(GROUP_OF[channel], 1.0) * options.gains.get(channel, 1.0)


def _check_gains(options: Options) -> None:
    unknown = [name for name in options.gains if name not in GROUP_OF and name not in CHANNEL_GROUPS]
    if unknown:
        known = ", ".join((*CHANNEL_GROUPS, *GROUP_OF))
        raise VectorTalkerError("bad_option", f"There is no channel {unknown[0]} to set a gain of; known: {known}.")
