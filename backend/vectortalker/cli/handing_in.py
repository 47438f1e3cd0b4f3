"""Pictures are handed in as jobs and their results taken away, whoever works on them."""

from __future__ import annotations

import os
import socket
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from vectortalker.cli.inputs import read_file
from vectortalker.cli.tracing import Traced
from vectortalker.decode import Limits
from vectortalker.errors import VectorTalkerError
from vectortalker.schema import JobRequest, Scene, VectorizeOptions
from vectortalker.server import portraits
from vectortalker.server.removal import remove_portrait
from vectortalker.server.run import folder, patiently
from vectortalker.server.services import Services
from vectortalker.server.submit import submit_portrait
from vectortalker.vectorize import Result

POLL_SECONDS = 0.1


@dataclass(frozen=True)
class _HandedIn:
    path: Path
    portrait_id: str
    job_id: str


def hand_in(
    services: Services, pictures: list[Path], options: VectorizeOptions
) -> Iterator[tuple[Path, Traced | VectorTalkerError]]:
    """What became of each picture, in the order in which they are ready; nothing is left behind at the workers."""
    client = f"batch:{socket.gethostname()}-{os.getpid()}"
    waiting, handed_in = list(reversed(pictures)), list[_HandedIn]()
    try:
        while waiting or handed_in:
            path = waiting[-1] if waiting else None
            entered = _enter(services, client, path, options) if path else None
            if entered is not None:
                waiting.pop()
            if isinstance(entered, _HandedIn):
                handed_in.append(entered)
                continue
            if path and entered is not None:
                yield path, entered
            for job in _ended(services, handed_in):
                outcome = _outcome(services, job)
                _clear(services, job)
                handed_in.remove(job)
                yield job.path, outcome
            time.sleep(POLL_SECONDS)
    finally:
        for job in handed_in:
            _clear(services, job)


def _enter(
    services: Services, client: str, path: Path, options: VectorizeOptions
) -> _HandedIn | VectorTalkerError | None:
    """A job on the picture, or why there is none; None if there is no room just now."""
    try:
        data = read_file(path, "bad_picture", Limits().max_bytes)
        portrait = patiently(lambda: portraits.add(services.store, services.blobs, data, path.name))
    except VectorTalkerError as error:
        return error
    request = JobRequest(portrait_id=portrait.id, find_face=True, options=options)
    try:
        job = patiently(lambda: submit_portrait(services, client, request))
    except VectorTalkerError as error:
        remove_portrait(services, portrait.id)
        return None if error.code == "queue_full" else error
    return _HandedIn(path, portrait.id, job.id)


def _ended(services: Services, handed_in: list[_HandedIn]) -> list[_HandedIn]:
    ended = set(patiently(lambda: services.jobs.ended_of([job.job_id for job in handed_in])))
    return [job for job in handed_in if job.job_id in ended]


def _outcome(services: Services, job: _HandedIn) -> Traced | VectorTalkerError:
    state = patiently(lambda: services.jobs.get(job.job_id))
    metrics = state.metrics
    if state.phase != "done" or metrics is None:
        reason = state.error.message if state.error else f"The job was {state.phase}."
        return VectorTalkerError(state.error.code if state.error else "cancelled", f"{job.path.name}: {reason}")
    faces = portraits.faces(services.blobs, job.portrait_id).faces
    scene = Scene.model_validate_json(services.blobs.get(f"{folder(job.job_id)}/scene.json"))
    svg = services.blobs.get(f"{folder(job.job_id)}/portrait.svg").decode()
    portrait = portraits.load(services.blobs, job.portrait_id)
    landmarks = faces[0].landmarks if faces else None
    return Traced(portrait, landmarks, Result(scene, svg, lambda: metrics))


def _clear(services: Services, job: _HandedIn) -> None:
    patiently(lambda: remove_portrait(services, job.portrait_id))
