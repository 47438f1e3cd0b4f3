"""A finished level becomes a checkpoint of plain arrays, and a checkpoint the start of the next level."""

from __future__ import annotations

from vectortalker.errors import VectorTalkerError
from vectortalker.vectorize.optimise import Start, Step
from vectortalker.vectorize.options import Settings
from vectortalker.vectorize.population import fresh
from vectortalker.vectorize.progress import Checkpoint

PATHS = ("points", "stops", "axis", "gradient", "group")
FORM = 2  # of these arrays: raised when what they mean changes


def checkpoint(step: Step, settings: Settings) -> Checkpoint:
    """Copy of the paths at the end of a level; the next one starts with fresh moments."""
    arrays = {name: getattr(step.population, name).copy() for name in PATHS}
    return Checkpoint(step.level_index + 1, step.iteration, _maker(settings), arrays)


def restore(saved: Checkpoint, settings: Settings) -> Start:
    """Continue from `saved`; raises `bad_option` when it was made with other options."""
    if saved.settings != _maker(settings):
        raise VectorTalkerError(
            "bad_option",
            f"The checkpoint was made with {saved.settings}, this job wants {_maker(settings)}: start afresh.",
        )
    population = fresh(**{name: saved.arrays[name].copy() for name in PATHS})
    return Start(population, saved.level, saved.iterations)


def _maker(settings: Settings) -> str:
    return f"form {FORM}, {settings!r}"
