"""A portrait becomes a scene, level by level; what is reached is stored so that a new worker can go on from there."""

from __future__ import annotations

import io
import json
from collections.abc import Generator

import numpy as np

from vectortalker.schema import JobRequest, Scene
from vectortalker.server import portraits
from vectortalker.server.run import Run
from vectortalker.vectorize import Checkpoint, Progress, Result, vectorize

HEADER = "header"  # name of the array that holds what a checkpoint has beside its arrays


def vectorize_job(run: Run) -> None:
    """Raises `StoppedError` at the first step after a cancel."""
    request = JobRequest.model_validate_json(run.services.blobs.get(run.key("request.json")))
    steps = vectorize(
        portraits.load(run.services.blobs, request.portrait_id),
        request.landmarks,
        request.options,
        finish_early=run.wants_finish,
        resume=_read_checkpoint(run.services.blobs.find(run.key("checkpoint.npz"))),
    )
    result, scene_revision = _follow(run, steps)
    _store_scene(run, result.scene)
    run.services.blobs.delete(run.key("checkpoint.npz"))
    run.report(
        phase="done",
        stage="done",
        progress=1,
        remaining_seconds=0,
        n_paths=result.metrics.paths,
        scene_revision=scene_revision + 1,
        metrics=result.metrics,
    )


def _follow(run: Run, steps: Generator[Progress, None, Result]) -> tuple[Result, int]:
    """Pass every progress on; the result and the revision of the last scene stored."""
    scene_revision = run.services.jobs.get(run.job_id).scene_revision
    while True:
        try:
            progress = next(steps)
        except StopIteration as end:
            return end.value, scene_revision
        run.wants_finish()
        if progress.scene is not None:
            _store_scene(run, progress.scene)
            scene_revision += 1
        if progress.checkpoint is not None:
            run.services.blobs.put(run.key("checkpoint.npz"), _write_checkpoint(progress.checkpoint))
        run.report_fraction(
            progress.fraction,
            stage=progress.stage,
            level=progress.level,
            levels=progress.levels,
            n_paths=progress.n_paths,
            scene_revision=scene_revision,
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
