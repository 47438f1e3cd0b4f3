"""What routes, workers and supervisors share: settings, blobs, the jobs table and the queue in front of it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from huey import Huey, SqliteHuey

from vectortalker.server.blobs import Blobs
from vectortalker.server.jobs import Jobs
from vectortalker.server.settings import Settings


@dataclass(frozen=True)
class Services:
    """`enqueue` puts a job of the table into the queue; twice is harmless, for it can be claimed only once."""

    settings: Settings
    blobs: Blobs
    jobs: Jobs
    queue: Huey
    enqueue: Callable[[str], object]


def open_services(settings: Settings) -> Services:
    blobs = Blobs(settings.data / "blobs", settings.min_free_bytes)
    jobs = Jobs(settings.data / "jobs.sqlite")
    queue = SqliteHuey("vectortalker", results=False, filename=str(settings.data / "queue.sqlite"))

    @queue.task(name="run_job")
    def run_job(job_id: str) -> None:
        from vectortalker.server.work import do_job  # imports torch: seconds that only a worker has to spend

        do_job(services, job_id)

    services = Services(settings, blobs, jobs, queue, run_job)
    return services
