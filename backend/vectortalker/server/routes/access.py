"""What routes are given: the services of the running app, whose request it is, well-formed ids, and files of jobs."""

from __future__ import annotations

from typing import Annotated

from fastapi import Depends, Path, Request

from vectortalker.errors import VectorTalkerError
from vectortalker.server.run import folder
from vectortalker.server.services import Services

Id = Annotated[str, Path(pattern="^[0-9a-f]{32}$")]


def _services(request: Request) -> Services:
    return request.app.state.services


Has = Annotated[Services, Depends(_services)]


def _client(request: Request) -> str:
    return request.state.client


def job_file(has: Services, job_id: str, name: str, absent: str) -> bytes:
    """A result of a job. Raises `not_found`, in the words of `absent` while it is not there yet."""
    has.jobs.get(job_id)
    data = has.blobs.find(f"{folder(job_id)}/{name}")
    if data is None:
        raise VectorTalkerError("not_found", absent)
    return data


Client = Annotated[str, Depends(_client)]
