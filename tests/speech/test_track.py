"""From a sound file to a track, through the committed network."""

from __future__ import annotations

import json
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from scipy.io import wavfile
from vectortalker.cli import main
from vectortalker.errors import VectorTalkerError
from vectortalker.schema import N_LANDMARKS, Track
from vectortalker.speech import Options, as_landmarks, network, track_from_audio, transcript
from vectortalker.speech.audio import RATE
from vectortalker.speech.features import N_MELS
from vectortalker.speech.visemes import CHANNELS, VISEMES
from vectortalker.tracks import read_track
from vectortalker.tracks.neutral import neutral_landmarks

TEXT = "My baby may buy a big blue bamboo boat."
CLOSED = 0.02  # inner gap in mouth widths

needs_espeak = pytest.mark.skipif(shutil.which("espeak-ng") is None, reason="espeak-ng is not installed")


def ignore(stage: str, done: float) -> None:
    """Progress that nobody watches."""


def write_wave(path: Path, samples: np.ndarray) -> Path:
    wavfile.write(path, RATE, (32767 * samples).astype(np.int16))
    return path


@pytest.fixture(scope="module")
def spoken(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("speech") / "baby.wav"
    subprocess.run(["espeak-ng", "-v", "en-us", "-s", "150", "-w", str(path), TEXT], check=True)
    return path


def lip_gap(track: Track) -> np.ndarray:
    """Inner gap over mouth width, by frame."""
    points = np.array(as_landmarks(track).landmarks) + neutral_landmarks()
    return np.abs(points[:, 66, 1] - points[:, 62, 1]) / np.linalg.norm(points[:, 54] - points[:, 48], axis=1)


def visemes_in(track: Track) -> list[str]:
    return [block["viseme"] for block in (track.model_extra or {})["visemes"]]


def test_chunks_give_the_same_answer_as_one_run(monkeypatch: pytest.MonkeyPatch) -> None:
    frames = np.random.default_rng(0).normal(0, 3, (900, N_MELS)).astype(np.float32)
    whole = network.hear(frames)
    monkeypatch.setattr(network, "CHUNK", 100)
    chunked = network.hear(frames)
    np.testing.assert_allclose(chunked.log_posteriors, whole.log_posteriors, atol=1e-4)
    np.testing.assert_allclose(chunked.articulators, whole.articulators, atol=1e-4)


def test_network_hears_at_most_440_ms_of_the_future() -> None:
    frames = np.random.default_rng(1).normal(0, 3, (600, N_MELS)).astype(np.float32)
    altered = frames.copy()
    altered[500:] = 0
    known = (500 - 44) // 2  # 440 ms before the change; half a window of 25 ms comes on top
    first, second = network.hear(frames), network.hear(altered)
    np.testing.assert_allclose(first.log_posteriors[:known], second.log_posteriors[:known], atol=1e-5)


def test_posteriors_sum_to_one() -> None:
    heard = network.hear(np.random.default_rng(2).normal(0, 3, (100, N_MELS)).astype(np.float32))
    assert heard.log_posteriors.shape == (50, len(VISEMES))
    assert np.exp(heard.log_posteriors).sum(axis=1) == pytest.approx(1, abs=1e-5)


def test_card_names_the_file_it_describes() -> None:
    card = json.loads(network.MODEL.with_suffix(".json").read_text(encoding="utf-8"))
    assert card["bytes"] == network.MODEL.stat().st_size < 3_000_000


@pytest.mark.parametrize("level", [0.0, 0.01, 0.5])
def test_mouth_stays_closed_without_speech(tmp_path: Path, level: float) -> None:
    generator = np.random.default_rng(7)
    spectrum = np.fft.rfft(generator.standard_normal(5 * RATE))
    pink = np.fft.irfft(spectrum / np.sqrt(np.maximum(np.arange(len(spectrum)), 20)))
    path = write_wave(tmp_path / "quiet.wav", level * pink / np.abs(pink).max())
    assert (lip_gap(track_from_audio(path, Options(), ignore)) < CLOSED).mean() >= 0.98


def test_shorter_than_a_frame_is_refused(tmp_path: Path) -> None:
    path = write_wave(tmp_path / "click.wav", np.ones(100))
    with pytest.raises(VectorTalkerError, match="shorter than 20 ms"):
        track_from_audio(path, Options(), ignore)


def test_gain_of_an_unknown_channel_is_refused(tmp_path: Path) -> None:
    path = write_wave(tmp_path / "quiet.wav", np.zeros(RATE))
    with pytest.raises(VectorTalkerError, match="no channel ears"):
        track_from_audio(path, Options(gains={"ears": 1.0}), ignore)


@needs_espeak
def test_track_lasts_as_long_as_the_sound_and_reads_back(spoken: Path) -> None:
    rate, samples = wavfile.read(spoken)
    track = track_from_audio(spoken, Options(), ignore)
    assert track.duration == pytest.approx(len(samples) / rate, abs=0.03)
    assert set(CHANNELS) < set(track.articulators or {})
    assert read_track(track.model_dump_json(exclude_none=True).encode(), "track.json") == track


@needs_espeak
def test_lips_close_and_open_while_speaking(spoken: Path) -> None:
    gap = lip_gap(track_from_audio(spoken, Options(), ignore))
    closures = np.flatnonzero(np.diff((gap < CLOSED).astype(int)) == 1)
    assert len(closures) >= 5  # of the nine p b m of TEXT
    assert gap.max() > 0.15


@needs_espeak
def test_same_seed_same_track(spoken: Path) -> None:
    assert track_from_audio(spoken, Options(), ignore) == track_from_audio(spoken, Options(), ignore)


@needs_espeak
def test_muted_groups_are_at_rest_and_others_are_not(spoken: Path) -> None:
    channels = track_from_audio(spoken, Options(gains={"head": 0, "brows": 0}), ignore).articulators or {}
    still = {name for name, curve in channels.items() if not any(curve)}
    assert {"yaw", "pitch", "roll", "brow_left", "brow_right"} <= still
    assert "jaw" not in still


@needs_espeak
def test_styles_open_the_mouth_more_and_more(spoken: Path) -> None:
    jaws = [
        np.mean((track_from_audio(spoken, Options(style=style), ignore).articulators or {})["jaw"])
        for style in ("subtle", "normal", "cartoon")
    ]
    assert jaws == sorted(jaws)


@needs_espeak
def test_transcript_gives_its_sounds_in_order(spoken: Path) -> None:
    track = track_from_audio(spoken, Options(transcript=TEXT, language="en-us"), ignore)
    expected = [name for word in transcript.words_of(TEXT, "en-us") for name in word]
    heard = [name for name in visemes_in(track) if name != "sil"]
    joined = [name for name, before in zip(expected, [None, *expected], strict=False) if name != before]
    assert heard == joined


@needs_espeak
@pytest.mark.parametrize(("text", "language"), [("hello", "xx"), ("hello", "en; ls"), ("...", "en"), ("", "en")])
def test_text_that_cannot_be_spoken_is_refused(text: str, language: str) -> None:
    with pytest.raises(VectorTalkerError) as caught:
        transcript.words_of(text, language)
    assert caught.value.code == "bad_option"


def test_transcript_without_espeak_is_refused_by_name(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "")
    with pytest.raises(VectorTalkerError, match="espeak-ng"):
        transcript.words_of("hello", "en")


@pytest.mark.parametrize("kind", ["articulators", "landmarks"])
def test_command_writes_a_track(tmp_path: Path, kind: str) -> None:
    write_wave(tmp_path / "quiet.wav", np.zeros(RATE))
    assert main(["speech", str(tmp_path / "quiet.wav"), "-o", str(tmp_path / "track.json"), "--as", kind]) == 0
    track = read_track((tmp_path / "track.json").read_bytes(), "track.json")
    assert (track.landmarks is None) == (kind == "articulators")
    if track.landmarks is not None:
        assert {len(frame) for frame in track.landmarks} == {N_LANDMARKS}


def test_command_refuses_a_file_that_is_no_sound(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "letter.mp3").write_text("Dear Sir")
    assert main(["speech", str(tmp_path / "letter.mp3"), "-o", str(tmp_path / "track.json")]) == 2
    assert "letter.mp3" in capsys.readouterr().err
    assert not (tmp_path / "track.json").exists()
