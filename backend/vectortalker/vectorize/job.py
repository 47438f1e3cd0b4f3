"""A portrait and its landmarks become a layered scene, its SVG and its scores, with reports on the way."""

from __future__ import annotations

import time
from collections.abc import Callable, Generator
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from vectortalker import metrics
from vectortalker.decode import Portrait, canonical
from vectortalker.scene import LayeredScene, to_wire
from vectortalker.schema import Fill, Landmarks, Metrics, Scene, VectorizeOptions
from vectortalker.segmenter import Segmenter
from vectortalker.svg import to_svg
from vectortalker.vectorize.covers import with_covers
from vectortalker.vectorize.frame import Frame, fit, layer_to_portrait
from vectortalker.vectorize.ground import with_ground
from vectortalker.vectorize.level import BACK, FIRST_LOCAL, FORE, TOP
from vectortalker.vectorize.optimise import Start, Step, optimise
from vectortalker.vectorize.options import Settings, resolve
from vectortalker.vectorize.population import Population, take
from vectortalker.vectorize.progress import Checkpoint, Progress, Result
from vectortalker.vectorize.resume import checkpoint, restore
from vectortalker.vectorize.schedule import LevelPlan, plan
from vectortalker.vectorize.targets import Targets, prepare

PREPARED = 0.05  # share of the time spent before the first level
OPTIMISED = 0.97  # up to the end of the last level …
WRITTEN = 0.98  # … and to the finished SVG
STOP_PARAMETERS, AXIS_PARAMETERS = 4, 4  # colour and opacity; both ends


def vectorize(
    portrait: Portrait,
    landmarks: Landmarks | None,
    options: VectorizeOptions,
    *,
    finish_early: Callable[[], bool] = lambda: False,
    resume: Checkpoint | None = None,
    threads: int = 0,
    segmenter: Segmenter | None = None,
) -> Generator[Progress, None, Result]:
    """Vectorise level by level; closing the generator stops the work within a tenth of a second.

    `finish_early` is asked at every report: true ends the optimisation where it is. `resume` continues after the level
    it was taken at and must come from the same portrait and options (`VectorTalkerError` `bad_option` otherwise).
    `threads` 0 uses all cores; the result does not depend on it. `segmenter`: a net of the user's own finds the person.
    """
    clock, cpu_clock = time.perf_counter(), time.process_time()
    settings = resolve(options)
    picture = canonical(portrait, settings.working_size)
    frame = fit(portrait.width, portrait.height, picture.shape[1], picture.shape[0])
    plans = plan(settings, (frame.width, frame.height))
    yield Progress("preparing", 0, settings.levels, 0, 0.0)
    targets = prepare(portrait, landmarks, picture, frame, settings, plans, segmenter)
    if targets.layers is not None:
        plans = [replace(level_plan, paths=max(1, level_plan.paths - _n_given(targets))) for level_plan in plans]
    start = restore(resume, settings) if resume else Start(targets.first_paths, 0, 0)
    run = optimise(targets.level, plans, settings, start, threads, finish_early)
    while True:
        try:
            step = next(run)
        except StopIteration as end:
            last: Step = end.value
            break
        yield _report(step, plans, settings, frame, portrait, targets)
    scene = compose(last.population, plans[last.level_index].frame, frame, portrait, targets)
    svg = to_svg(scene, targets.openings, portrait.name, (frame.width, frame.height))
    yield Progress("measuring", last.level_index + 1, settings.levels, _n_paths(last, targets), WRITTEN, lambda: scene)
    elapsed = time.perf_counter() - clock, time.process_time() - cpu_clock
    return Result(scene, svg, lambda: _measure(scene, svg, picture, last.iteration, elapsed))


def compose(
    population: Population, level: tuple[int, int], frame: Frame, portrait: Portrait, targets: Targets
) -> Scene:
    """The population of a level of (width, height) px as a scene in portrait px; with layers, on a ground."""
    layers = (population.layer(*groups) for groups in ((BACK, FORE), (FORE, FIRST_LOCAL), (FIRST_LOCAL, TOP)))
    back, fore, local = (layer_to_portrait(layer, frame, level) for layer in layers)
    if targets.layers is not None:
        back = with_ground(back, targets.canvas, portrait.width, portrait.height)
        local = with_covers(local, targets.floor)
    return to_wire(LayeredScene(portrait.width, portrait.height, targets.canvas, back, fore, local))


def _n_paths(step: Step, targets: Targets) -> int:
    return len(step.population) + _n_given(targets)


def _n_given(targets: Targets) -> int:
    """Paths that are added after the fit: the ground, and the floor of a smile."""
    return 0 if targets.layers is None else 1 + len(targets.floor)


def _report(
    step: Step,
    plans: list[LevelPlan],
    settings: Settings,
    frame: Frame,
    portrait: Portrait,
    targets: Targets,
) -> Progress:
    total = sum(level.iterations for level in plans)
    return Progress(
        stage=f"level {step.level_index + 1} of {settings.levels}",
        level=step.level_index + 1,
        levels=settings.levels,
        n_paths=_n_paths(step, targets),
        fraction=PREPARED + (OPTIMISED - PREPARED) * step.iteration / total,
        compose=_later(step, plans, frame, portrait, targets) if step.picture else None,
        checkpoint=checkpoint(step, settings) if step.level_done else None,
    )


def _later(
    step: Step, plans: list[LevelPlan], frame: Frame, portrait: Portrait, targets: Targets
) -> Callable[[], Scene]:
    """Composes the step's scene when it is called, wherever its paths have moved by then."""
    paths = take(step.population, np.arange(len(step.population)))
    return partial(compose, paths, plans[step.level_index].frame, frame, portrait, targets)


def _measure(
    scene: Scene,
    svg: str,
    picture: NDArray[np.uint8],
    iterations: int,
    elapsed: tuple[float, float],
) -> Metrics:
    painted = metrics.render(svg, picture.shape[1], picture.shape[0])
    squared_error = metrics.mse(painted, picture)
    size, gzip_size = metrics.file_sizes(svg)
    paths = [*scene.back, *scene.fore, *scene.local]
    return Metrics(
        paths=len(paths),
        segments=sum(len(path.points) // 6 for path in paths),
        parameters=sum(len(path.points) + _fill_parameters(path.fill) for path in paths),
        iterations=iterations,
        seconds=elapsed[0],
        cpu_seconds=elapsed[1],
        bytes=size,
        gzip_bytes=gzip_size,
        mse=squared_error,
        psnr=metrics.psnr(squared_error),
        ssim=metrics.ssim(painted, picture),
    )


def _fill_parameters(fill: Fill) -> int:
    return STOP_PARAMETERS if fill.kind == "solid" else AXIS_PARAMETERS + STOP_PARAMETERS * len(fill.stops)
