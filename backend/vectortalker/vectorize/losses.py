"""A population and a level become loss, gradients and importance: the paper's four losses in one fused pass."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import vectortalker_core as core
from numpy.typing import NDArray

from vectortalker.scene import OPENING_OF_PART
from vectortalker.vectorize.level import FIRST_LOCAL, FORE, LID, TOP, Completion, Level, Silhouette
from vectortalker.vectorize.population import Population

FLATNESS = 0.1  # px; the pictures of finished scenes come within 55 dB of much finer chords'
EVERY_BAND = (1, 0)
SILHOUETTE_SCALE = 0.25  # resolution at which the fore layer is looked at alone: a sixteenth of the pixels


@dataclass(frozen=True)
class Fidelity:
    """How closely a pass follows what renderers paint.

    `subrows` a pixel (1, 2, 4): the nonzero rule where paths fold; `threads` (0: all); `flatness`: px that a chord may
    stray from its cubic. `bands` (every, first): bands of 16 rows that stand for all; gradients are right on the mean
    of passes with every `first`.
    """

    subrows: int = 1
    threads: int = 0
    flatness: float = FLATNESS
    bands: tuple[int, int] = EVERY_BAND


@dataclass(frozen=True)
class Evaluation:
    """`loss` of all sheets, gradients by array name, `importance` f64 [n] if wanted."""

    loss: float
    gradients: dict[str, NDArray[np.float32]]
    importance: NDArray[np.float64] | None


def clip_indices(population: Population) -> NDArray[np.int32]:
    """Mask of every path's opening [n], −1 outside the local layer."""
    part = population.group - FIRST_LOCAL
    return np.where(part >= 0, OPENING_OF_PART[np.maximum(part, 0)], -1).astype(np.int32)


def evaluate(population: Population, level: Level, fidelity: Fidelity, importance: bool = False) -> Evaluation:
    """L_back + L_fore + L_merged of supplement B, each after its layer in painter's order.

    L_local is the merged error within the openings, whose weight is raised there.
    """
    checkpoints = [(population.below(sheet.below), sheet.goal) for sheet in level.sheets]
    losses, _, grad_points, grad_stops, grad_axis, gains = core.loss_and_gradients(
        population.points,
        population.stops,
        population.axis,
        population.gradient,
        clip_indices(population),
        level.clips,
        level.canvas,
        checkpoints,
        subrows=fidelity.subrows,
        threads=fidelity.threads,
        flatness=fidelity.flatness,
        importance=importance,
        picture=False,
        bands=fidelity.bands,
    )
    gradients = {"points": grad_points, "stops": grad_stops, "axis": grad_axis}
    return Evaluation(float(np.sum(losses)), gradients, gains)


@dataclass(frozen=True)
class Aside:
    """Gradients of a loss that sees `paths` alone, by array name."""

    paths: slice
    gradients: dict[str, NDArray[np.float32]]

    def add_to(self, gradients: dict[str, NDArray[np.float32]]) -> None:
        """Add to those of all paths."""
        for name, share in self.gradients.items():
            gradients[name][self.paths] += share


def detach_fore(
    population: Population, silhouette: Silhouette, screen: NDArray[np.float32], times: int, threads: int
) -> Aside:
    """`times` the gradients of what makes the fore layer whole by itself: L_fore of supplement B.

    The fore paths alone are painted over a `screen` colour f32 [3]: inside the silhouette none of it may show, outside
    it must stay as it is. With black and white in turn no colour is a hiding place, and the mean of a few steps has no
    noise, which random screens would leave in every fore path.
    """
    fore = slice(population.below(FORE), population.below(LID))
    height, width = silhouette.inside.shape
    scale = np.float32(SILHOUETTE_SCALE)
    target = np.where(silhouette.inside[..., None] > 0, silhouette.target, screen)
    weight = (silhouette.inside + silhouette.outside) * np.float32(times)
    _, _, grad_points, grad_stops, grad_axis, _ = core.loss_and_gradients(
        population.points[fore] * scale,
        population.stops[fore],
        population.axis[fore] * scale,
        population.gradient[fore],
        np.full(fore.stop - fore.start, -1, np.int32),
        np.zeros((0, height, width), np.float32),
        screen,
        [(fore.stop - fore.start, core.Target(target, weight))],
        threads=threads,
        picture=False,
    )
    return Aside(fore, {"points": grad_points * scale, "stops": grad_stops, "axis": grad_axis * scale})


def complete_local(
    population: Population, completion: Completion, frame: tuple[int, int], times: int, threads: int
) -> Aside:
    """`times` the gradients of what makes local paths go on under lids and lips: L_local of supplement B.

    The local paths alone are painted, clipped by the completed extent instead of the openings; `frame` (width, height)
    is the level's, over whose pixels the mean is taken.
    """
    local = slice(population.below(FIRST_LOCAL), len(population))
    count = local.stop - local.start
    corner = np.array([completion.left, completion.top], np.float32)
    share = np.float32(times * completion.weight.size / (frame[0] * frame[1]))
    _, _, grad_points, grad_stops, grad_axis, _ = core.loss_and_gradients(
        population.points[local] - corner,
        population.stops[local],
        population.axis[local] - np.tile(corner, 2),
        population.gradient[local],
        np.zeros(count, np.int32),
        completion.extent[None],
        completion.target.mean(axis=(0, 1)),
        [(count, completion.goal)],
        threads=threads,
        picture=False,
    )
    return Aside(local, {"points": grad_points * share, "stops": grad_stops * share, "axis": grad_axis * share})


def picture_below(population: Population, level: Level, group: int, fidelity: Fidelity) -> NDArray[np.float32]:
    """Image f32 [H, W, 3] of the paths under the first of `group`."""
    return core.rasterize(
        *_paths_below(population, level, group),
        subrows=fidelity.subrows,
        threads=fidelity.threads,
        flatness=fidelity.flatness,
    )


def pictures_below(
    population: Population, level: Level, groups: Sequence[int], fidelity: Fidelity
) -> NDArray[np.float32]:
    """Images f32 [k, H, W, 3] of the paths under the first of each of the ascending `groups`, in one pass."""
    return core.rasterize_stack(
        *_paths_below(population, level, TOP),
        heights=[population.below(group) for group in groups],
        subrows=fidelity.subrows,
        threads=fidelity.threads,
        flatness=fidelity.flatness,
    )


def merged_picture(population: Population, level: Level, fidelity: Fidelity) -> NDArray[np.float32]:
    """Image f32 [H, W, 3] of all layers."""
    return _clipped_once(level, lambda group: picture_below(population, level, group, fidelity))


def previewed_picture(population: Population, level: Level, threads: int) -> NDArray[np.float32]:
    """Image f32 [H, W, 3] of all layers as resvg paints it: within 43 dB (line art) to 52 dB of its own."""
    return _clipped_once(level, lambda group: core.preview(*_paths_below(population, level, group), threads=threads))


def _clipped_once(level: Level, below: Callable[[int], NDArray[np.float32]]) -> NDArray[np.float32]:
    """All that is `below` the top; at an opening's edge (1 − α)·fore + α·local, as renderers clip local once."""
    merged = below(TOP)
    edge = (level.opening > 0) & (level.opening < 1)
    if edge.any():
        fore, share = below(FIRST_LOCAL)[edge], level.opening[edge, None]
        merged[edge] = fore + share * (merged[edge] - fore)
    return merged


def _paths_below(population: Population, level: Level, group: int) -> tuple[Any, ...]:
    """What the core needs to know of the paths under the first of `group`, and of the level's frame."""
    n = population.below(group)
    fills = (population.stops[:n], population.axis[:n], population.gradient[:n])
    clips = (clip_indices(population)[:n], level.clips)
    return population.points[:n], *fills, *clips, level.canvas, *level.frame
