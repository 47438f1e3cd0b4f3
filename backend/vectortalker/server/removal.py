"""What is deleted, by its user or when its time is over, and what goes with it."""

from __future__ import annotations

import logging
import time

from vectortalker.server import portraits, recordings
from vectortalker.server.run import folder
from vectortalker.server.services import Services

SWEEP_AT_MOST = 100  # of a kind in one go, so that a supervisor has time for its workers

log = logging.getLogger("vectortalker.removal")


def remove_portrait(services: Services, portrait_id: str) -> None:
    """The picture, every job on it with its files, and what the cache has of it. Raises `not_found`."""
    picture = portraits.picture(services.blobs, portrait_id)
    portraits.delete(services.store, services.blobs, portrait_id)
    services.cache.forget(picture)
    for job_id in services.jobs.of_portrait(portrait_id):
        remove_job(services, job_id)


def remove_recording(services: Services, recording_id: str) -> None:
    """The sound, and every job on it with its files. Raises `not_found`."""
    recordings.describe(services.blobs, recording_id)
    recordings.delete(services.store, services.blobs, recording_id)
    for job_id in services.jobs.of_portrait(recording_id):
        remove_job(services, job_id)


def remove_job(services: Services, job_id: str) -> None:
    """Its record and its files; work on it is stopped. A worker at it removes the files that it still writes."""
    services.jobs.forget(job_id)
    services.blobs.delete_folder(folder(job_id))


def sweep(services: Services) -> None:
    """Remove what was not used for the time that the settings say."""
    end = time.time() - services.settings.retention_seconds
    for portrait_id in portraits.unused_since(services.store, end)[:SWEEP_AT_MOST]:
        portraits.delete(services.store, services.blobs, portrait_id)
        log.info("a portrait was removed at the end of its time")
    for recording_id in recordings.unused_since(services.store, end)[:SWEEP_AT_MOST]:
        recordings.delete(services.store, services.blobs, recording_id)
        log.info("a recording was removed at the end of its time")
    for job_id in services.jobs.unchanged_since(end)[:SWEEP_AT_MOST]:
        remove_job(services, job_id)
        log.info("removed at the end of its time", extra={"job": job_id})
    services.cache.drop_unused_since(end)
