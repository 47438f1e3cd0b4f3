"""Everything that parses what comes from outside, with the inputs to try on it.

A target takes one input and returns, whatever the input: a value, or the typed error that it is documented to raise.
Anything else, and any result that breaks what is promised of it, is a failure.
"""

from __future__ import annotations

import io
import json
import wave
import zipfile
from collections.abc import Callable
from dataclasses import dataclass
from random import Random
from typing import Any
from xml.etree import ElementTree

import numpy as np
from hypothesis import strategies as st
from pydantic import ValidationError
from vectortalker import project, tracks
from vectortalker.decode import Limits, decode
from vectortalker.errors import ErrorCode, VectorTalkerError
from vectortalker.rig import CHANNELS, build_rig
from vectortalker.schema import JobRequest, Landmarks, LocalPath, Pose, Scene, ScenePath, VideoRequest
from vectortalker.server.portraits import display_name
from vectortalker.speech.audio import mono_chunks
from vectortalker.svg import to_svg

from ..animate.scenes import landmarks, scene
from ..contract.documents import project as small_project
from .damage import damaged
from .documents import spoilt
from .pictures import WHOLE

SMALL = Limits(max_bytes=100_000, max_pixels=400_000, max_long_side=256)  # so that a lucky header costs no second


@dataclass(frozen=True)
class Target:
    """`inputs` are drawn by hypothesis, or made by a function of a seeded generator, which is quicker by far."""

    inputs: st.SearchStrategy[Any] | Callable[[Random], Any]
    run: Callable[[Any], None]
    share: float  # of all inputs of a soak; slow targets get less


def _refuses(*codes: ErrorCode) -> Callable[[Callable[[Any], None]], Callable[[Any], None]]:
    """The function may raise errors of these codes, of one line each."""

    def wrap(run: Callable[[Any], None]) -> Callable[[Any], None]:
        def checked(given: Any) -> None:
            try:
                run(given)
            except VectorTalkerError as error:
                assert error.code in codes, (error.code, error.message)
                assert "\n" not in error.message and len(error.message) < 1000, error.message

        return checked

    return wrap


@_refuses("bad_picture", "picture_too_large")
def _picture(data: bytes) -> None:
    portrait = decode(data, "x", SMALL)
    assert portrait.rgb.dtype == np.uint8 and max(portrait.rgb.shape) <= SMALL.max_long_side


@_refuses("bad_project")
def _project(data: bytes) -> None:
    file = project.unpack(data, "x.vtalk")
    assert project.unpack(project.pack(file), "x.vtalk") == file


@_refuses("bad_track")
def _track(data: bytes) -> None:
    track = tracks.read_track(data, "x")
    for time in (-1.0, 0.0, track.duration / 2, 2 * track.duration):
        pose = tracks.sample(track, time)
        assert all(np.isfinite(value) for value in pose.articulators.values())
        assert pose.offsets is None or np.isfinite(pose.offsets).all()


@_refuses("bad_audio")
def _sound(data: bytes) -> None:
    for chunk in mono_chunks(io.BytesIO(data)):
        assert chunk.ndim == 1


def _request(data: bytes) -> None:
    for model in (JobRequest, VideoRequest):
        try:
            model.model_validate_json(data)
        except ValidationError:
            continue


def _rig(given: tuple[Scene, Landmarks, list[Pose]]) -> None:
    """Finite in, finite out; only landmarks that span no face are refused."""
    drawn, face, poses = given
    try:
        rig = build_rig(drawn, face)
    except ValueError:
        return
    for pose in poses:
        posed = rig.vertices(pose)
        assert np.isfinite(posed.vertices).all() and 0 <= posed.scale <= 1
        for points in [*rig.frame_points(posed.vertices), *rig.openings(posed.vertices)]:
            assert np.isfinite(points).all()


def _svg(title: str) -> None:
    """Whatever the file was called, the SVG is well formed and holds no element more."""
    drawing = ElementTree.fromstring(to_svg(scene(), [], title, (240, 300)).encode())
    names = {element.tag.rpartition("}")[2] for element in drawing.iter()}
    assert names <= {"svg", "title", "desc", "defs", "rect", "g", "path", "clipPath", "linearGradient", "stop"}


def _name(filename: str) -> None:
    shown = display_name(filename)
    assert shown and "/" not in shown and "\\" not in shown and shown.isprintable() and len(shown) <= 120


# ---------------------------------------------------------------- inputs


def _zipped(entries: dict[str, bytes]) -> bytes:
    archive = io.BytesIO()
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as file:
        for name, data in entries.items():
            file.writestr(name, data)
    return archive.getvalue()


def _tone() -> bytes:
    file = io.BytesIO()
    with wave.open(file, "wb") as sound:
        sound.setparams((1, 2, 8000, 0, "NONE", ""))
        sound.writeframes((np.sin(np.arange(800) / 5) * 9000).astype("<i2").tobytes())
    return file.getvalue()


_PROJECT = small_project().model_copy(update={"source": "source.png", "audio": "voice.wav"})
_PROJECT_DOCUMENT = json.loads(_PROJECT.model_dump_json())
_SPOILT_PROJECT = spoilt(_PROJECT_DOCUMENT)
_TRACK = {
    "schema_version": 1,
    "duration": 0.2,
    "fps": 10,
    "articulators": {"jaw": [0, 1]},
    "landmarks": [[[0, 0]] * 68] * 2,
}
_CUES = {
    "metadata": {"duration": 0.5},
    "mouthCues": [{"start": 0, "end": 0.2, "value": "A"}, {"start": 0.2, "end": 0.5, "value": "X"}],
}
_TSV = b"0.00\tX\n0.20\tD\n0.50\tA\n0.80\tX\n"
_CSV = "\n".join(",".join(map(str, [0.04 * t, *range(136)])) for t in range(3)).encode()
_JOB = {
    "portrait_id": "0" * 32,
    "landmarks": {"points": [[i, i] for i in range(68)]},
    "options": {"paths": 8, "seed": 1},
}
_VIDEO = json.loads(
    VideoRequest(
        scene=scene(), landmarks=landmarks(), track=tracks.read_track(json.dumps(_TRACK).encode(), "x")
    ).model_dump_json()
)

_HOSTILE_NAMES = ["../x", "/etc/passwd", "..", "", "a\\b", "project.json", "source.png", "\x00", "x" * 300]


def _hostile_zip(random: Random) -> bytes:
    """A spoilt document beside media of hostile names and sizes."""
    name = random.choice(_HOSTILE_NAMES)
    document = dict(_PROJECT_DOCUMENT)
    if random.random() < 0.5:
        document |= json.loads(_SPOILT_PROJECT(random))
    if random.random() < 0.5:
        document["source"] = name
    media = bytes(random.choice([0, 1, 100_000]))
    entries = {"project.json": json.dumps(document).encode(), "voice.wav": b"sound"}
    return _zipped({**entries, name.replace("\x00", "0") or "empty": media})


_COORDINATES = st.floats(-1e6, 1e6) | st.floats(0, 240) | st.sampled_from([0.0, 120.0, -0.0, 1e-300])


@st.composite
def _faces(draw: st.DrawFn) -> Landmarks:
    """The plain face with a few points anywhere, or with all on a line or in a point."""
    points = list(landmarks().points)
    for _ in range(draw(st.integers(0, 8))):
        points[draw(st.integers(0, 67))] = (draw(_COORDINATES), draw(_COORDINATES))
    match draw(st.integers(0, 9)):
        case 0:
            points = [(x, 7.0) for x, _ in points]
        case 1:
            points = [points[0]] * 68
    return Landmarks(points=points)


@st.composite
def _rigged(draw: st.DrawFn) -> tuple[Scene, Landmarks, list[Pose]]:
    chain = st.lists(_COORDINATES, min_size=2, max_size=3).flatmap(
        lambda seed: st.sampled_from([2, 3]).map(lambda n: (seed * 6 * n)[: 6 * n])
    )
    fill = scene().fore[0].fill
    fore = [ScenePath(points=draw(chain), fill=fill) for _ in range(draw(st.integers(0, 2)))]
    local = [LocalPath(points=draw(chain), fill=fill, part="tongue") for _ in range(draw(st.integers(0, 1)))]
    width, height = (draw(st.sampled_from([240.0, 1.0, 65536.0, 1e-9])) for _ in range(2))
    drawn = Scene(width=width, height=height, canvas="#ffffff", back=[], fore=[*scene().fore[:2], *fore], local=local)
    offsets = st.none() | st.lists(st.tuples(*[st.floats(-100, 100)] * 2), min_size=1, max_size=4).map(
        lambda few: (few * 68)[:68]
    )
    articulators = st.dictionaries(st.sampled_from(CHANNELS), st.floats(-360, 360), max_size=6)
    poses = st.lists(st.builds(Pose, articulators=articulators, offsets=offsets), min_size=1, max_size=3)
    return drawn, draw(_faces()), draw(poses)


_PROJECT_FILE = project.pack(project.ProjectFile(_PROJECT, b"picture", b"sound"))
_TRACK_FILES = [_TSV, _CSV, json.dumps(_TRACK).encode(), json.dumps(_CUES).encode()]

TARGETS = {
    "picture": Target(damaged(WHOLE), _picture, 0.25),
    "damaged project": Target(damaged([_PROJECT_FILE]), _project, 0.1),
    "hostile project": Target(_hostile_zip, _project, 0.05),
    "track document": Target(spoilt(_TRACK, _CUES), _track, 0.2),
    "track file": Target(damaged(_TRACK_FILES), _track, 0.2),
    "sound": Target(damaged([_tone()]), _sound, 0.07),
    "request": Target(spoilt(_JOB, _VIDEO), _request, 0.08),
    "rig": Target(_rigged(), _rig, 0.01),
    "svg title": Target(st.text(max_size=60), _svg, 0.02),
    "file name": Target(st.text(max_size=200), _name, 0.02),
}
