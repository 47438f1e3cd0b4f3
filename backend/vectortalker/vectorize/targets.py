"""A portrait becomes what every level fits: its working picture, resized."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from vectortalker.decode import Portrait
from vectortalker.schema import Landmarks
from vectortalker.vectorize.frame import Frame
from vectortalker.vectorize.level import FORE, Level, single_sheet_level
from vectortalker.vectorize.options import Settings
from vectortalker.vectorize.schedule import LevelPlan


@dataclass(frozen=True)
class Targets:
    """`picture` u8 [H, W, 3] at the working size; `canvas` f32 [3]; `openings`: outlines [3S, 2] in portrait px."""

    picture: NDArray[np.uint8]
    canvas: NDArray[np.float32]
    openings: tuple[NDArray[np.float64], ...]

    def level(self, index: int, level_plan: LevelPlan) -> Level:
        """Targets of level `index` at its resolution."""
        image = Image.fromarray(self.picture).resize(level_plan.frame, Image.Resampling.BOX)
        return single_sheet_level(np.asarray(image, np.float32) / np.float32(255), FORE, self.canvas)


def prepare(
    portrait: Portrait,
    landmarks: Landmarks | None,
    picture: NDArray[np.uint8],
    frame: Frame,
    settings: Settings,
) -> Targets:
    """Targets of a portrait; the canvas has its mean colour."""
    canvas = picture.reshape(-1, 3).mean(axis=0).astype(np.float32) / np.float32(255)
    return Targets(picture, canvas, ())
