"""Turns a stream of frames, and sound if there is any, into one MP4 or WebM file, by PyAV."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

import av
from av.audio.stream import AudioStream
from av.container import OutputContainer
from av.video.stream import VideoStream

from vectortalker.animate.frames import Rgba
from vectortalker.animate.sound import AudioReader

FPS_LIMIT = 65535  # denominators of the frame rate stay below it
BT709 = 1  # code of its primaries, transfer function and matrix alike in H.273


@dataclass(frozen=True)
class Codecs:
    """Encoders of a container and their options."""

    video: str
    video_options: dict[str, str]
    audio: str
    audio_rate: int
    container_options: dict[str, str]


CODECS = {
    "mp4": Codecs("libx264", {"crf": "18", "preset": "veryfast"}, "aac", 48000, {"movflags": "+faststart"}),
    "webm": Codecs(
        "libvpx-vp9",
        {"crf": "24", "b": "0", "deadline": "realtime", "cpu-used": "6", "row-mt": "1"},
        "libopus",
        48000,
        {},
    ),
}


def write_video(
    frames: Iterable[Rgba], path: Path, fps: float, size: tuple[int, int], kind: str, audio: Path | None = None
) -> None:
    """Encode `frames` of `size` (width, height; even) at `fps` as `kind` ("mp4", "webm") with the sound of `audio`.

    The sound is cut where the picture ends. Raises `bad_audio` when `audio` has no sound that can be read.
    """
    codecs = CODECS[kind]
    rate = Fraction(fps).limit_denominator(FPS_LIMIT)
    with av.open(path, "w", format=kind, options=codecs.container_options) as container:
        video = _video_stream(container, codecs, rate, size)
        if audio is None:
            _encode_silently(container, video, frames)
        else:
            sound = container.add_stream(codecs.audio, rate=codecs.audio_rate, layout="stereo")
            assert isinstance(sound, AudioStream), codecs.audio
            with AudioReader(audio, codecs.audio_rate) as samples:
                _encode_with_sound(container, video, sound, frames, samples)


def _video_stream(container: OutputContainer, codecs: Codecs, rate: Fraction, size: tuple[int, int]) -> VideoStream:
    stream = container.add_stream(codecs.video, rate=rate, options=codecs.video_options)
    assert isinstance(stream, VideoStream), codecs.video
    stream.width, stream.height = size
    stream.pix_fmt = "yuv420p"
    context = stream.codec_context
    context.time_base = 1 / rate
    context.colorspace = context.color_primaries = context.color_trc = BT709
    return stream


def _encode_silently(container: OutputContainer, video: VideoStream, frames: Iterable[Rgba]) -> None:
    for index, frame in enumerate(frames):
        container.mux(video.encode(_video_frame(frame, index)))
    container.mux(video.encode())


def _encode_with_sound(
    container: OutputContainer, video: VideoStream, sound: AudioStream, frames: Iterable[Rgba], samples: AudioReader
) -> None:
    """Interleaved: the sound is written as far as the picture has come, so that players need not seek."""
    rate = video.codec_context.framerate
    n_written = 0
    for index, frame in enumerate(frames):
        container.mux(video.encode(_video_frame(frame, index)))
        n_due = int((index + 1) / rate * sound.codec_context.sample_rate)
        if (chunk := samples.read(n_due - n_written)) is not None:
            chunk.pts = n_written
            n_written += chunk.samples
            container.mux(sound.encode(chunk))
    container.mux(video.encode())
    container.mux(sound.encode())


def _video_frame(pixels: Rgba, index: int) -> av.VideoFrame:
    frame = av.VideoFrame.from_ndarray(pixels, format="rgba")
    frame = frame.reformat(format="yuv420p", dst_colorspace="ITU709")
    frame.pts = index
    return frame
