"""The paths being optimised: arrays in painter's order, which seeding extends, re-allocation prunes and Adam moves."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from vectortalker.scene import STOPS, Layer
from vectortalker.vectorize.adam import Moments, step
from vectortalker.vectorize.level import FIRST_LOCAL, LID
from vectortalker.vectorize.starts import Start

MOVED = ("points", "stops", "axis")
OVERHANG = 64.0  # control points may leave the frame this far; beyond, gradients never bring them back


@dataclass(frozen=True)
class Rates:
    """Adam's step sizes: points and axis in px, colour and opacity in [0, 1]; decay of the second moment."""

    points: float
    colour: float
    opacity: float
    axis: float
    beta2: float

    def scaled(self, factor: float) -> Rates:
        return Rates(self.points * factor, self.colour * factor, self.opacity * factor, self.axis * factor, self.beta2)


@dataclass
class Population:
    """Mutable by its functions only. `group` i64 [n] ascending; `age` i64 [n] counts steps; the rest as in `Layer`."""

    points: NDArray[np.float32]
    stops: NDArray[np.float32]
    axis: NDArray[np.float32]
    gradient: NDArray[np.bool_]
    group: NDArray[np.int64]
    age: NDArray[np.int64]
    moments: dict[str, Moments]

    def __len__(self) -> int:
        return len(self.points)

    def below(self, group: int) -> int:
        """Number of paths under the first of `group`."""
        return int(np.searchsorted(self.group, group))

    def layer(self, first: int, last: int) -> Layer:
        """Paths of groups `first` … `last` − 1, copied."""
        part = slice(self.below(first), self.below(last))
        numbers = np.where(self.group[part] >= FIRST_LOCAL, self.group[part] - FIRST_LOCAL, -1)
        return Layer(
            self.points[part].copy(),
            self.stops[part].copy(),
            self.axis[part].copy(),
            self.gradient[part].copy(),
            numbers,
        )


def fresh(
    points: NDArray[np.float32],
    stops: NDArray[np.float32],
    axis: NDArray[np.float32],
    gradient: NDArray[np.bool_],
    group: NDArray[np.int64],
) -> Population:
    """Paths that Adam has not moved yet."""
    moments = {"points": Moments.zeros(points.shape), "stops": Moments.zeros(stops.shape)}
    moments["axis"] = Moments.zeros(axis.shape)
    return Population(points, stops, axis, gradient, group, np.zeros(len(points), np.int64), moments)


def empty_population(segments: int) -> Population:
    points, stops, axis = (np.zeros(shape, np.float32) for shape in ((0, 3 * segments, 2), (0, STOPS, 4), (0, 4)))
    return fresh(points, stops, axis, np.zeros(0, np.bool_), np.zeros(0, np.int64))


def take(population: Population, index: NDArray[np.int64] | NDArray[np.bool_]) -> Population:
    """The chosen paths with their moments."""
    return Population(
        population.points[index],
        population.stops[index],
        population.axis[index],
        population.gradient[index],
        population.group[index],
        population.age[index],
        {name: Moments(m.first[index], m.second[index]) for name, m in population.moments.items()},
    )


def insert(
    population: Population, starts: Sequence[Start], groups: NDArray[np.int64], gradient: bool | NDArray[np.bool_]
) -> Population:
    """New paths on top of their groups, without moments, in the order given."""
    if not starts:
        return population
    new = {name: np.stack([getattr(start, name) for start in starts]) for name in MOVED}
    joined = Population(
        np.concatenate([population.points, new["points"]]),
        np.concatenate([population.stops, new["stops"]]),
        np.concatenate([population.axis, new["axis"]]),
        np.concatenate([population.gradient, np.full(len(starts), gradient)]),
        np.concatenate([population.group, groups]),
        np.concatenate([population.age, np.zeros(len(starts), np.int64)]),
        {name: _with_zero_rows(moments, len(starts)) for name, moments in population.moments.items()},
    )
    return take(joined, np.argsort(joined.group, kind="stable"))


def _with_zero_rows(moments: Moments, count: int) -> Moments:
    zeros = np.zeros((count, *moments.first.shape[1:]), np.float32)
    return Moments(np.concatenate([moments.first, zeros]), np.concatenate([moments.second, zeros]))


def rescale(population: Population, old: tuple[int, int], new: tuple[int, int]) -> Population:
    """Move from a frame of (width, height) to another and start Adam afresh.

    A level's targets are not those of the one before: second moments remembered from it would only damp the steps.
    """
    factor = np.divide(new, old).astype(np.float32)
    points, axis = population.points * factor, population.axis * np.tile(factor, 2)
    return fresh(points, population.stops, axis, population.gradient, population.group)


def move(
    population: Population,
    gradients: dict[str, NDArray[np.float32]],
    rates: Rates,
    frame: tuple[int, int],
    opaque: bool,
) -> None:
    """One Adam step, then back to colours in [0, 1] and to points within `OVERHANG` of the frame (width, height).

    Lids stay: their `gradients` are set to zero.
    """
    lids = slice(population.below(LID), population.below(FIRST_LOCAL))
    population.age += 1
    stop_rates = np.array([rates.colour] * 3 + [0.0 if opaque else rates.opacity], np.float32)
    ranges = {
        "points": (rates.points, (-OVERHANG, np.array(frame, np.float32) + np.float32(OVERHANG))),
        "stops": (stop_rates, (0.0, 1.0)),
        "axis": (rates.axis, (-np.inf, np.inf)),
    }
    for name, (rate, limits) in ranges.items():
        gradients[name][lids] = 0
        values, moments = getattr(population, name), population.moments[name]
        step(values, gradients[name], moments, population.age, rate, rates.beta2, limits)
    if opaque:
        population.stops[..., 3] = 1
