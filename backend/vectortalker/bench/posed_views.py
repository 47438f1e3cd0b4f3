"""The poses that a portrait must survive, each with what of the face to look at, and sheets of their pictures."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from PIL import Image, ImageDraw

from vectortalker.animate.drawing import Points
from vectortalker.animate.frames import FrameRenderer
from vectortalker.animate.rigged import RiggedScene

SHEET_WIDTH = 1800  # px
CAPTION = 14


@dataclass(frozen=True)
class View:
    """Poses that are looked at alike: the box around `landmarks`, wider by `margin` of its extent on every side."""

    landmarks: tuple[int, ...]
    margin: float
    columns: int
    poses: dict[str, dict[str, float]]


VIEWS = (
    View(
        (*range(17, 27), *range(36, 48)),
        margin=0.15,
        columns=4,
        poses={
            "rest": {},
            "quarter blink": {"blink_left": 0.25, "blink_right": 0.25},
            "half blink": {"blink_left": 0.5, "blink_right": 0.5},
            "full blink": {"blink_left": 1, "blink_right": 1},
            "gaze left": {"gaze_x": -1},
            "gaze right": {"gaze_x": 1},
            "gaze up": {"gaze_y": -1},
            "gaze down": {"gaze_y": 1},
        },
    ),
    View(
        (*range(5, 12), *range(31, 36), *range(48, 68)),
        margin=0.1,
        columns=4,
        poses={
            "closed": {"neutral": 1},
            "wide open": {"jaw": 1},
            "round": {"jaw": 0.3, "round": 1},
            "smile": {"smile": 1},
        },
    ),
    View(
        tuple(range(68)),
        margin=0.4,
        columns=6,
        poses={
            "roll -15": {"roll": -15},
            "roll 15": {"roll": 15},
            "yaw -15": {"yaw": -15},
            "yaw 15": {"yaw": 15},
            "pitch -10": {"pitch": -10},
            "pitch 10": {"pitch": 10},
        },
    ),
)


class Camera:
    """Pictures of one view of a portrait whose landmarks rest at `landmarks` [68, 2]."""

    def __init__(self, rigged: RiggedScene, view: View, landmarks: Points) -> None:
        points = landmarks[list(view.landmarks)]
        low, high = points.min(axis=0), points.max(axis=0)
        margin = view.margin * (high - low).max()
        self._corner, (width, height) = low - margin, high - low + 2 * margin
        cell = SHEET_WIDTH // view.columns
        drawing = replace(rigged.drawing, width=float(width), height=float(height))
        self._renderer = FrameRenderer(drawing, (cell, round(cell * height / width)))

    def picture(self, points: Points) -> Image.Image:
        """The view of the frame `points` [N, 2]."""
        return Image.fromarray(self._renderer.render(points - self._corner)).convert("RGB")


def sheet(views: Sequence[Sequence[tuple[str, Image.Image]]]) -> Image.Image:
    """Captioned pictures, views below each other."""
    strips = [_strip(view.columns, pictures) for view, pictures in zip(VIEWS, views, strict=True)]
    paper = Image.new("RGB", (SHEET_WIDTH, sum(strip.height for strip in strips)), "white")
    tops = np.cumsum([0, *(strip.height for strip in strips)])
    for top, strip in zip(tops.tolist(), strips, strict=False):
        paper.paste(strip, (0, top))
    return paper


def _strip(columns: int, pictures: Sequence[tuple[str, Image.Image]]) -> Image.Image:
    width, height = SHEET_WIDTH // columns, pictures[0][1].height + CAPTION
    strip = Image.new("RGB", (SHEET_WIDTH, -(-len(pictures) // columns) * height), "white")
    pen = ImageDraw.Draw(strip)
    for index, (caption, picture) in enumerate(pictures):
        x, y = index % columns * width, index // columns * height
        pen.text((x + 4, y + 1), caption, fill="black")
        strip.paste(picture, (x, y + CAPTION))
    return strip
