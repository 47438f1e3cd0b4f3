"""A level's targets are corrected by how a renderer's picture of the same paths differs from the optimiser's.

Renderers composite in 8 bits; every translucent blend rounds, and tiny-skia (resvg) rounds dark values up: half a level
to a whole one over a stack of paths, which costs 0.1 dB at 31 dB and more than a decibel at 45 dB. The difference is
measured, averaged over `WINDOW` to leave its noise at edges out, and taken off the targets; it changes slowly, so a few
corrections in the last level suffice.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import uniform_filter

from vectortalker import metrics
from vectortalker.scene import LayeredScene, to_wire
from vectortalker.svg import to_svg
from vectortalker.vectorize.level import BACK, FIRST_LOCAL, FORE, TOP, Level
from vectortalker.vectorize.losses import Fidelity, merged_picture
from vectortalker.vectorize.population import Population

WINDOW = 9  # px: much wider than the noise of an edge's coverage


def compensate(level: Level, population: Population, fidelity: Fidelity) -> Level:
    """The level with every sheet's target lowered by the renderer's slowly varying excess."""
    own = merged_picture(population, level, fidelity)
    excess = uniform_filter(_painted(level, population) - own, size=WINDOW, axes=(0, 1), mode="nearest")
    return replace(level, sheets=tuple(replace(sheet, target=sheet.target - excess) for sheet in level.sheets))


def _painted(level: Level, population: Population) -> NDArray[np.float32]:
    """What resvg paints of the population as it would be written, f32 [H, W, 3]."""
    width, height = level.frame
    back, fore, local = (population.layer(*g) for g in ((BACK, FORE), (FORE, FIRST_LOCAL), (FIRST_LOCAL, TOP)))
    scene = to_wire(LayeredScene(width, height, level.canvas, back, fore, local))
    svg = to_svg(scene, level.openings, "compensation", level.frame)
    return metrics.render(svg, width, height).astype(np.float32) / np.float32(255)
