"""What is deleted, by its user or when its time is over, and what goes with it."""

from __future__ import annotations

import logging
import time
from typing import get_args

from vectortalker.server import kept, portraits, recordings
from vectortalker.server.run import folder
from vectortalker.server.services import Services

SWEEP_AT_MOST = 100  # of a kind in one go, so that a supervisor has time for its workers

log = logging.getLogger("vectortalker.removal")


def remove_portrait(services: Services, portrait_id: str) -> None:
    """The picture, every job on it with its files, and what the cache has of it. Raises `not_found`."""
    picture = portraits.picture(services.blobs, portrait_id)
    kept.delete(services.store, services.blobs, "portraits", portrait_id)
    services.cache.forget(picture)
    for job_id in services.jobs.of_portrait(portrait_id):
        remove_job(services, job_id)


def remove_recording(services: Services, recording_id: str) -> None:
    """The sound, and every job on it with its files. Raises `not_found`."""
    recordings.describe(services.blobs, recording_id)
    kept.delete(services.store, services.blobs, "recordings", recording_id)
    for job_id in services.jobs.of_portrait(recording_id):
        remove_job(services, job_id)


def remove_job(services: Services, job_id: str) -> None:
    """Its record and its files; work on it is stopped. A worker at it removes the files that it still writes."""
    services.jobs.forget(job_id)
    services.blobs.delete_folder(folder(job_id))


def sweep(services: Services) -> None:
    """Remove what was not used for the time that the settings say."""
    end = time.time() - services.settings.retention_seconds
    for kind in get_args(kept.Kept):
        for name in kept.unused_since(services.store, kind, end)[:SWEEP_AT_MOST]:
            kept.delete(services.store, services.blobs, kind, name)
            log.info("removed at the end of its time", extra={"place": kind})
    for job_id in services.jobs.unchanged_since(end)[:SWEEP_AT_MOST]:
        remove_job(services, job_id)
        log.info("removed at the end of its time", extra={"job": job_id})
    services.cache.drop_unused_since(end)
