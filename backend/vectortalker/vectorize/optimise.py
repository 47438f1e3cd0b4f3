"""Levels and a plan become an optimised population, one report at a time."""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterator
from concurrent.futures import Executor, Future, ThreadPoolExecutor, wait
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from vectortalker.vectorize.level import FIRST_LOCAL, LID, Level
from vectortalker.vectorize.losses import EVERY_BAND, FLATNESS, Aside, Fidelity, complete_local, detach_fore, evaluate
from vectortalker.vectorize.options import Settings
from vectortalker.vectorize.painted import compensate
from vectortalker.vectorize.population import Population, move, rescale, take
from vectortalker.vectorize.schedule import LEAST_RADIUS, RECIPES, Ingredients, LevelPlan, corrections, decay
from vectortalker.vectorize.seeding import seed

REPORT_EVERY = 10  # iterations; a cancelled job stops within a tenth of a second
PICTURE_EVERY = 200  # iterations between scenes worth showing
REALLOCATE_EVERY = 50
LEAST_IMPORTANCE = 0.25  # paths under this share of the mean importance are moved …
MOST_MOVED = 0.08  # … at most this share of all at a time
LOCAL_KEPT = 0.1  # share of all paths up to which local ones are left alone
REALLOCATED_RADIUS = 0.8  # of the level's
COARSE_FLATNESS = 0.2  # px that a chord may stray before the polish
ASIDE_EVERY = 2  # iterations between passes over single layers; their weight makes up for those left out


@dataclass(frozen=True)
class Start:
    """Where to begin: `population` in the pixels of the last of `levels` finished levels, `iterations` spent."""

    population: Population
    levels: int
    iterations: int


@dataclass(frozen=True)
class Step:
    """Where the optimiser is. `picture`: worth showing; `level_done`: a whole level has been finished."""

    population: Population
    level_index: int
    iteration: int
    picture: bool
    level_done: bool


def optimise(
    level_at: Callable[[int, LevelPlan], Level],
    plans: list[LevelPlan],
    settings: Settings,
    start: Start,
    threads: int,
    finish_early: Callable[[], bool],
) -> Generator[Step, None, Step]:
    """Run the levels after `start` and return the last step; `level_at` makes a level's targets, one level ahead."""
    ingredients = RECIPES[settings.recipe]
    total = sum(level_plan.iterations for level_plan in plans)
    population, done = start.population, start.iterations
    step = Step(population, start.levels, done, picture=False, level_done=False)
    with ThreadPoolExecutor(1) as beside:
        for index, level in enumerate(_one_ahead(level_at, plans, start.levels, threads, beside), start.levels):
            level_plan, last = plans[index], index == len(plans) - 1
            generator = np.random.default_rng((settings.seed, index))
            if index:
                population = rescale(population, plans[index - 1].frame, level_plan.frame)
            missing = max(0, level_plan.paths - len(population))
            gradient, fidelity = settings.fills == "gradient", Fidelity(threads=threads)
            population = seed(population, level, missing, level_plan.radius, ingredients, gradient, fidelity, generator)
            yield Step(population, index, done, picture=index > 0, level_done=False)
            fitted = level
            corrected_at = corrections(ingredients, level_plan)
            for i in range(1, level_plan.iterations + 1):
                rate = decay(done, total, ingredients.decay_from)
                iteration = _iteration(ingredients, i, rate, level_plan, last, threads)
                if last and i in corrected_at:
                    fitted = compensate(level, population, iteration.fidelity)
                population = _iterate(population, fitted, settings, iteration, generator, beside)
                done += 1
                if i % REPORT_EVERY == 0 or i == level_plan.iterations:
                    finished = i == level_plan.iterations
                    step = Step(population, index, done, finished or i % PICTURE_EVERY == 0, finished)
                    yield step
                    if finish_early():
                        return step
    return step


def _one_ahead(
    level_at: Callable[[int, LevelPlan], Level], plans: list[LevelPlan], first: int, threads: int, beside: Executor
) -> Iterator[Level]:
    """Levels from number `first` on; while one is fitted, the next is made, unless one thread is to do everything."""
    coming: Future[Level] | None = None
    for index in range(first, len(plans)):
        level = coming.result() if coming else level_at(index, plans[index])
        ahead = threads != 1 and index + 1 < len(plans)
        coming = beside.submit(level_at, index + 1, plans[index + 1]) if ahead else None
        yield level


def _fidelity(ingredients: Ingredients, i: int, iterations: int, last: bool, threads: int) -> Fidelity:
    """Coarse chords cost nothing while finer ones follow: a recipe without a polish has the fine ones throughout."""
    bands = (ingredients.bands, i % ingredients.bands) if last else EVERY_BAND
    if last and i > iterations * (1 - ingredients.polish):
        return Fidelity(4, threads, bands=bands)
    return Fidelity(1, threads, COARSE_FLATNESS if ingredients.polish else FLATNESS, bands)


def _moved_radius(ingredients: Ingredients, i: int, level_plan: LevelPlan, last: bool) -> float | None:
    """Radius for paths that are re-allocated after iteration `i`; None where nothing is to be moved."""
    until = ingredients.reallocate * level_plan.iterations if last else level_plan.iterations
    due = ingredients.reallocate > 0 and i % REALLOCATE_EVERY == 0 and i < until
    return max(LEAST_RADIUS, REALLOCATED_RADIUS * level_plan.radius) if due else None


@dataclass(frozen=True)
class _Iteration:
    """One iteration's place in the schedule: `rate` factor, `fidelity`, radius for re-allocated paths or None."""

    number: int
    rate: float
    fidelity: Fidelity
    moved_radius: float | None


def _iteration(
    ingredients: Ingredients, i: int, rate: float, level_plan: LevelPlan, last: bool, threads: int
) -> _Iteration:
    moved_radius = _moved_radius(ingredients, i, level_plan, last)
    fidelity = _fidelity(ingredients, i, level_plan.iterations, last, threads)
    if moved_radius is not None or rate < 1:  # importance is of all bands, and small steps want exact gradients
        fidelity = replace(fidelity, bands=EVERY_BAND)
    return _Iteration(i, rate, fidelity, moved_radius)


def _iterate(
    population: Population,
    level: Level,
    settings: Settings,
    iteration: _Iteration,
    generator: np.random.Generator,
    beside: Executor,
) -> Population:
    """One step of Adam and, where the schedule says so, a re-allocation of the least important paths after it."""
    ingredients = RECIPES[settings.recipe]
    moving = iteration.moved_radius is not None
    asides = _start_asides(population, level, iteration, beside)
    result = evaluate(population, level, iteration.fidelity, importance=moving)
    for aside in asides:
        aside.result().add_to(result.gradients)
    move(population, result.gradients, ingredients.rates.scaled(iteration.rate), level.frame, settings.opaque)
    if iteration.moved_radius is None or result.importance is None:
        return population
    weak = least_important(result.importance, population.group)
    kept = take(population, np.setdiff1d(np.arange(len(population)), weak))
    gradient = settings.fills == "gradient"
    return seed(kept, level, len(weak), iteration.moved_radius, ingredients, gradient, iteration.fidelity, generator)


def _start_asides(population: Population, level: Level, iteration: _Iteration, beside: Executor) -> list[Future[Aside]]:
    """Passes over single layers, which the fused pass cannot see, if it is their turn; they run beside it.

    They end when rates fall: layers are whole by then, and the picture gets the last steps for itself. With one thread
    they are over when this returns.
    """
    threads = iteration.fidelity.threads
    asides: list[Future[Aside]] = []
    if iteration.number % ASIDE_EVERY or iteration.rate < 1:
        return asides
    if level.silhouette is not None:
        screen = np.full(3, iteration.number // ASIDE_EVERY % 2, np.float32)
        asides.append(beside.submit(detach_fore, population, level.silhouette, screen, ASIDE_EVERY, threads))
    if level.completion is not None:
        aside = beside.submit(complete_local, population, level.completion, level.frame, ASIDE_EVERY, threads)
        asides.append(aside)
    if threads == 1:
        wait(asides)
    return asides


def least_important(importance: NDArray[np.float64], group: NDArray[np.int64]) -> NDArray[np.int64]:
    """Indices of the paths to move: the weakest, under `LEAST_IMPORTANCE` of the mean, `MOST_MOVED` of all at most.

    The mean is that of back and fore. Local paths are moved only while they are more than `LOCAL_KEPT` of all: eyes are
    small, and what looks useless there is a highlight. The lowest path of a part is never moved: it shows when eyes
    turn and lips part.
    """
    local, outer = group >= FIRST_LOCAL, group < LID
    free = outer.copy()
    if np.count_nonzero(local) > LOCAL_KEPT * len(group):
        lowest = np.unique(group, return_index=True)[1]
        free |= local
        free[lowest[group[lowest] >= FIRST_LOCAL]] = False
    least = LEAST_IMPORTANCE * importance[outer].mean() if outer.any() else 0.0
    candidates = np.flatnonzero(free & (importance < least))
    weakest = np.argsort(importance[candidates], kind="stable")[: int(MOST_MOVED * np.count_nonzero(free))]
    return candidates[weakest]
