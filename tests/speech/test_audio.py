"""Files of every format become the samples that were put in; what is no sound is refused by name."""

from __future__ import annotations

from pathlib import Path

import av
import numpy as np
import pytest
from vectortalker.errors import VectorTalkerError
from vectortalker.speech import audio
from vectortalker.speech.audio import RATE, mono_chunks

TONE_HERTZ = 440.0


def write_tone(path: Path, codec: str, rate: int, layout: str, seconds: float) -> None:
    """A sine of amplitude 0.5 in every channel."""
    with av.open(path, "w") as container:
        stream = container.add_stream(codec, rate=rate, layout=layout)
        wave = 0.5 * np.sin(2 * np.pi * TONE_HERTZ * np.arange(round(seconds * rate)) / rate)
        n_channels = 2 if layout == "stereo" else 1
        samples = np.repeat((wave * 32767).astype(np.int16), n_channels)[None]
        frame = av.AudioFrame.from_ndarray(samples, format="s16", layout=layout)
        frame.rate = rate
        resampler = av.AudioResampler(
            stream.format,
            layout,
            rate,
            frame_size=stream.codec_context.frame_size or 1024,
        )
        for piece in [*resampler.resample(frame), *resampler.resample(None)]:
            container.mux(stream.encode(piece))
        container.mux(stream.encode(None))


@pytest.mark.parametrize(
    ("name", "codec", "rate", "layout"),
    [
        ("a.wav", "pcm_s24le", 48000, "stereo"),
        ("b.wav", "pcm_s16le", 8000, "mono"),
        ("c.mp3", "libmp3lame", 44100, "stereo"),
        ("d.ogg", "libopus", 48000, "stereo"),
        ("e.flac", "flac", 96000, "mono"),
        ("f.m4a", "aac", 44100, "stereo"),
        ("g.webm", "libopus", 48000, "mono"),
    ],
)
def test_tone_keeps_its_pitch_and_length(tmp_path: Path, name: str, codec: str, rate: int, layout: str) -> None:
    write_tone(tmp_path / name, codec, rate, layout, seconds=1.0)
    samples = np.concatenate(list(mono_chunks(tmp_path / name)))
    assert len(samples) == pytest.approx(RATE, abs=0.1 * RATE)  # lossy codecs pad by a frame or two
    middle = samples[RATE // 4 : RATE // 4 + RATE // 2]  # half a second: bins of 2 Hz
    peak = np.abs(np.fft.rfft(middle * np.hanning(len(middle)))).argmax() * 2
    assert peak == pytest.approx(TONE_HERTZ, abs=4)


@pytest.mark.parametrize("content", [b"", b"no sound at all " * 100])
def test_what_is_no_sound_is_refused_by_name(tmp_path: Path, content: bytes) -> None:
    (tmp_path / "letter.wav").write_bytes(content)
    with pytest.raises(VectorTalkerError, match=r"letter\.wav") as caught:
        list(mono_chunks(tmp_path / "letter.wav"))
    assert caught.value.code == "bad_audio"


def test_missing_file_is_refused(tmp_path: Path) -> None:
    with pytest.raises(VectorTalkerError, match=r"gone\.wav"):
        list(mono_chunks(tmp_path / "gone.wav"))


def test_picture_without_sound_is_refused(tmp_path: Path) -> None:
    with av.open(tmp_path / "mute.mp4", "w") as container:
        stream = container.add_stream("mpeg4", rate=10)
        stream.width, stream.height, stream.pix_fmt = 16, 16, "yuv420p"
        picture = av.VideoFrame.from_ndarray(np.zeros((16, 16, 3), np.uint8), format="rgb24")
        container.mux(stream.encode(picture))
        container.mux(stream.encode(None))
    with pytest.raises(VectorTalkerError, match="no sound"):
        list(mono_chunks(tmp_path / "mute.mp4"))


def test_too_long_is_refused_before_all_is_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write_tone(tmp_path / "long.wav", "pcm_s16le", 8000, "mono", seconds=130)
    monkeypatch.setattr(audio, "MAX_SECONDS", 60)
    taken = []
    with pytest.raises(VectorTalkerError, match="longer than 1 minutes"):
        taken.extend(mono_chunks(tmp_path / "long.wav"))
    assert sum(map(len, taken)) <= 60 * RATE


def test_chunks_stay_small_however_long_the_file(tmp_path: Path) -> None:
    write_tone(tmp_path / "minute.wav", "pcm_s16le", 16000, "mono", seconds=60)
    assert max(map(len, mono_chunks(tmp_path / "minute.wav"))) < RATE
