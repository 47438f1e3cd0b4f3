"""A portrait becomes what every level fits: the smoothed stack, resized."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from vectortalker import smooth
from vectortalker.decode import Portrait
from vectortalker.schema import Landmarks
from vectortalker.vectorize.frame import Frame
from vectortalker.vectorize.level import FORE, Level, single_sheet_level
from vectortalker.vectorize.options import Settings
from vectortalker.vectorize.resize import resize
from vectortalker.vectorize.schedule import LevelPlan


@dataclass(frozen=True)
class Targets:
    """`stack`: f32 [h, w, 3], coarse to fine; `canvas` f32 [3]; `openings`: outlines [3S, 2] in portrait px."""

    stack: tuple[NDArray[np.float32], ...]
    canvas: NDArray[np.float32]
    openings: tuple[NDArray[np.float64], ...]

    def level(self, index: int, level_plan: LevelPlan) -> Level:
        """Targets of level `index` at its resolution."""
        return single_sheet_level(resize(self.stack[index], level_plan.frame), FORE, self.canvas)


def prepare(
    portrait: Portrait,
    landmarks: Landmarks | None,
    picture: NDArray[np.uint8],
    frame: Frame,
    settings: Settings,
    plans: list[LevelPlan],
) -> Targets:
    """Targets of a portrait; the canvas has its mean colour."""
    image = picture.astype(np.float32) / np.float32(255)
    canvas = np.rint(picture.reshape(-1, 3).mean(axis=0)).astype(np.float32) / np.float32(255)
    return Targets(smoothed_stack(image, plans), canvas, ())


def smoothed_stack(image: NDArray[np.float32], plans: list[LevelPlan]) -> tuple[NDArray[np.float32], ...]:
    """L0-smoothed targets of the coarse levels, at the largest resolution that they need, and `image` itself."""
    if len(plans) == 1:
        return (image,)
    coarse = resize(image, max(level_plan.frame for level_plan in plans[:-1]))
    return (*(level.image for level in smooth.stack(coarse, len(plans))[:-1]), image)
