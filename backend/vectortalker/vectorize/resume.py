"""A finished level becomes a checkpoint of plain arrays, and a checkpoint the start of the next level."""

from __future__ import annotations

from vectortalker.errors import VectorTalkerError
from vectortalker.scene import with_middle
from vectortalker.vectorize.optimise import Start, Step
from vectortalker.vectorize.options import Settings
from vectortalker.vectorize.population import fresh
from vectortalker.vectorize.progress import Checkpoint

PATHS = ("points", "stops", "axis", "gradient", "group")


def checkpoint(step: Step, settings: Settings) -> Checkpoint:
    """Copy of the paths at the end of a level; the next one starts with fresh moments."""
    arrays = {name: getattr(step.population, name).copy() for name in PATHS}
    return Checkpoint(step.level_index + 1, step.iteration, repr(settings), arrays)


def restore(saved: Checkpoint, settings: Settings) -> Start:
    """Continue from `saved`; raises `bad_option` when it was made with other options."""
    if saved.settings != repr(settings):
        raise VectorTalkerError(
            "bad_option", f"The checkpoint was made with {saved.settings}, this job wants {settings!r}: start afresh."
        )
    arrays = {name: saved.arrays[name].copy() for name in PATHS}
    population = fresh(**{**arrays, "stops": with_middle(arrays["stops"])})
    return Start(population, saved.level, saved.iterations)
