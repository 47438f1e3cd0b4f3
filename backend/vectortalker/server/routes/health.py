"""Whether the server works, for people and for load balancers."""

from __future__ import annotations

from importlib.metadata import version

from fastapi import APIRouter

from vectortalker import schema
from vectortalker.server.routes.access import Has

HOUR_SECONDS = 3600

router = APIRouter(prefix="/api", tags=["health"])


@router.get("/health")
def get_health(has: Has) -> schema.Health:
    settings = has.settings
    return schema.Health(
        version=version("vectortalker"),
        workers=has.jobs.ready_workers(),
        queued=has.jobs.count("queued"),
        running=has.jobs.count("running"),
        store="redis" if settings.redis else "sqlite",
        free_bytes=has.blobs.free_bytes(),
        limits=schema.Limits(
            body_bytes=settings.max_body_bytes,
            queued_jobs=settings.max_queued,
            active_jobs=settings.max_active,
            retention_hours=settings.retention_seconds / HOUR_SECONDS,
        ),
    )
