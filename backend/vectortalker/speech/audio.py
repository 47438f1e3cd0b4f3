"""Turns an audio file of any kind into mono samples at 16 kHz, in chunks of constant memory."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO

import av
import numpy as np
from av.container import InputContainer
from av.error import FFmpegError
from numpy.typing import NDArray

from vectortalker.errors import VectorTalkerError

RATE = 16_000  # Hz; speech has little above 8 kHz that lips show
MAX_SECONDS = 600

Samples = NDArray[np.float32]  # [n], within -1…1


def mono_chunks(sound: Path | BinaryIO) -> Iterator[Samples]:
    """Samples of the first audio stream of a file, a packet's worth at a time: memory does not grow with the length.

    Raises `bad_audio`: not there, not decodable, without sound, damaged before its end, empty, or over 10 minutes.
    """
    name = sound.name if isinstance(sound, Path) else "The recording"
    try:
        with av.open(sound, "r") as container:
            if not container.streams.audio:
                raise _bad(f"{name} has no sound.")
            n_samples = 0
            for chunk in _resampled(container):
                n_samples += len(chunk)
                if n_samples > MAX_SECONDS * RATE:
                    raise _bad(f"{name} is longer than {MAX_SECONDS // 60} minutes, the limit: cut it.")
                yield chunk
    except (FFmpegError, OSError) as error:
        raise _bad(f"{name} cannot be read as audio: {error.strerror}.") from error
    if n_samples == 0:
        raise _bad(f"{name} has a sound stream without a single sample.")


def _resampled(container: InputContainer) -> Iterator[Samples]:
    resampler = av.AudioResampler(format="flt", layout="mono", rate=RATE)
    for frame in container.decode(audio=0):
        frame.pts = None  # gaps in the time stamps of a stream would become silence of any length
        for resampled in resampler.resample(frame):
            yield resampled.to_ndarray()[0]
    for resampled in resampler.resample(None):
        yield resampled.to_ndarray()[0]


def _bad(message: str) -> VectorTalkerError:
    return VectorTalkerError("bad_audio", message)
