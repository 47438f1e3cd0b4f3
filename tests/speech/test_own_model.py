"""A net of the user's own from sound to landmarks: a tiny one, made here, opens the mouth where the sound is loud."""

import json
import wave
from pathlib import Path

import numpy as np
import onnx
import onnx.parser
import pytest
from vectortalker.cli.main import main
from vectortalker.errors import VectorTalkerError
from vectortalker.speech import track_by_model
from vectortalker.speech.audio import RATE
from vectortalker.tracks.neutral import neutral_landmarks

HOP = RATE // 50
LOWER_LIP = 66
SECONDS = 2


def loudness_net() -> str:
    """The neutral face, a row for every fiftieth of a second, its lower lip down by how loud that is."""
    face = ", ".join(f"{value:.4f}" for value in 100 * neutral_landmarks().ravel())
    down = ", ".join("100" if index == 2 * LOWER_LIP + 1 else "0" for index in range(136))
    return f"""
<ir_version: 8, opset_import: ["" : 17]>
net (float[1, n] samples) => (float[1, frames, 136] points)
<float[136] face = {{{face}}}, float[136] down = {{{down}}}, int64[1] second = {{1}}>
{{
    sizes = Abs (samples)
    channel = Unsqueeze (sizes, second)
    loudness = AveragePool <kernel_shape = [{HOP}], strides = [{HOP}]> (channel)
    column = Transpose <perm = [0, 2, 1]> (loudness)
    motion = Mul (column, down)
    points = Add (motion, face)
}}"""


TWICE = """
<ir_version: 8, opset_import: ["" : 17]>
net (float[1, n] samples) => (float[1, n] louder) { louder = Add (samples, samples) }"""


def model(text: str, path: Path) -> Path:
    onnx.save(onnx.parser.parse_model(text), path)
    return path


@pytest.fixture
def sound(tmp_path: Path) -> Path:
    """A second of silence and one of a tone, as a WAV file."""
    tone = 0.5 * np.sin(2 * np.pi * 220 * np.arange(RATE) / RATE)
    samples = (np.concatenate([np.zeros(RATE), tone]) * 32767).astype("<i2")
    path = tmp_path / "tone.wav"
    with wave.open(str(path), "wb") as file:
        file.setparams((1, 2, RATE, 0, "NONE", ""))
        file.writeframes(samples.tobytes())
    return path


def test_the_lip_follows_the_net(sound: Path, tmp_path: Path) -> None:
    track = track_by_model(sound, model(loudness_net(), tmp_path / "loud.onnx"), lambda stage, share: None)
    assert track.fps == pytest.approx(50) and track.duration == pytest.approx(SECONDS)
    assert track.landmarks is not None
    lip = np.array(track.landmarks)[:, LOWER_LIP, 1]
    assert np.abs(lip[:45]).max() < 1e-3
    assert lip[55:95].min() > 0.2


def test_the_command_writes_the_track(sound: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    net, output = model(loudness_net(), tmp_path / "loud.onnx"), tmp_path / "track.json"
    assert main(["speech", str(sound), "-o", str(output), "--model", str(net)]) == 0
    assert len(json.loads(output.read_text())["landmarks"]) == 100
    assert main(["speech", str(sound), "-o", str(output), "--model", str(net), "--as", "articulators"]) == 2
    assert "gives landmarks" in capsys.readouterr().err


def test_a_net_of_another_kind_is_refused(sound: Path, tmp_path: Path) -> None:
    with pytest.raises(VectorTalkerError, match=r"it gives \[1, 32000\], not \[1, frames, 136\]") as fault:
        track_by_model(sound, model(TWICE, tmp_path / "twice.onnx"), lambda stage, share: None)
    assert fault.value.code == "bad_option"
