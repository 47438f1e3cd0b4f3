"""Files of every kind, read back by other means than those that wrote them."""

from __future__ import annotations

import wave
from itertools import pairwise
from pathlib import Path
from xml.etree import ElementTree

import av
import numpy as np
import pytest
from PIL import Image
from vectortalker.animate import Options, animate
from vectortalker.errors import VectorTalkerError
from vectortalker.schema import Project

from tests.animate.scenes import HEIGHT, WIDTH, project, track

SMALL = Options(fps=10, size=96)
N_FRAMES = 10  # one second of them
SVG = "{http://www.w3.org/2000/svg}"


def write(
    out: Path,
    options: Options = SMALL,
    portrait: Project | None = None,
    audio: Path | None = None,
) -> Path:
    animate(portrait or project(), track(), out, options, lambda share: None, audio)
    return out


def decoded(path: Path) -> list[np.ndarray]:
    with av.open(path) as container:
        return [frame.to_ndarray(format="rgb24").astype(int) for frame in container.decode(video=0)]


@pytest.fixture
def tone(tmp_path: Path) -> Path:
    """Half a second of 440 Hz, mono."""
    rate = 16000
    samples = (8000 * np.sin(np.arange(rate // 2) / rate * 440 * 2 * np.pi)).astype("<i2")
    with wave.open(str(tmp_path / "tone.wav"), "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(rate)
        file.writeframes(samples.tobytes())
    return tmp_path / "tone.wav"


@pytest.mark.parametrize("ending", [".mp4", ".webm"])
def test_video_holds_every_frame_and_they_move(tmp_path: Path, ending: str) -> None:
    frames = decoded(write(tmp_path / f"out{ending}"))
    assert [frame.shape for frame in frames] == [(96, 76, 3)] * N_FRAMES
    assert all((np.abs(a - b).max(axis=2) > 24).mean() > 0.001 for a, b in pairwise(frames))


def test_mp4_is_for_streaming(tmp_path: Path) -> None:
    data = write(tmp_path / "out.mp4").read_bytes()
    assert 0 < data.index(b"moov") < data.index(b"mdat")


@pytest.mark.parametrize(("ending", "codec"), [(".mp4", "aac"), (".webm", "opus")])
def test_sound_is_muxed(tmp_path: Path, tone: Path, ending: str, codec: str) -> None:
    with av.open(write(tmp_path / f"out{ending}", audio=tone)) as container:
        stream = container.streams.audio[0]
        assert stream.codec_context.name == codec
        seconds = sum(frame.samples / frame.sample_rate for frame in container.decode(audio=0))
    assert 0.5 <= seconds < 0.6


def test_gif_has_even_delays_and_loops(tmp_path: Path) -> None:
    with Image.open(write(tmp_path / "out.gif")) as gif:
        assert (
            getattr(gif, "n_frames", 1),
            gif.info["duration"],
            gif.info["loop"],
        ) == (N_FRAMES, 100, 0)


def test_folder_gets_numbered_pngs(tmp_path: Path) -> None:
    names = sorted(path.name for path in write(tmp_path / "frames").iterdir())
    assert names == [f"frame-{index:05}.png" for index in range(N_FRAMES)]


def test_animated_svg_has_its_three_groups_and_names(tmp_path: Path) -> None:
    root = ElementTree.parse(write(tmp_path / "out.svg")).getroot()
    assert root.get("viewBox") == f"0 0 {WIDTH:g} {HEIGHT:g}"
    assert root.findtext(f"{SVG}title") == "Test & Co"
    assert [group.get("id") for group in root.findall(f"{SVG}g")] == [
        "back",
        "fore",
        "local",
    ]


def test_animations_of_the_svg_are_well_formed(tmp_path: Path) -> None:
    root = ElementTree.parse(write(tmp_path / "out.svg")).getroot()
    animations = [element for element in root.iter() if element.tag.startswith(f"{SVG}animate")]
    assert {element.get("attributeName") for element in animations} >= {
        "d",
        "transform",
        "x1",
    }
    for element in animations:
        times = [float(time) for time in element.attrib["keyTimes"].split(";")]
        values = element.attrib["values"].split(";")
        assert len(times) == len(values)
        assert (times[0], times[-1]) == (0, 1)
        assert times == sorted(times)
        if element.get("attributeName") == "d":
            letters = {"".join(filter(str.isalpha, value)) for value in values}
            assert letters == {"mcz"}
    assert not list(root.iter(f"{SVG}script"))


def test_page_carries_svg_and_sound(tmp_path: Path, tone: Path) -> None:
    text = write(tmp_path / "out.html", audio=tone).read_text()
    assert "Test &amp; Co</title>" in text
    assert 'src="data:audio/mp4;base64,' in text
    assert 'fill="freeze"' in text
    assert "indefinite" not in text


@pytest.mark.parametrize(
    ("name", "options"),
    [
        ("out.avi", SMALL),
        ("out.mp4", Options(fps=0)),
        ("out.mp4", Options(fps=1e9)),
        ("out.mp4", Options(size=5)),
    ],
)
def test_unsupported_options_are_refused(tmp_path: Path, name: str, options: Options) -> None:
    with pytest.raises(VectorTalkerError) as error:
        write(tmp_path / name, options)
    assert error.value.code == "bad_option"
    assert not list(tmp_path.iterdir())


def test_full_folder_is_left_alone(tmp_path: Path) -> None:
    (tmp_path / "notes.txt").write_text("mine")
    with pytest.raises(VectorTalkerError):
        write(tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["notes.txt"]


def test_sound_without_a_place_is_refused(tmp_path: Path, tone: Path) -> None:
    with pytest.raises(VectorTalkerError, match="holds no sound"):
        write(tmp_path / "out.gif", audio=tone)


def test_damaged_sound_leaves_no_file(tmp_path: Path) -> None:
    noise = tmp_path / "noise.mp3"
    noise.write_bytes(b"no sound at all" * 50)
    with pytest.raises(VectorTalkerError) as error:
        write(tmp_path / "out.mp4", audio=noise)
    assert error.value.code == "bad_audio"
    assert [path.name for path in tmp_path.iterdir()] == ["noise.mp3"]


def test_portrait_without_a_face_is_refused(tmp_path: Path) -> None:
    with pytest.raises(VectorTalkerError) as error:
        write(
            tmp_path / "out.svg",
            portrait=project().model_copy(update={"landmarks": None}),
        )
    assert error.value.code == "bad_landmarks"


@pytest.mark.parametrize("name", ["out.mp4", "frames"])
def test_stopping_leaves_nothing(tmp_path: Path, name: str) -> None:
    def stop(share: float) -> None:
        if share > 0.3:
            raise InterruptedError

    with pytest.raises(InterruptedError):
        animate(project(), track(), tmp_path / name, SMALL, stop)
    assert not list(tmp_path.iterdir())
