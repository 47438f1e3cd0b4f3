"""Settings become a plan: each level's resolution, paths, radius and iterations; each iteration's learning rates."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from vectortalker.schema import Recipe
from vectortalker.vectorize.options import Settings
from vectortalker.vectorize.population import Rates

REFERENCE_SIDE = 512  # px; radii below are measured there, for 500 paths
REFERENCE_PATHS = 500
COARSEST_RADIUS, FINEST_RADIUS = 40.0, 6.0
LEAST_RADIUS = 2.0  # level px; a smaller circle has no inside to learn from
UNIFORM_RADIUS = 20.0
ITERATIONS_FOR_ALL_CORRECTIONS = 300  # a correction costs as much as a dozen iterations


@dataclass(frozen=True)
class Ingredients:
    """What sets the recipes apart.

    `smooth`: coarse levels fit L0-smoothed targets. `coarse`: early levels run at lower resolution. `seeds`: where new
    paths start. `contours`: they take the residual's outline instead of a circle. `reallocate`: share of the last level
    until which useless paths are moved. `decay_from`: share of all iterations after which rates fall to zero along a
    cosine. `polish`: share of the last level, at its end, with 4 sub-rows a pixel. `compensate`: shares of the last
    level at which the targets are corrected by what a renderer paints differently. `bands`: until rates fall,
    iterations of the last level take turns to look at one band of rows in so many.
    """

    smooth: bool
    coarse: bool
    seeds: Literal["peaks", "samples", "uniform"]
    contours: bool
    reallocate: float
    decay_from: float
    polish: float
    compensate: tuple[float, ...]
    bands: int
    rates: Rates


PAPER = Ingredients(
    smooth=True,
    coarse=False,
    seeds="samples",
    contours=False,
    reallocate=0.0,
    decay_from=1.0,
    polish=0.0,
    compensate=(),
    bands=1,
    rates=Rates(points=1.0, colour=0.01, opacity=0.01, axis=1.0, beta2=0.999),  # paper, section 4.1
)
RECIPES: dict[Recipe, Ingredients] = {
    "best": Ingredients(
        smooth=False,
        coarse=True,
        seeds="peaks",
        contours=True,
        reallocate=0.7,
        decay_from=0.75,
        polish=0.1,
        compensate=(0.7, 0.85, 0.93),
        bands=2,
        rates=Rates(points=0.7, colour=0.03, opacity=0.02, axis=1.0, beta2=0.99),
    ),
    "paper": PAPER,
    "diffvg": replace(PAPER, seeds="uniform"),
}


@dataclass(frozen=True)
class LevelPlan:
    """`frame`: width and height in px; `paths`: how many there are once it starts; `radius` of new ones in its px."""

    frame: tuple[int, int]
    paths: int
    radius: float
    iterations: int


def plan(settings: Settings, frame: tuple[int, int]) -> list[LevelPlan]:
    """Levels coarse to fine for a finest level of width × height `frame`."""
    ingredients, n = RECIPES[settings.recipe], settings.levels
    spread = (REFERENCE_PATHS / settings.paths) ** 0.5
    levels = []
    for index in range(n):
        left = n - 1 - index
        shrink = min(4, 2 ** ((left + 1) // 2)) if ingredients.coarse else 1
        width, height = (max(1, round(side / shrink)) for side in frame)
        if ingredients.seeds == "uniform":
            radius = UNIFORM_RADIUS
        else:
            radius = FINEST_RADIUS * (COARSEST_RADIUS / FINEST_RADIUS) ** (left / max(1, n - 1))
        levels.append(
            LevelPlan(
                frame=(width, height),
                paths=settings.paths if left == 0 else round(settings.paths * (index + 1) / n),
                radius=max(LEAST_RADIUS, radius * spread * max(width, height) / REFERENCE_SIDE),
                iterations=settings.iterations if left else settings.final_iterations,
            )
        )
    return levels


def decay(done: int, total: int, start: float) -> float:
    """Factor of the rates after `done` of `total` iterations: 1 until the share `start`, then a cosine to 0."""
    share = (done / max(1, total) - start) / max(1e-9, 1 - start)
    return float(0.5 * (1 + np.cos(np.pi * np.clip(share, 0, 1))))


def corrections(ingredients: Ingredients, level_plan: LevelPlan) -> set[int]:
    """Iterations of the last level at which its targets are corrected; a short level affords one correction."""
    shares = ingredients.compensate[: 1 if level_plan.iterations < ITERATIONS_FOR_ALL_CORRECTIONS else None]
    return {round(share * level_plan.iterations) for share in shares}
