"""Requests made from the OpenAPI document: each is answered as the document says, and every refusal has its form."""

from __future__ import annotations

import json
from fnmatch import fnmatch
from typing import Any

import pytest
import schemathesis
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from schemathesis import GenerationMode, Response
from schemathesis.checks import negative_data_rejection, not_a_server_error, unsupported_method
from schemathesis.schemas import APIOperation, BaseSchema
from vectortalker import schema
from vectortalker.schema import Project
from vectortalker.server.app import create_app
from vectortalker.server.services import Services

from .conftest import Socket
from .pictures import face_points, picture
from .test_keeping import METRICS
from .test_speech import BLOCKS, tone

EXAMPLES = {GenerationMode.POSITIVE: 2, GenerationMode.NEGATIVE: 1}  # an operation
ASIDE = "/api/recordings/spoken"  # needs espeak-ng; tests of speech have it
TRACK = {"schema_version": 1, "duration": 0.4, "fps": 10, "articulators": {"jaw": [0, 0.5, 1, 0.5]}}
LANDMARKS = {"points": face_points(48, 64)}
SCENE = {"width": 96, "height": 128, "canvas": "#ffffff", "back": [], "fore": [], "local": []}
Document = BaseSchema


@pytest.fixture
def document(services: Services, listening: Socket) -> Document:
    listening.app = create_app(services)
    return schemathesis.openapi.from_url(f"{listening.url}/api/openapi.json")


def operations(document: Document) -> list[APIOperation]:
    return [found.ok() for found in document.get_all_operations()]


def check_answer(document: Document, operation: APIOperation, answer: Response) -> None:
    """Status, media type and body are documented; what is given as JSON is an instance of the model that is named."""
    documented = document.raw_schema["paths"][operation.path][operation.method]["responses"]
    response = documented.get(str(answer.status_code), documented["default"] if answer.status_code >= 400 else None)
    assert response is not None, f"{operation.label}: {answer.status_code} is not documented"
    content = response.get("content")
    if content is None:
        assert answer.content == b""
        return
    kind = answer.headers["content-type"][0].partition(";")[0]
    (described,) = (content[pattern] for pattern in content if fnmatch(kind, pattern))
    reference = described.get("schema", {}).get("$ref")
    if reference:
        getattr(schema, reference.rpartition("/")[2]).model_validate_json(answer.content)


@pytest.mark.parametrize("mode", EXAMPLES, ids=lambda mode: mode.name.lower())
def test_requests_of_the_document_are_answered(document: Document, mode: GenerationMode) -> None:
    """Where they keep to it, and where they break it; those that break it are refused."""
    assert len(operations(document)) > 10
    for operation in operations(document):
        if mode is GenerationMode.POSITIVE or "parameters" in operation.definition.raw or operation.body:
            _try(document, operation, operation.as_strategy(generation_mode=mode), EXAMPLES[mode])


def _try(document: Document, operation: APIOperation, cases: st.SearchStrategy, n_examples: int) -> None:
    @settings(max_examples=n_examples, deadline=None, database=None, suppress_health_check=list(HealthCheck))
    @given(cases)
    def is_answered(case: schemathesis.Case) -> None:
        answer = case.call()
        case.validate_response(answer, checks=[not_a_server_error, negative_data_rejection, unsupported_method])
        check_answer(document, operation, answer)

    is_answered()


def test_every_operation_succeeds_as_documented(document: Document, services: Services) -> None:
    """On a picture, a sound, and jobs that are done; deletions last, jobs before what they worked on."""
    left = {operation.label: operation for operation in operations(document) if operation.path != ASIDE}
    ids = dict[str, str]()

    def ask(label: str, body: dict[str, Any] | bytes | None = None, **path: str) -> Any:
        operation = left.pop(label)
        content: dict[str, Any] = {}
        if isinstance(body, bytes):
            content = {"body": {"file": body}, "media_type": "multipart/form-data"}
        elif body is not None:
            content = {"body": body, "media_type": "application/json"}
        answer = operation.Case(path_parameters=path, **content).call()
        assert answer.status_code < 300, (label, answer.text)
        check_answer(document, operation, answer)
        is_json = answer.content and answer.headers["content-type"] == ["application/json"]
        return answer.json() if is_json else None

    ids["portrait_id"] = ask("POST /api/portraits", picture())["id"]
    ids["recording_id"] = ask("POST /api/recordings", tone())["id"]
    started = {
        "vectorize": ask("POST /api/jobs", {"portrait_id": ids["portrait_id"]}),
        "speech": ask("POST /api/speech", {"recording_id": ids["recording_id"]}),
        "video": ask("POST /api/videos", {"scene": SCENE, "landmarks": LANDMARKS, "track": TRACK}),
    }
    formed = ask("POST /api/tracks/visemes", {"visemes": BLOCKS, "duration": 1.0})
    _finish(services, {kind: job["id"] for kind, job in started.items()}, formed)
    ask("POST /api/tracks/import", json.dumps(TRACK).encode())
    ask("POST /api/tracks/export", {"track": TRACK, "format": "json"})
    ask("GET /api/health")
    for kind, label in (("speech", "GET /api/speech/{job_id}/result"), ("video", "GET /api/videos/{job_id}/file")):
        ask(label, job_id=started[kind]["id"])
    job_id = started["vectorize"]["id"]
    for label in sorted(left, key=lambda label: (label.startswith("DELETE"), "/jobs/" not in label)):
        names = [name for name in (*ids, "job_id") if f"{{{name}}}" in label]
        ask(label, **{name: {**ids, "job_id": job_id}[name] for name in names})
    assert not left


def _finish(services: Services, job_ids: dict[str, str], track: dict[str, Any]) -> None:
    """As a worker does, with the smallest results."""
    scene = Project.model_validate({"name": "", "scene": SCENE, "landmarks": None}).scene
    heard = schema.SpeechResult.model_validate({"track": track, "visemes": BLOCKS, "loudness": [], "tier": "audio"})
    results = {
        "vectorize": {"scene.json": scene.model_dump_json(), "portrait.svg": "<svg/>"},
        "speech": {"speech.json": heard.model_dump_json(exclude_none=True)},
        "video": {"video": "frames"},
    }
    while (job := services.jobs.claim("worker")) is not None:
        assert job.id == job_ids[job.kind]
        for name, text in results[job.kind].items():
            services.blobs.put(f"jobs/{job.id}/{name}", text.encode())
        services.jobs.report(job.id, "worker", phase="done", stage="done", progress=1, metrics=METRICS)
        services.jobs.release(job.id, "worker")
