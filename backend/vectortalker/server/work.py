"""One job from claim to release, inside a worker process."""

from __future__ import annotations

import logging

from vectortalker.errors import VectorTalkerError
from vectortalker.schema import ApiError
from vectortalker.server.run import Run, StoppedError, folder, this_worker
from vectortalker.server.services import Services
from vectortalker.server.vectorize_job import vectorize_job
from vectortalker.server.video_job import video_job

log = logging.getLogger("vectortalker.worker")

KINDS = {"vectorize": vectorize_job, "video": video_job}


def do_job(services: Services, job_id: str) -> None:
    """Do the job unless it is gone; however it ends, its last snapshot tells."""
    worker = this_worker()
    kind = services.jobs.claim(job_id, worker)
    if kind is None:
        return
    run = Run(services, job_id, worker)
    try:
        KINDS[kind](run)
    except StoppedError:
        if services.jobs.is_unwanted(job_id):
            services.blobs.delete_folder(folder(job_id))
    except VectorTalkerError as error:
        run.report(phase="failed", stage="failed", error=ApiError(code=error.code, message=error.message))
    except Exception as error:  # the border of a worker: a fault of ours fails this job, not the next
        log.exception("job %s failed", job_id)
        message = f"The server failed on this job ({type(error).__name__}): try again, or with other options."
        run.report(phase="failed", stage="failed", error=ApiError(code="internal", message=message))
    finally:
        services.jobs.release(job_id, worker)
