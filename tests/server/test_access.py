"""Who may use the server, how much one client gets, and what operators see of it."""

from __future__ import annotations

import argparse
import json
import logging
import subprocess
import time
from collections.abc import Iterator
from dataclasses import replace

import httpx
import pytest
from vectortalker.cli import serve
from vectortalker.errors import VectorTalkerError
from vectortalker.server.app import create_app
from vectortalker.server.logs import about_job, set_up_logs
from vectortalker.server.redis_store import RedisStore
from vectortalker.server.services import Services

from .conftest import COMMAND, Socket, free_port
from .pictures import picture
from .test_api import refused, start_job, upload

TOKENS = ("ada's secret", "eve's secret")


def bearer(token: str) -> dict[str, str]:
    return {"Authorization": f"Bearer {token}"}


@pytest.fixture
def guarded(services: Services, listening: Socket) -> Iterator[httpx.Client]:
    """A client of a server that asks for one of `TOKENS`."""
    settings = replace(services.settings, tokens=TOKENS, max_active=1)
    listening.app = create_app(replace(services, settings=settings))
    with httpx.Client(base_url=listening.url, timeout=20) as client:
        yield client


@pytest.mark.parametrize(
    "headers",
    [
        {},
        bearer("wrong"),
        {"Authorization": "Bearer"},
        {"Cookie": "vectortalker=wrong"},
        {"Cookie": "vectortalker=\xe9"},
        {"Cookie": ";;="},
    ],
    ids=["none", "wrong", "empty", "cookie", "no ascii", "odd"],
)
def test_api_is_closed_without_a_token(guarded: httpx.Client, headers: dict[str, str]) -> None:
    encoded = {name: value.encode("latin-1") for name, value in headers.items()}
    for path in ("/api/jobs/" + "0" * 32, "/api/openapi.json", "/metrics"):
        refused(guarded.get(path, headers=encoded), 401, "unauthorised")
    refused(guarded.post("/api/portraits", headers=encoded), 401, "unauthorised")
    assert guarded.get("/api/health", headers=encoded).status_code == 200
    assert guarded.get("/", headers=encoded).status_code == 200


@pytest.mark.parametrize("token", TOKENS)
def test_token_opens_the_api(guarded: httpx.Client, token: str) -> None:
    refused(guarded.get("/api/jobs/" + "0" * 32, headers=bearer(token)), 404, "not_found")


def test_browser_gets_a_cookie_for_its_token(guarded: httpx.Client) -> None:
    answer = guarded.get("/", params={"token": TOKENS[0]})
    assert answer.status_code == 303 and answer.headers["location"] == "./"
    cookie = answer.headers["set-cookie"]
    assert "HttpOnly" in cookie and "SameSite=strict" in cookie and TOKENS[0] not in cookie
    refused(guarded.get("/api/jobs/" + "0" * 32), 404, "not_found")


def test_wrong_token_in_an_address_sets_no_cookie(guarded: httpx.Client) -> None:
    assert "set-cookie" not in guarded.get("/", params={"token": "wrong"}).headers


def test_one_client_leaves_room_for_others(guarded: httpx.Client) -> None:
    ada, eve = (guarded.post, bearer(TOKENS[0])), (guarded.post, bearer(TOKENS[1]))
    files = {"file": ("face.png", picture())}
    portrait_id = guarded.post("/api/portraits", files=files, headers=ada[1]).json()["id"]
    body = {"portrait_id": portrait_id}
    assert guarded.post("/api/jobs", json=body, headers=ada[1]).status_code == 202
    answer = guarded.post("/api/jobs", json=body, headers=ada[1])
    assert "the limit is 1" in refused(answer, 429, "queue_full") and answer.headers["retry-after"] == "30"
    assert guarded.post("/api/jobs", json=body, headers=eve[1]).status_code == 202


@pytest.mark.parametrize(
    ("host", "given", "n_tokens"),
    [
        ("127.0.0.1", None, 0),
        ("localhost", None, 0),
        ("::1", None, 0),
        ("0.0.0.0", None, 1),
        ("0.0.0.0", ["a", "b"], 2),
    ],
)
def test_reachable_server_always_has_a_token(host: str, given: list[str] | None, n_tokens: int) -> None:
    tokens = serve._tokens(argparse.Namespace(host=host, token=given))
    assert len(tokens) == n_tokens and all(len(token) >= 32 or token in (given or ()) for token in tokens)


def test_ids_are_long_and_random(client: httpx.Client) -> None:
    portraits = [upload(client, picture()).json()["id"] for _ in range(3)]
    jobs = [start_job(client, portraits[0]).json()["id"] for _ in range(3)]
    assert len({*portraits, *jobs}) == 6 and all(len(bytes.fromhex(value)) == 16 for value in portraits + jobs)


def test_metrics_count_jobs_and_requests(client: httpx.Client) -> None:
    portrait_id = upload(client, picture()).json()["id"]
    job_id = start_job(client, portrait_id).json()["id"]
    client.delete(f"/api/jobs/{job_id}")
    start_job(client, portrait_id)
    text = client.get("/metrics").text
    assert "vectortalker_jobs_queued 1.0" in text and 'vectortalker_jobs_ended_total{phase="cancelled"} 1.0' in text
    counted = 'vectortalker_request_seconds_count{method="DELETE",route="/api/jobs/{job_id}",status="200"} 1.0'
    assert counted in text and job_id not in text


def test_health_states_what_is_allowed(client: httpx.Client) -> None:
    health = client.get("/api/health").json()
    limits = {"body_bytes": 2_000_000, "queued_jobs": 3, "active_jobs": 50, "retention_hours": 720}
    assert health["limits"] == limits and health["store"] == "sqlite" and health["free_bytes"] > 0


@pytest.fixture
def restored_logging() -> Iterator[None]:
    root, ours = logging.getLogger(), logging.getLogger("vectortalker")
    handlers, levels = root.handlers[:], (root.level, ours.level)
    yield
    root.handlers[:] = handlers
    root.setLevel(levels[0])
    ours.setLevel(levels[1])


@pytest.mark.usefixtures("restored_logging")
def test_logs_are_json_with_the_job_and_without_names(
    services: Services, client: httpx.Client, capsys: pytest.CaptureFixture[str]
) -> None:
    set_up_logs(as_json=True)
    job_id = start_job(client, upload(client, picture(), "grandmother.png").json()["id"]).json()["id"]
    client.delete(f"/api/jobs/{job_id}", params={"token": "hunter2"})
    shown, deadline = "", time.monotonic() + 10
    while '"DELETE"' not in shown and time.monotonic() < deadline:  # the server notes an answer once it is sent
        shown += capsys.readouterr().err
        time.sleep(0.01)
    with about_job("j"):
        logging.getLogger("vectortalker.worker").info("done", extra={"seconds": 2})
    shown += capsys.readouterr().err
    lines = [json.loads(line) for line in shown.splitlines()]
    deleted = next(line for line in lines if line.get("method") == "DELETE")
    assert deleted["job"] == job_id and deleted["status"] == 200 and deleted["ms"] > 0
    assert lines[-1] | {"time": ""} == {
        "time": "", "level": "info", "logger": "vectortalker.worker", "message": "done", "job": "j", "seconds": 2,
    }  # fmt: skip
    assert "grandmother" not in shown and "hunter2" not in shown


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--redis", "http://127.0.0.1"], "no URL of Redis"),
        (["--blobs", "nosuch://bucket"], "cannot hold files"),
        (["--workers", "-1"], "--workers -1"),
    ],
)
def test_option_at_fault_is_named(options: list[str], words: str, tmp_path) -> None:
    command = [str(COMMAND), "serve", "--data", str(tmp_path), *options]
    ended = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert ended.returncode == 2 and words in ended.stderr and ended.stderr.count("\n") == 1


def test_store_that_is_away_is_an_answer(services: Services, listening: Socket) -> None:
    away = RedisStore(f"redis://127.0.0.1:{free_port()}/0")
    listening.app = create_app(replace(services, jobs=type(services.jobs)(away, 3), store=away))
    with httpx.Client(base_url=listening.url, timeout=20) as client:
        refused(client.get("/api/jobs/" + "0" * 32), 503, "unavailable")
        assert client.get("/").status_code == 200
    with pytest.raises(VectorTalkerError, match="does not answer"):
        away.read(["x"])
