"""Whether the server works, for people and for load balancers."""

from __future__ import annotations

from importlib.metadata import version

from fastapi import APIRouter

from vectortalker import schema
from vectortalker.server.routes.access import Has

router = APIRouter(prefix="/api", tags=["health"])


@router.get("/health")
def get_health(has: Has) -> schema.Health:
    return schema.Health(
        version=version("vectortalker"),
        workers=has.jobs.ready_workers(),
        queued=has.jobs.count("queued"),
        running=has.jobs.count("running"),
    )
