"""One job from claim to release, inside a worker process."""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping

from vectortalker.errors import VectorTalkerError
from vectortalker.schema import ApiError
from vectortalker.server.logs import about_job
from vectortalker.server.record import Kind
from vectortalker.server.run import Run, StoppedError, folder, patiently
from vectortalker.server.services import Services
from vectortalker.server.speech_job import speech_job
from vectortalker.server.vectorize_job import vectorize_job
from vectortalker.server.video_job import video_job

log = logging.getLogger("vectortalker.worker")

KINDS: Mapping[Kind, Callable[[Run], None]] = {
    "vectorize": vectorize_job,
    "video": video_job,
    "speech": speech_job,
}


def do_next(services: Services, worker: str) -> None:
    """Do the job that waits longest, if any; however it ends, its last snapshot tells."""
    job = services.jobs.claim(worker)
    if job is None:
        return
    with about_job(job.id):
        log.info("started", extra={"kind": job.kind, "attempt": job.attempts})
        _do(Run(services, job.id, worker), KINDS[job.kind])


def _do(run: Run, work: Callable[[Run], None]) -> None:
    jobs, job_id = run.services.jobs, run.job_id
    try:
        work(run)
    except StoppedError:
        log.info("stopped")
    except VectorTalkerError as error:
        log.info("refused", extra={"code": error.code})
        run.report(phase="failed", stage="failed", error=ApiError(code=error.code, message=error.message))
    except Exception as error:  # the border of a worker: a fault of ours fails this job, not the next
        log.exception("failed")
        message = f"The server failed on this job ({type(error).__name__}): try again, or with other options."
        run.report(phase="failed", stage="failed", error=ApiError(code="internal", message=message))
    else:
        log.info("done")
    if patiently(lambda: jobs.is_unwanted(job_id)):
        run.services.blobs.delete_folder(folder(job_id))
    patiently(lambda: jobs.release(job_id, run.worker))
