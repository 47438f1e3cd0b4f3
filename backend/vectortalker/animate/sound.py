"""Turns an audio file of any kind into stereo samples at one rate, read as far as a picture has come."""

from __future__ import annotations

import io
from pathlib import Path
from types import TracebackType
from typing import Self

import av
from av.audio.stream import AudioStream
from av.error import FFmpegError

from vectortalker.errors import VectorTalkerError

AAC_RATE = 48000


class AudioReader:
    """Sequential reader of the first audio stream of a file.

    Raises `bad_audio` when the file has no sound that can be decoded.
    """

    def __init__(self, path: Path, rate: int) -> None:
        self._name = path.name
        try:
            self._container = av.open(path)
        except (FFmpegError, OSError) as error:
            raise VectorTalkerError("bad_audio", f"{self._name} cannot be read as audio: {error.strerror}.") from error
        if not self._container.streams.audio:
            self._container.close()
            raise VectorTalkerError("bad_audio", f"{self._name} has no sound.")
        self._frames = self._container.decode(audio=0)
        self._resampler = av.AudioResampler(format="fltp", layout="stereo", rate=rate)
        self._fifo = av.AudioFifo()
        self._ended = False

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._container.close()

    def read(self, n_samples: int) -> av.AudioFrame | None:
        """The next `n_samples` per channel; fewer at the end of the file, None after it."""
        while self._fifo.samples < n_samples and not self._ended:
            self._decode_some()
        return self._fifo.read(n_samples, partial=True) if self._fifo.samples and n_samples else None

    def _decode_some(self) -> None:
        try:
            frame = next(self._frames, None)
        except FFmpegError as error:
            raise VectorTalkerError("bad_audio", f"{self._name} is damaged: {error.strerror}.") from error
        self._ended = frame is None
        for resampled in self._resampler.resample(frame):
            resampled.pts = None
            self._fifo.write(resampled)


def as_m4a(path: Path) -> bytes:
    """The sound of `path` as AAC in MP4, which every browser plays. Raises `bad_audio` as `AudioReader` does."""
    file = io.BytesIO()
    with (
        AudioReader(path, AAC_RATE) as samples,
        av.open(file, "w", format="mp4") as container,
    ):
        stream = container.add_stream("aac", rate=AAC_RATE, layout="stereo")
        assert isinstance(stream, AudioStream)
        n_written = 0
        while (chunk := samples.read(AAC_RATE)) is not None:
            chunk.pts = n_written
            n_written += chunk.samples
            container.mux(stream.encode(chunk))
        container.mux(stream.encode())
    return file.getvalue()
