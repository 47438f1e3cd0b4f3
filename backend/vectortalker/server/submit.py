"""A request becomes a queued job: first what it asks for, then its record, then a call to the workers."""

from __future__ import annotations

import secrets

from pydantic import BaseModel

from vectortalker.schema import JobRequest, JobState
from vectortalker.server import kept, portraits
from vectortalker.server.record import Kind
from vectortalker.server.run import folder
from vectortalker.server.services import Services


def submit(services: Services, client: str, kind: Kind, portrait_id: str | None, request: BaseModel) -> JobState:
    """Raises `queue_full` or `storage_full`. A crash between the steps loses nothing that was answered."""
    job_id = secrets.token_hex(16)
    services.jobs.check_room(client, services.settings.max_queued, services.settings.max_active)
    services.blobs.put(f"{folder(job_id)}/request.json", request.model_dump_json().encode())
    state = services.jobs.create(job_id, kind, portrait_id, client)
    services.wake()
    return state


def submit_portrait(services: Services, client: str, request: JobRequest) -> JobState:
    """A job that vectorises a portrait; it is done at once if the result is known. Raises `not_found` as well."""
    kept.note_use(services.store, "portraits", portraits.describe(services.blobs, request.portrait_id).id)
    known = services.cache.find(portraits.picture(services.blobs, request.portrait_id), request)
    if known is None:
        return submit(services, client, "vectorize", request.portrait_id, request)
    job_id = secrets.token_hex(16)
    services.blobs.put(f"{folder(job_id)}/scene.json", known.scene.encode())
    services.blobs.put(f"{folder(job_id)}/portrait.svg", known.svg.encode())
    return services.jobs.create_done(
        job_id,
        "vectorize",
        request.portrait_id,
        client,
        level=known.levels,
        levels=known.levels,
        n_paths=known.metrics.paths,
        scene_revision=1,
        metrics=known.metrics,
    )
