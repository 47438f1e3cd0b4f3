"""Speech at the HTTP border: recordings, listening to them by a real worker, edited visemes, track files."""

from __future__ import annotations

import csv
import io
import shutil
import wave

import httpx
import numpy as np
import pytest
from vectortalker import schema
from vectortalker.server.services import Services

from .conftest import Serving, wait_until
from .test_api import UNKNOWN, refused

RATE = 16_000
LEAST_CLOSED_PRESS = 0.9
BLOCKS = [
    {"t": 0.2, "d": 0.2, "viseme": "aa", "weight": 1.0},
    {"t": 0.4, "d": 0.1, "viseme": "PP", "weight": 1.0},
    {"t": 0.5, "d": 0.3, "viseme": "O", "weight": 1.0},
]

needs_espeak = pytest.mark.skipif(shutil.which("espeak-ng") is None, reason="espeak-ng is not installed")


def tone(seconds: float = 1.0, level: float = 0.5) -> bytes:
    """A WAV file with a square wave of 200 Hz in its second half, silence before."""
    n = round(seconds * RATE)
    wave_form = np.where(np.arange(n) % 80 < 40, level, -level) * (np.arange(n) >= n // 2)
    file = io.BytesIO()
    with wave.open(file, "wb") as out:
        out.setnchannels(1)
        out.setsampwidth(2)
        out.setframerate(RATE)
        out.writeframes((wave_form * 32767).astype(np.int16).tobytes())
    return file.getvalue()


def upload(client: httpx.Client, data: bytes, name: str = "voice.wav") -> httpx.Response:
    return client.post("/api/recordings", files={"file": (name, data)})


def form(client: httpx.Client, **fields: object) -> httpx.Response:
    return client.post("/api/tracks/visemes", json={"visemes": BLOCKS, "duration": 1.0, **fields})


def finished(client: httpx.Client, job_id: str) -> schema.JobState:
    def state() -> schema.JobState:
        return schema.JobState.model_validate(client.get(f"/api/jobs/{job_id}").json())

    wait_until(lambda: state().phase in ("done", "failed", "cancelled"))
    return state()


def listen(client: httpx.Client, **fields: object) -> schema.SpeechResult:
    """The result of a job that must succeed."""
    job = client.post("/api/speech", json=fields)
    assert job.status_code == 202, job.text
    end = finished(client, job.json()["id"])
    assert (end.phase, end.stage, end.progress) == ("done", "done", 1), end
    return schema.SpeechResult.model_validate(client.get(f"/api/speech/{end.id}/result").json())


# ---------------------------------------------------------------- recordings


def test_recording_comes_back_as_it_was(client: httpx.Client) -> None:
    data = tone()
    answer = upload(client, data, "../my voice.wav")
    assert answer.status_code == 201, answer.text
    recording = schema.Recording.model_validate(answer.json())
    assert (recording.name, recording.duration, recording.media_type) == ("my voice.wav", 1.0, "audio/wav")
    assert client.get(f"/api/recordings/{recording.id}").json() == answer.json()
    sound = client.get(f"/api/recordings/{recording.id}/audio")
    assert sound.content == data and sound.headers["content-type"] == "audio/wav"


def test_recording_envelope_is_its_peak(client: httpx.Client) -> None:
    envelope = np.array(upload(client, tone(1.0, level=0.5)).json()["envelope"])
    assert len(envelope) == 50
    assert (envelope[:25] == 0).all() and np.allclose(envelope[25:], 0.5, atol=0.001)


@pytest.mark.parametrize("data", [b"", b"hello", tone()[:44]], ids=["empty", "text", "header only"])
def test_recording_without_sound_is_refused(client: httpx.Client, data: bytes) -> None:
    refused(upload(client, data), 422, "bad_audio")


def test_recording_may_be_larger_than_other_bodies(client: httpx.Client, services: Services) -> None:
    data = tone(seconds=70)
    assert len(data) > services.settings.max_body_bytes
    assert upload(client, data).json()["duration"] == 70
    refused(client.post("/api/portraits", files={"file": ("a.png", data)}), 413, "bad_request")


def test_recording_deletion_leaves_nothing(client: httpx.Client, services: Services) -> None:
    recording_id = upload(client, tone()).json()["id"]
    job_id = client.post("/api/speech", json={"recording_id": recording_id}).json()["id"]
    assert client.delete(f"/api/recordings/{recording_id}").status_code == 204
    for path in (f"recordings/{recording_id}", f"recordings/{recording_id}/audio", f"jobs/{job_id}"):
        refused(client.get(f"/api/{path}"), 404, "not_found")
    assert not [path for path in (services.settings.data / "blobs").rglob("*") if path.is_file()]


# ---------------------------------------------------------------- text


@needs_espeak
def test_spoken_text_is_a_recording(client: httpx.Client) -> None:
    answer = client.post("/api/recordings/spoken", json={"text": "Hello there.", "language": "en-us", "voice": "f3"})
    assert answer.status_code == 201, answer.text
    recording = schema.Recording.model_validate(answer.json())
    assert 0.4 < recording.duration < 3 and max(recording.envelope) > 0.1
    with wave.open(io.BytesIO(client.get(f"/api/recordings/{recording.id}/audio").content)) as sound:
        assert sound.getnframes() / sound.getframerate() == pytest.approx(recording.duration, abs=0.002)


@needs_espeak
@pytest.mark.parametrize(
    "fields", [{"text": " ... "}, {"text": "hi", "language": "xx"}, {"text": "hi", "voice": "f3;ls"}]
)
def test_text_that_cannot_be_spoken_is_refused(client: httpx.Client, fields: dict[str, str]) -> None:
    refused(client.post("/api/recordings/spoken", json=fields), 422, "bad_option")


def test_text_without_espeak_is_unsupported(client: httpx.Client, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "")
    sentence = refused(client.post("/api/recordings/spoken", json={"text": "hi"}), 422, "unsupported")
    assert "espeak-ng is not installed" in sentence


# ---------------------------------------------------------------- listening


@needs_espeak
def test_speech_is_heard_by_a_worker(serving: Serving) -> None:
    client = serving.client
    text = "Peter bought a bag of apples."
    recording = client.post("/api/recordings/spoken", json={"text": text, "language": "en-us"}).json()
    for transcript, tier in ((None, "audio"), (text, "transcript")):
        options = {"language": "en-us"}
        result = listen(client, recording_id=recording["id"], transcript=transcript, options=options)
        assert result.tier == tier
        assert result.track.duration == pytest.approx(recording["duration"], abs=0.021)
        assert len(result.loudness) == len((result.track.articulators or {})["jaw"])
        assert {"PP", "aa", "sil"} <= {block.viseme for block in result.visemes}
        ends = [block.t + block.d for block in result.visemes]
        assert ends[-1] == pytest.approx(result.track.duration, abs=0.002)


@needs_espeak
def test_part_is_heard_anew_and_the_rest_is_kept(serving: Serving) -> None:
    client = serving.client
    recording = client.post("/api/recordings/spoken", json={"text": "Mama, papa, mama, papa."}).json()
    kept = [{"t": 0.0, "d": 0.5, "viseme": "O"}, {"t": 0.5, "d": recording["duration"] - 0.5, "viseme": "U"}]
    part = {"start": 0.3, "end": 1.0}
    result = listen(client, recording_id=recording["id"], part=part, visemes=kept)
    inside = [block.viseme for block in result.visemes if block.t >= 0.299 and block.t + block.d <= 1.001]
    assert {"PP", "aa"} <= set(inside)
    assert (result.visemes[0].viseme, result.visemes[0].d) == ("O", 0.3)
    assert (result.visemes[-1].viseme, result.visemes[-1].t) == ("U", 1.0)


@needs_espeak
def test_transcript_of_something_else_fails_in_words(serving: Serving) -> None:
    client = serving.client
    recording = client.post("/api/recordings/spoken", json={"text": "Yes."}).json()
    job = client.post("/api/speech", json={"recording_id": recording["id"], "transcript": "word " * 200}).json()
    end = finished(client, job["id"])
    assert end.phase == "failed" and end.error is not None and end.error.code == "bad_option"
    refused(client.get(f"/api/speech/{end.id}/result"), 404, "not_found")


@pytest.mark.parametrize(
    ("fields", "code"),
    [
        ({"part": {"start": 0, "end": 1}}, "bad_request"),
        ({"part": {"start": 1, "end": 1}, "visemes": []}, "bad_request"),
        ({"options": {"amplitude": 9}}, "bad_option"),
        ({"options": {"style": "loud"}}, "bad_option"),
    ],
)
def test_speech_that_cannot_be_is_refused(client: httpx.Client, fields: dict[str, object], code: str) -> None:
    recording_id = upload(client, tone()).json()["id"]
    refused(
        client.post("/api/speech", json={"recording_id": recording_id, **fields}),
        422 if code != "bad_request" else 400,
        code,
    )


def test_speech_of_no_recording_is_not_found(client: httpx.Client) -> None:
    refused(client.post("/api/speech", json={"recording_id": UNKNOWN}), 404, "not_found")
    refused(client.get(f"/api/speech/{UNKNOWN}/result"), 404, "not_found")


# ---------------------------------------------------------------- visemes


def test_edited_visemes_become_a_track(client: httpx.Client) -> None:
    track = schema.Track.model_validate(form(client).json())
    channels = track.articulators or {}
    assert (track.duration, track.fps, len(channels["jaw"])) == (1.0, 50, 50)
    assert max(channels["press"][18:25]) > LEAST_CLOSED_PRESS  # frames 0.36 s to 0.48 s, where the lips meet for p
    assert channels["round"][35] > channels["round"][15]
    assert channels["jaw"][0] < 0.1 < channels["jaw"][15]


def test_moved_block_moves_its_closure(client: httpx.Client) -> None:
    def closure(at: float) -> int:
        moved = [{"t": 0.1, "d": at - 0.1, "viseme": "aa"}, {"t": at, "d": 0.1, "viseme": "PP"}]
        return int(np.argmax(form(client, visemes=moved).json()["articulators"]["press"]))

    assert closure(0.6) - closure(0.4) == 10  # frames of 20 ms


def test_gaps_between_visemes_are_silence(client: httpx.Client) -> None:
    ends = [{"t": 0.0, "d": 0.1, "viseme": "aa"}, {"t": 0.9, "d": 0.1, "viseme": "aa"}]
    track = form(client, visemes=ends).json()
    assert [block["viseme"] for block in track["visemes"]] == ["aa", "sil", "aa"]
    assert abs(track["articulators"]["jaw"][25]) < 0.05


def test_visemes_as_landmarks_have_no_articulators(client: httpx.Client) -> None:
    track = form(client, **{"as": "landmarks"}).json()
    assert len(track["landmarks"]) == 50 and "articulators" not in track


def test_loudness_moves_the_head(client: httpx.Client) -> None:
    def nods(loudness: list[float] | None) -> list[float]:
        return form(client, loudness=loudness).json()["articulators"]["pitch"]

    stressed = [4.0 * (10 <= frame < 14) for frame in range(50)]
    assert nods(stressed) != nods(None) == nods([0.0] * 50)


@pytest.mark.parametrize(
    ("fields", "code"),
    [
        ({"visemes": [BLOCKS[1], BLOCKS[0]]}, "bad_track"),
        ({"visemes": [{"t": 0, "d": 1, "viseme": "ZZ"}]}, "bad_track"),
        ({"visemes": [{"t": 0, "d": 0, "viseme": "aa"}]}, "bad_track"),
        ({"options": {"gains": {"ears": 1}}}, "bad_option"),
        ({"duration": 601}, "bad_request"),
    ],
)
def test_visemes_that_cannot_be_are_refused(client: httpx.Client, fields: dict[str, object], code: str) -> None:
    refused(form(client, **fields), 400 if code == "bad_request" else 422, code)


# ---------------------------------------------------------------- track files


def exported(client: httpx.Client, track: dict, kind: str) -> str:
    answer = client.post("/api/tracks/export", json={"track": track, "format": kind})
    assert answer.status_code == 200, answer.text
    assert "attachment" in answer.headers["content-disposition"]
    return answer.text


def imported(client: httpx.Client, text: str) -> dict:
    answer = client.post("/api/tracks/import", files={"file": ("track.any", text.encode())})
    assert answer.status_code == 200, answer.text
    return answer.json()


def test_own_track_comes_back_whole(client: httpx.Client) -> None:
    track = form(client).json()
    assert imported(client, exported(client, track, "json")) == track


@pytest.mark.parametrize("kind", ["rhubarb-tsv", "rhubarb-json"])
def test_rhubarb_keeps_shapes_and_times(client: httpx.Client, kind: str) -> None:
    read = imported(client, exported(client, form(client).json(), kind))
    shapes = [(block["t"], block["viseme"]) for block in read["visemes"]]
    assert shapes == [(0.0, "sil"), (0.2, "aa"), (0.4, "PP"), (0.5, "O"), (0.8, "sil")]
    assert read["duration"] == 1.0


def test_csv_holds_the_moving_lips(client: httpx.Client) -> None:
    rows = list(csv.DictReader(io.StringIO(exported(client, form(client).json(), "csv"))))
    gap = [float(row["y66"]) - float(row["y62"]) for row in rows]
    assert [float(row["t"]) for row in rows[:3]] == [0, 0.02, 0.04] and len(rows) == 50
    assert gap[15] > 5 > 1 > abs(gap[21])  # pixels: open in the vowel, closed for the p


def test_mouth_cues_need_visemes(client: httpx.Client) -> None:
    track = {"duration": 0.2, "fps": 10, "articulators": {"jaw": [0, 1]}}
    answer = client.post("/api/tracks/export", json={"track": track, "format": "rhubarb-tsv"})
    refused(answer, 422, "bad_track")


def test_file_that_is_no_track_is_refused(client: httpx.Client) -> None:
    refused(client.post("/api/tracks/import", files={"file": ("x.csv", b"1,2,3")}), 422, "bad_track")
