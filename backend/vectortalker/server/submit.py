"""A request becomes a queued job: first what it asks for, then its row, then its place in the queue."""

from __future__ import annotations

import secrets

from pydantic import BaseModel

from vectortalker.schema import JobState
from vectortalker.server.jobs import Kind
from vectortalker.server.run import folder
from vectortalker.server.services import Services


def submit(services: Services, kind: Kind, portrait_id: str | None, request: BaseModel) -> JobState:
    """Raises `queue_full` or `storage_full`. A crash between the steps loses nothing that was answered."""
    job_id = secrets.token_hex(16)
    services.jobs.check_room(services.settings.max_queued)
    services.blobs.put(f"{folder(job_id)}/request.json", request.model_dump_json().encode())
    state = services.jobs.create(job_id, kind, portrait_id)
    services.enqueue(job_id)
    return state
