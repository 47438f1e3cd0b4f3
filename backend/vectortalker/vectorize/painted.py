"""A level's targets are corrected by how a renderer's picture of the same paths differs from the optimiser's.

Renderers composite in 8 bits; every translucent blend rounds, and tiny-skia (resvg) rounds up: half a level to a whole
one over a stack of paths, which costs 0.1 dB at 31 dB and more than a decibel at 45 dB. The difference is averaged over
`WINDOW` and taken off the targets. Pixel by pixel it would be the noise of one renderer's grid: fitting that took two
drawings up by 0.3 dB in resvg and down by as much in Chromium.
"""

from __future__ import annotations

from dataclasses import replace

from scipy.ndimage import uniform_filter

from vectortalker.vectorize.level import Level
from vectortalker.vectorize.losses import Fidelity, merged_picture, previewed_picture
from vectortalker.vectorize.population import Population

WINDOW = 9  # px: much wider than the noise of an edge's coverage


def compensate(level: Level, population: Population, fidelity: Fidelity) -> Level:
    """The level with every sheet's target lowered by the renderer's slowly varying excess."""
    difference = previewed_picture(population, level, fidelity.threads) - merged_picture(population, level, fidelity)
    excess = uniform_filter(difference, size=WINDOW, axes=(0, 1), mode="nearest")
    return replace(level, sheets=tuple(replace(sheet, target=sheet.target - excess) for sheet in level.sheets))
