"""What routes, workers and supervisors share: settings, store, blobs, jobs, cache, and the queue that wakes workers."""

from __future__ import annotations

import logging
import sqlite3
from collections.abc import Callable
from dataclasses import dataclass

import redis
from huey import Huey, RedisHuey, SqliteHuey

from vectortalker.errors import VectorTalkerError
from vectortalker.segmenter import Segmenter, open_segmenter
from vectortalker.server.blobs import Blobs
from vectortalker.server.cache import Cache
from vectortalker.server.database import translated
from vectortalker.server.jobs import Jobs
from vectortalker.server.redis_store import RedisStore
from vectortalker.server.settings import Settings
from vectortalker.server.sqlite_store import SqliteStore
from vectortalker.server.store import Store

QUEUE = "vectortalker"
log = logging.getLogger("vectortalker.server")


@dataclass(frozen=True)
class Services:
    """`wake` tells some idle worker that a job waits; once too often is harmless, too seldom costs two seconds."""

    settings: Settings
    store: Store
    blobs: Blobs
    jobs: Jobs
    cache: Cache
    queue: Huey
    wake: Callable[[], object]
    segmenter: Segmenter | None = None

    def close(self) -> None:
        self.store.close()


def open_services(settings: Settings) -> Services:
    """Raises `bad_option` for URLs and models that are none, `unavailable` and `storage_full`."""
    store, queue = _shared(settings.redis) if settings.redis else _embedded(settings)
    blobs = Blobs(settings.blobs or str(settings.data / "blobs"), settings.min_free_bytes)
    jobs = Jobs(store, settings.max_attempts)
    segmenter = open_segmenter(settings.segmentation_model) if settings.segmentation_model else None
    cache = Cache(store, blobs, settings.max_cache_bytes, segmenter.digest if segmenter else "")

    @queue.task(name="a_job_waits")
    def call() -> None:
        """No work: the worker that takes it off the queue asks the store which job is next."""

    def wake() -> None:
        try:
            call()
        except (sqlite3.Error, redis.RedisError) as error:  # the job is stored, and workers look by themselves too
            log.warning("no worker could be called: %s", error)

    return Services(settings, store, blobs, jobs, cache, queue, wake, segmenter)


def _embedded(settings: Settings) -> tuple[Store, Huey]:
    store = SqliteStore(settings.data / "state.sqlite")
    with translated():
        return store, SqliteHuey(QUEUE, results=False, filename=str(settings.data / "queue.sqlite"))


def _shared(url: str) -> tuple[Store, Huey]:
    try:
        return RedisStore(url), RedisHuey(QUEUE, results=False, url=url)
    except ValueError as error:
        raise VectorTalkerError("bad_option", f"{url} is no URL of Redis: give redis://HOST:PORT/NUMBER.") from error
