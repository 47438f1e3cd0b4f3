"""The poses that a portrait must survive, each with what of the face to look at, and sheets of their pictures."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from PIL import Image, ImageDraw

from vectortalker.animate.drawing import Points
from vectortalker.animate.frames import FrameRenderer
from vectortalker.animate.rigged import RiggedScene
from vectortalker.schema import Part

SHEET_WIDTH = 1800  # px
CAPTION = 14
IRISES: tuple[Part, ...] = ("left_iris", "right_iris")
TEETH: tuple[Part, ...] = ("mouth_upper", "mouth_lower")
FULL_BLINK = {"blink_left": 1.0, "blink_right": 1.0}


@dataclass(frozen=True)
class View:
    """Poses that are looked at alike: the box around `landmarks`, wider by `margin` of its extent on every side.

    `parts` must keep their shape in them.
    """

    landmarks: tuple[int, ...]
    margin: float
    columns: int
    parts: tuple[Part, ...]
    poses: dict[str, dict[str, float]]


VIEWS = (
    View(
        (*range(17, 27), *range(36, 48)),
        margin=0.15,
        columns=4,
        parts=IRISES,
        poses={
            "rest": {},
            "quarter blink": {"blink_left": 0.25, "blink_right": 0.25},
            "half blink": {"blink_left": 0.5, "blink_right": 0.5},
            "full blink": FULL_BLINK,
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
        parts=TEETH,
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
        parts=IRISES,
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
    strips = [strip(view.columns, pictures) for view, pictures in zip(VIEWS, views, strict=True)]
    paper = Image.new("RGB", (SHEET_WIDTH, sum(row.height for row in strips)), "white")
    tops = np.cumsum([0, *(row.height for row in strips)])
    for top, row in zip(tops.tolist(), strips, strict=False):
        paper.paste(row, (0, top))
    return paper


def strip(columns: int, pictures: Sequence[tuple[str, Image.Image]]) -> Image.Image:
    """Captioned pictures of one size in rows of `columns`."""
    width, height = SHEET_WIDTH // columns, pictures[0][1].height + CAPTION
    paper = Image.new("RGB", (SHEET_WIDTH, -(-len(pictures) // columns) * height), "white")
    pen = ImageDraw.Draw(paper)
    for index, (caption, picture) in enumerate(pictures):
        x, y = index % columns * width, index // columns * height
        pen.text((x + 4, y + 1), caption, fill="black")
        paper.paste(picture, (x, y + CAPTION))
    return paper
