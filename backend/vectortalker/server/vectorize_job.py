"""A portrait becomes a scene, level by level; what is reached is stored so that a new worker can go on from there."""

from __future__ import annotations

import io
import json
from collections.abc import Generator
from dataclasses import dataclass

import numpy as np

from vectortalker.schema import JobRequest, Landmarks, Scene
from vectortalker.server import portraits
from vectortalker.server.cache import CachedResult
from vectortalker.server.run import Run
from vectortalker.vectorize import Checkpoint, Progress, Result, vectorize

HEADER = "header"  # name of the array that holds what a checkpoint has beside its arrays


def vectorize_job(run: Run) -> None:
    """Raises `StoppedError` at the first step after a cancel."""
    request = JobRequest.model_validate_json(run.services.blobs.get(run.key("request.json")))
    steps = vectorize(
        portraits.load(run.services.blobs, request.portrait_id),
        _landmarks(run, request),
        request.options,
        finish_early=run.wants_finish,
        resume=_read_checkpoint(run.services.blobs.find(run.key("checkpoint.npz"))),
        segmenter=run.services.segmenter,
    )
    result, last = _follow(run, steps)
    _store_scene(run, result.scene)
    run.services.blobs.put(run.key("portrait.svg"), result.svg.encode())
    run.services.blobs.delete(run.key("checkpoint.npz"))
    if not run.wants_finish():
        _remember(run, request, result, last.levels)
    run.report(
        phase="done",
        stage="done",
        progress=1,
        remaining_seconds=0,
        n_paths=result.metrics.paths,
        scene_revision=last.scene_revision + 1,
        metrics=result.metrics,
    )


def _landmarks(run: Run, request: JobRequest) -> Landmarks | None:
    """Those of the request, else of the largest face if the request leaves it to the server to find one."""
    if request.landmarks is not None or not request.find_face:
        return request.landmarks
    faces = portraits.faces(run.services.blobs, request.portrait_id).faces
    return faces[0].landmarks if faces else None


def _remember(run: Run, request: JobRequest, result: Result, levels: int) -> None:
    """For the next who asks the same, unless the portrait was deleted meanwhile."""
    picture = portraits.picture(run.services.blobs, request.portrait_id)
    known = CachedResult(scene=result.scene.model_dump_json(), svg=result.svg, metrics=result.metrics, levels=levels)
    run.services.cache.add(picture, request, known)
    if run.services.jobs.is_unwanted(run.job_id):
        run.services.cache.forget(picture)


@dataclass(frozen=True)
class _Reached:
    """The revision of the last scene stored, and the levels of the whole."""

    scene_revision: int
    levels: int


def _follow(run: Run, steps: Generator[Progress, None, Result]) -> tuple[Result, _Reached]:
    """Pass every progress on until the result is there."""
    reached = _Reached(run.services.jobs.get(run.job_id).scene_revision, 0)
    while True:
        try:
            progress = next(steps)
        except StopIteration as end:
            return end.value, reached
        run.wants_finish()
        if progress.scene is not None:
            _store_scene(run, progress.scene)
        if progress.checkpoint is not None:
            run.services.blobs.put(run.key("checkpoint.npz"), _write_checkpoint(progress.checkpoint))
            run.got_on()
        reached = _Reached(reached.scene_revision + (progress.scene is not None), progress.levels)
        run.report_fraction(
            progress.fraction,
            stage=progress.stage,
            level=progress.level,
            levels=progress.levels,
            n_paths=progress.n_paths,
            scene_revision=reached.scene_revision,
        )


def _store_scene(run: Run, scene: Scene) -> None:
    run.services.blobs.put(run.key("scene.json"), scene.model_dump_json().encode())


def _write_checkpoint(checkpoint: Checkpoint) -> bytes:
    header = {"level": checkpoint.level, "iterations": checkpoint.iterations, "settings": checkpoint.settings}
    file = io.BytesIO()
    np.savez(file, allow_pickle=False, **{HEADER: np.array(json.dumps(header)), **checkpoint.arrays})
    return file.getvalue()


def _read_checkpoint(data: bytes | None) -> Checkpoint | None:
    if data is None:
        return None
    with np.load(io.BytesIO(data), allow_pickle=False) as file:
        header = json.loads(str(file[HEADER]))
        return Checkpoint(**header, arrays={name: file[name] for name in file.files if name != HEADER})
