"""Turns viseme blocks, or the recording that they are heard in, into a track: a mouth forms them, and a head nods."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from vectortalker.errors import VectorTalkerError
from vectortalker.schema import Track
from vectortalker.speech.coarticulation import FPS, JAW, PRESS, Blend, articulate
from vectortalker.speech.listening import Progress, blocks_heard, listen
from vectortalker.speech.motion import motion
from vectortalker.speech.styles import CHANNEL_GROUPS, STYLES, Options, Style
from vectortalker.speech.transcript import words_of
from vectortalker.speech.visemes import CHANNELS, SILENCE, Block, classes_at
from vectortalker.speech.wire import to_wire

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
    check_gains(options)
    words = words_of(options.transcript, options.language) if options.transcript is not None else None
    listened = listen(path, progress)
    track = track_from_blocks(blocks_heard(listened.heard, words), listened.loudness, options, path.stem)
    progress("done", 1.0)
    return track


def track_from_blocks(blocks: list[Block], loudness: NDArray[np.float64], options: Options, name: str) -> Track:
    """The track of blocks, as heard or as edited; `loudness` [n] in nats at 50 frames a second moves the head."""
    style = STYLES[options.style]
    n_frames = len(loudness)
    curves = _styled(articulate(blocks, n_frames, _smoothed(style, options)), style, options.amplitude)
    is_silent = classes_at(blocks, np.arange(n_frames) / FPS) == SILENCE
    channels = dict(zip(CHANNELS, curves.T, strict=True)) | _scaled(motion(loudness, is_silent, options.seed), style)
    articulators = {
        channel: (curve * _gain(channel, options)).round(DECIMALS).tolist() for channel, curve in channels.items()
    } | {"neutral": [1.0] * n_frames}
    data = {
        "visemes": [block.model_dump() for block in to_wire(blocks)],
        "tier": "audio" if options.transcript is None else "transcript",
    }
    return Track.model_validate(
        {"name": name, "duration": n_frames / FPS, "fps": FPS, "articulators": articulators} | data
    )


def check_gains(options: Options) -> None:
    """Raises `bad_option` for gains of channels that there are not."""
    unknown = [name for name in options.gains if name not in GROUP_OF and name not in CHANNEL_GROUPS]
    if unknown:
        known = ", ".join((*CHANNEL_GROUPS, *GROUP_OF))
        raise VectorTalkerError("bad_option", f"There is no channel {unknown[0]} to set a gain of; known: {known}.")


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


def _gain(channel: str, options: Options) -> float:
    return options.gains.get(GROUP_OF[channel], 1.0) * options.gains.get(channel, 1.0)
