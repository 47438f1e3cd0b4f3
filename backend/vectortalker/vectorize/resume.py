"""A finished level becomes a checkpoint of plain arrays, and a checkpoint the start of the next level."""

from __future__ import annotations

from vectortalker.errors import VectorTalkerError
from vectortalker.vectorize.adam import Moments
from vectortalker.vectorize.optimise import Start, Step
from vectortalker.vectorize.options import Settings
from vectortalker.vectorize.population import MOVED, Population
from vectortalker.vectorize.progress import Checkpoint

PLAIN = ("points", "stops", "axis", "gradient", "group", "age")


def checkpoint(step: Step, settings: Settings) -> Checkpoint:
    """Copy of the state at the end of a level."""
    population = step.population
    arrays = {name: getattr(population, name).copy() for name in PLAIN}
    for name in MOVED:
        arrays[f"{name}.first"] = population.moments[name].first.copy()
        arrays[f"{name}.second"] = population.moments[name].second.copy()
    return Checkpoint(step.level_index + 1, step.iteration, repr(settings), arrays)


def restore(saved: Checkpoint, settings: Settings) -> Start:
    """Continue from `saved`; raises `bad_option` when it was made with other options."""
    if saved.settings != repr(settings):
        raise VectorTalkerError(
            "bad_option", f"The checkpoint was made with {saved.settings}, this job wants {settings!r}: start afresh."
        )
    arrays = saved.arrays
    moments = {name: Moments(arrays[f"{name}.first"].copy(), arrays[f"{name}.second"].copy()) for name in MOVED}
    population = Population(**{name: arrays[name].copy() for name in PLAIN}, moments=moments)
    return Start(population, saved.level, saved.iterations)
