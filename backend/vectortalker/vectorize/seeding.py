"""A population and a level get new paths: where the error is, in the layer that owns the place."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from vectortalker.vectorize.level import FIRST_LOCAL, Level
from vectortalker.vectorize.losses import Fidelity, pictures_below
from vectortalker.vectorize.peaks import coherent_energy, error_samples, greedy_maxima
from vectortalker.vectorize.population import Population, insert
from vectortalker.vectorize.schedule import Ingredients
from vectortalker.vectorize.starts import Start, circle_start, contour_start

CROWDING = 0.5  # radius shrinks by it when a level has fewer peaks than new paths
ROUNDS = 4
MOST_LOCAL = 0.15  # share of all paths: large drawn eyes would take a third, and the rest of the portrait pay for it


def seed(
    population: Population,
    level: Level,
    count: int,
    radius: float,
    ingredients: Ingredients,
    gradient: bool,
    fidelity: Fidelity,
    generator: np.random.Generator,
) -> Population:
    """`count` more paths, each on top of the layer that it belongs to; fewer only where no error at all is left.

    None of them starts within the openings while `MOST_LOCAL` of all are there.
    """
    if len(population) - population.below(FIRST_LOCAL) > MOST_LOCAL * len(population):
        level = level.without_local_places()
    pictures = pictures_below(population, level, [sheet.below for sheet in level.sheets], fidelity)
    residuals = [sheet.target - picture for sheet, picture in zip(level.sheets, pictures, strict=True)]
    claimed = [sheet.claim > 0 for sheet in level.sheets]
    segments = population.points.shape[1] // 3
    starts: list[Start] = []
    groups: list[int] = []
    for centre, sheet_index, reach in _places(level, residuals, count, radius, ingredients, generator):
        sheet = level.sheets[sheet_index]
        if ingredients.contours:
            error = residuals[sheet_index], claimed[sheet_index]
            starts.append(contour_start(sheet.target, *error, centre, reach, segments))
        else:
            starts.append(circle_start(sheet.target, centre, reach, segments))
        groups.append(int(sheet.owner[centre[1], centre[0]]))
    return insert(population, starts, np.array(groups, np.int64), gradient)


Place = tuple[tuple[int, int], int, float]  # centre x, y; sheet; radius


def _places(
    level: Level,
    residuals: list[NDArray[np.float32]],
    count: int,
    radius: float,
    ingredients: Ingredients,
    generator: np.random.Generator,
) -> list[Place]:
    if ingredients.seeds == "peaks":
        return _peak_places(level, residuals, count, radius)
    if ingredients.seeds == "samples":
        squares = [(r**2).sum(axis=2) * s.claim for r, s in zip(residuals, level.sheets, strict=True)]
        energies = np.stack(squares)
    else:
        energies = np.stack([(sheet.claim > 0).astype(np.float32) for sheet in level.sheets])
    centres, sheets = error_samples(energies, count, generator)
    return [((int(x), int(y)), int(sheet), radius) for (x, y), sheet in zip(centres, sheets, strict=True)]


def _peak_places(level: Level, residuals: list[NDArray[np.float32]], count: int, radius: float) -> list[Place]:
    """Coherent peaks: first every sheet's quota, then wherever they are highest; what is left at half the spacing."""
    places: list[Place] = []
    for index, sheet in enumerate(level.sheets):
        reach = min(radius, sheet.most_radius)
        if sheet.quota:
            energy = coherent_energy(residuals[index], sheet.claim, reach)[None]
            centres, _ = greedy_maxima(energy, reach, round(sheet.quota * count))
            places += [((int(x), int(y)), index, reach) for x, y in centres]
    for _ in range(ROUNDS):
        if len(places) == count:
            break
        energies = [coherent_energy(r, s.claim, radius) for r, s in zip(residuals, level.sheets, strict=True)]
        centres, sheets = greedy_maxima(np.stack(energies), radius, count - len(places))
        places += [((int(x), int(y)), int(sheet), radius) for (x, y), sheet in zip(centres, sheets, strict=True)]
        radius *= CROWDING
    return places
