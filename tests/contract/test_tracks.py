"""Track files of every kind, and what is refused."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from vectortalker.errors import VectorTalkerError
from vectortalker.schema import Track
from vectortalker.tracks import read_track, sample

RHUBARB_TSV = b"0.00\tX\n0.20\tD\n0.50\tA\n0.80\tX\n"
RHUBARB_JSON = {
    "metadata": {"duration": 0.8},
    "mouthCues": [
        {"start": 0.0, "end": 0.2, "value": "X"},
        {"start": 0.2, "end": 0.5, "value": "D"},
        {"start": 0.5, "end": 0.8, "value": "A"},
    ],
}


def track(**changes: Any) -> bytes:
    whole = {"schema_version": 1, "duration": 0.2, "fps": 10, "articulators": {"jaw": [0.0, 1.0]}}
    return json.dumps({**whole, **changes}).encode()


def refusal(data: bytes) -> str:
    with pytest.raises(VectorTalkerError) as caught:
        read_track(data, "track")
    assert caught.value.code == "bad_track"
    assert "\n" not in caught.value.message
    return caught.value.message


def csv(frames: list[np.ndarray], step: float = 0.04) -> bytes:
    names = ",".join(["t", *(f"{axis}{i}" for i in range(68) for axis in "xy")])
    rows = [",".join(map(str, [i * step, *points.ravel()])) for i, points in enumerate(frames)]
    return "\n".join([names, *rows]).encode()


def face(lip_gap: float, scale: float = 1.0) -> np.ndarray:
    """68 points on a line but for eyes of gap 1 and inner lips of `lip_gap`; outer eye corners 45 - 36 = 9 apart."""
    points = np.stack([np.arange(68.0), np.zeros(68)], axis=1)
    points[[37, 38, 43, 44], 1] = -1
    points[[65, 66, 67], 1] = lip_gap
    return points * scale


def test_track_json_round_trip() -> None:
    read = read_track(track(name="hello", visemes=[{"t": 0}]), "track")
    assert read_track(read.model_dump_json().encode(), "track") == read
    assert read.model_extra == {"visemes": [{"t": 0}]}, "editor data stands beside the track"


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (track(schema_version=2), "version 2"),
        (track(schema_version=None), "schema_version"),
        (track(articulators={"jaw": [0.0, 1.0, 0, 0]}), "articulator jaw has 4 frames; 0.2 s at 10 frames a second"),
        (track(articulators={"jaw": []}), "0 frames"),
        (track(articulators={}), "needs landmarks or articulators"),
        (track(articulators=None, landmarks=[[[0, 0]] * 67] * 2), "landmarks.0"),
        (track(duration=7200, articulators={"jaw": [0]}), "3600"),
        (track(articulators={"jaw": [0, float("nan")]}), "NaN"),
        (track(articulators={"jaw": [0, 1e300]}), "360"),
        (b'{"schema_version": 1, "duration": 0.2, "fps": 1e999, "articulators": {"jaw": [0]}}', "fps"),
        (b"[" * 100_000, "nested too deeply"),
        (b"[1]", "is a list"),
        (b"\xff\xfe\x00", "neither JSON nor text"),
        (b"", "columns"),
        (b" " * 33_000_000, "33 MB; the limit is 32 MB"),
        (b"0.00\tX\n0.10\tQ\n", "'Q'"),
        (b"0.00\tX\n0.10\n", "Line 2"),
        (b"nan\tX\n", "nan s"),
        (b"0.00\tX\n", "no mouth cues"),
        (b'{"mouthCues": [{"start": 0, "end": 1e9, "value": "A"}]}', "3600"),
        (b'{"mouthCues": [1]}', "list of cues"),
        (csv([face(0)]), "needs 2"),
        (csv([face(0), face(np.nan)]), "Row 2"),
        (csv([face(0), face(0)], step=0), "ascend"),
        (csv([face(0), face(0)], step=1e-4), None),
        (csv([face(0)] * 3, step=1e7), "3600"),
        (csv([face(0)] * 4, step=0.01).replace(b"\n0.03,", b"\n2000,"), "200001 frames"),
        (csv([face(0, scale=0)] * 2), "coincide"),
        (csv([face(0)] * 2).replace(b"45.0", b"x"), "cannot be read"),
        (csv([face(0)] * 2) + b",1", "cannot be read"),
    ],
)
def test_track_at_fault_is_explained(data: bytes, words: str | None) -> None:
    if words is None:
        assert read_track(data, "track").fps == 240
    else:
        assert words in refusal(data)


@pytest.mark.parametrize("data", [RHUBARB_TSV, json.dumps(RHUBARB_JSON).encode()], ids=["tsv", "json"])
def test_rhubarb_shape_is_complete_when_its_cue_begins(data: bytes) -> None:
    read = read_track(data, "cues")
    assert read.duration == pytest.approx(0.8)
    assert sample(read, 0.1).articulators["jaw"] == 0
    assert 0 < sample(read, 0.18).articulators["jaw"] < 1
    assert sample(read, 0.2).articulators["jaw"] == sample(read, 0.42).articulators["jaw"] == 1
    assert sample(read, 0.5).articulators["press"] == 1


def test_csv_offsets_are_from_the_closed_mouth_in_eye_distances() -> None:
    """Lips 1.8 px open at 9 px between the eyes: offset 0.2, whatever the scale of the file."""
    for scale in (1.0, 50.0):
        read = read_track(csv([face(1.8, scale), face(0, scale), face(0.9, scale)]), "csv")
        assert (read.fps, read.duration) == (pytest.approx(25), pytest.approx(0.12))
        offsets = np.array(read.landmarks)
        np.testing.assert_allclose(offsets[:, 66, 1], [0.2, 0, 0.1], atol=1e-5)
        np.testing.assert_allclose(offsets[:, :60], 0, atol=1e-5)


def test_csv_with_a_missing_row_is_resampled() -> None:
    lines = csv([face(0), face(0.9), face(1.8), face(2.7), face(3.6)], step=0.1).decode().splitlines()
    read = read_track("\n".join([*lines[:4], lines[5]]).encode(), "csv")
    np.testing.assert_allclose(np.array(read.landmarks)[:, 66, 1], [0, 0.1, 0.2, 0.3, 0.4], atol=1e-5)


def test_sample_is_linear_between_frames_and_still_outside() -> None:
    landmarks = [[(0.0, 0.0)] * 68, [(1.0, -2.0)] * 68]
    read = Track(duration=0.2, fps=10, articulators={"jaw": [0, 1]}, landmarks=landmarks)
    assert sample(read, 0.025).articulators == {"jaw": pytest.approx(0.25), "neutral": 1}
    assert sample(read, 0.025).offsets == [(pytest.approx(0.25), pytest.approx(-0.5))] * 68
    assert sample(read, -1) == sample(read, 0)
    assert sample(read, 99).articulators == {"jaw": 1, "neutral": 1}


@settings(max_examples=300, deadline=None)
@given(st.binary(max_size=400) | st.text(max_size=400).map(str.encode))
def test_any_bytes_are_a_track_or_refused(data: bytes) -> None:
    try:
        read_track(data, "track")
    except VectorTalkerError as error:
        assert error.code == "bad_track"


@pytest.mark.parametrize("cue", [{"start": 0, "value": ["A"]}, {"start": 10**400, "value": "A"}])
def test_cue_of_another_kind_is_refused(cue: dict[str, Any]) -> None:
    assert "cue 1" in refusal(json.dumps({"mouthCues": [cue]}).encode())
