"""The HTTP border without workers: what is accepted, what is refused, and in which words."""

from __future__ import annotations

import json

import httpx
import pytest
from vectortalker.server.services import Services

from .pictures import picture

UNKNOWN = "0" * 32


def upload(client: httpx.Client, data: bytes, name: str = "face.png") -> httpx.Response:
    return client.post("/api/portraits", files={"file": (name, data)})


def start_job(client: httpx.Client, portrait_id: str, **options: object) -> httpx.Response:
    return client.post("/api/jobs", json={"portrait_id": portrait_id, "options": options})


def refused(answer: httpx.Response, status: int, code: str) -> str:
    """Checks the form of an error; its sentence."""
    assert answer.status_code == status, answer.text
    body = answer.json()
    assert set(body) == {"code", "message"} and body["code"] == code, body
    assert body["message"].endswith(".") and "\n" not in body["message"]
    return body["message"]


def test_portrait_keeps_its_pixels(client: httpx.Client) -> None:
    data = picture(40, 30)
    portrait = upload(client, data).json()
    assert (portrait["width"], portrait["height"], portrait["name"]) == (
        40,
        30,
        "face.png",
    )
    image = client.get(f"/api/portraits/{portrait['id']}/image")
    assert image.headers["content-type"] == "image/png"
    assert client.get(f"/api/portraits/{portrait['id']}").json() == portrait


def test_portrait_without_a_face_has_no_faces(client: httpx.Client) -> None:
    portrait_id = upload(client, picture()).json()["id"]
    assert client.get(f"/api/portraits/{portrait_id}/faces").json() == {
        "width": 96,
        "height": 128,
        "faces": [],
    }


def test_portrait_name_is_never_a_path(client: httpx.Client) -> None:
    assert upload(client, picture(), "..\\..\\etc/passwd").json()["name"] == "passwd"


def test_portrait_deletion_leaves_nothing(client: httpx.Client, services: Services) -> None:
    portrait_id = upload(client, picture()).json()["id"]
    job_id = start_job(client, portrait_id).json()["id"]
    assert client.delete(f"/api/portraits/{portrait_id}").status_code == 204
    for path in (
        f"portraits/{portrait_id}",
        f"portraits/{portrait_id}/image",
        f"jobs/{job_id}",
    ):
        refused(client.get(f"/api/{path}"), 404, "not_found")
    assert not [path for path in (services.settings.data / "blobs").rglob("*") if path.is_file()]


@pytest.mark.parametrize(
    ("data", "status", "code"),
    [
        (b"", 422, "bad_picture"),
        (b"hello", 422, "bad_picture"),
        (b"x" * 3_000_000, 413, "bad_request"),
    ],
    ids=["empty", "text", "too large"],
)
def test_portrait_that_is_none_is_refused(client: httpx.Client, data: bytes, status: int, code: str) -> None:
    refused(upload(client, data), status, code)


def test_body_of_unknown_length_is_limited(client: httpx.Client) -> None:
    endless = (b"x" * 65536 for _ in range(1000))
    message = refused(client.post("/api/jobs", content=endless), 413, "bad_request")
    assert "2 MB" in message


@pytest.mark.parametrize(
    ("method", "path", "status", "code"),
    [
        ("GET", f"/api/portraits/{UNKNOWN}", 404, "not_found"),
        ("DELETE", f"/api/portraits/{UNKNOWN}", 404, "not_found"),
        ("GET", f"/api/jobs/{UNKNOWN}/events", 404, "not_found"),
        ("POST", f"/api/jobs/{UNKNOWN}/finish", 404, "not_found"),
        ("GET", "/api/jobs/..%2f..%2fjobs.sqlite", 404, "not_found"),
        ("GET", "/api/nothing", 404, "not_found"),
        ("PUT", "/api/jobs", 405, "bad_request"),
    ],
)
def test_unknown_places_are_named(client: httpx.Client, method: str, path: str, status: int, code: str) -> None:
    refused(client.request(method, path), status, code)


@pytest.mark.parametrize(
    ("body", "code", "words"),
    [
        ("{", "bad_request", "JSON"),
        (
            '{"portrait_id": "x", "options": {"paths": 3}}',
            "bad_option",
            "options.paths",
        ),
        (
            '{"portrait_id": "x", "options": {"pahts": 30}}',
            "bad_option",
            "options.pahts",
        ),
        (
            '{"portrait_id": "x", "landmarks": {"points": [[0, 0]]}}',
            "bad_landmarks",
            "68",
        ),
        (
            json.dumps({"portrait_id": "x", "landmarks": {"points": [[0, float("nan")]] * 68}}),
            "bad_landmarks",
            "finite",
        ),
        ('{"portrait_id": ' + "[" * 100_000, "bad_request", ""),
    ],
    ids=["cut", "limit", "misspelt", "too few", "nan", "deep"],
)
def test_job_request_at_fault_is_explained(client: httpx.Client, body: str, code: str, words: str) -> None:
    answer = client.post("/api/jobs", content=body, headers={"content-type": "application/json"})
    assert answer.status_code in (400, 422)
    assert words in refused(answer, answer.status_code, code)


def test_job_of_an_unknown_portrait_is_refused(client: httpx.Client) -> None:
    refused(start_job(client, UNKNOWN), 404, "not_found")


def test_queue_tells_positions_and_its_limit(client: httpx.Client) -> None:
    portrait_id = upload(client, picture()).json()["id"]
    jobs = [start_job(client, portrait_id).json() for _ in range(3)]
    assert [job["queue_position"] for job in jobs] == [0, 1, 2]
    refused(start_job(client, portrait_id), 429, "queue_full")
    cancelled = client.delete(f"/api/jobs/{jobs[0]['id']}").json()
    assert cancelled["phase"] == "cancelled" and cancelled["queue_position"] is None
    moved = client.get(f"/api/jobs/{jobs[2]['id']}").json()
    assert moved["queue_position"] == 1 and moved["estimate_s"] < jobs[2]["estimate_s"]


def test_full_disk_is_an_answer(client: httpx.Client, services: Services, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(services.blobs, "_min_free_bytes", 1 << 60)
    assert "full" in refused(upload(client, picture()), 507, "storage_full")


def events(client: httpx.Client, job_id: str, last_seen: int | None = None) -> httpx.Response:
    headers = {} if last_seen is None else {"Last-Event-ID": str(last_seen)}
    return client.get(f"/api/jobs/{job_id}/events", headers=headers)


def test_events_of_an_ended_job_are_its_last_snapshot(client: httpx.Client) -> None:
    job_id = start_job(client, upload(client, picture()).json()["id"]).json()["id"]
    last = client.delete(f"/api/jobs/{job_id}").json()
    answer = events(client, job_id)
    assert answer.headers["content-type"].startswith("text/event-stream")
    lines = answer.text.strip().split("\n")
    assert json.loads(lines[0].removeprefix("data: ")) == last
    assert lines[1] == f"id: {last['revision']}"


def test_events_already_seen_send_the_browser_away(client: httpx.Client) -> None:
    job_id = start_job(client, upload(client, picture()).json()["id"]).json()["id"]
    revision = client.delete(f"/api/jobs/{job_id}").json()["revision"]
    assert events(client, job_id, revision).status_code == 204
    assert events(client, job_id, revision - 1).status_code == 200


def test_page_is_confined(client: httpx.Client) -> None:
    answer = client.get("/")
    policy = answer.headers["content-security-policy"]
    assert "<title>page</title>" in answer.text
    assert "script-src 'self' 'wasm-unsafe-eval'" in policy and "unsafe-inline" not in policy
    assert "access-control-allow-origin" not in client.get("/api/health", headers={"Origin": "https://e.test"}).headers


def test_server_answers_only_to_its_own_names(client: httpx.Client) -> None:
    refused(client.get("/api/health", headers={"Host": "rebound.test"}), 421, "bad_request")
    assert client.get("/api/health", headers={"Host": "localhost:9"}).status_code == 200


def test_page_paths_stay_in_their_folder(client: httpx.Client, services: Services) -> None:
    (services.settings.page.parent / "secret.txt").write_text("hidden")
    assert "hidden" not in client.get("/%2e%2e/secret.txt").text
