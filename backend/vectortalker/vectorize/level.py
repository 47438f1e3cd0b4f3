"""What the optimiser fits at one level: a sheet per layer, the openings' masks, and what fore must leave alone."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import vectortalker_core as core
from numpy.typing import NDArray

BACK, FORE, LID, FIRST_LOCAL = 0, 1, 2, 3  # group of a path; made lids stay as they are; local: FIRST_LOCAL + part
TOP = FIRST_LOCAL + 8  # above all groups


@dataclass(frozen=True)
class Sheet:
    """One of the paper's losses (supplement B): the picture of all paths in groups under `below` against `target`.

    `target` f32 [H, W, 3]; `weight` f32 [H, W] of the squared error; `claim` f32 [H, W]: weight of the error when
    places for new paths are sought, 0 where another layer must explain it; `owner` i64 [H, W]: group of a path seeded
    there. `quota`: least share of every level's new paths that start here; `most_radius` of these in px.
    """

    below: int
    target: NDArray[np.float32]
    weight: NDArray[np.float32]
    claim: NDArray[np.float32]
    owner: NDArray[np.int64]
    quota: float = 0.0
    most_radius: float = np.inf

    @cached_property
    def goal(self) -> core.Target:
        """`target` and `weight` as the rasteriser reads them in every pass."""
        return core.Target(np.ascontiguousarray(self.target), self.weight)


@dataclass(frozen=True)
class Silhouette:
    """The paper's L_fore of the fore layer alone, at a quarter of the resolution.

    `target` f32 [h, w, 3]; `inside` f32 [h, w]: weight where fore must hide the back, which will show when the head
    moves; `outside` f32 [h, w]: weight where it must paint nothing, because it moves and the scenery does not.
    """

    target: NDArray[np.float32]
    inside: NDArray[np.float32]
    outside: NDArray[np.float32]


@dataclass(frozen=True)
class Completion:
    """The paper's L_local beyond the openings, on a crop of the frame whose corner is `left`, `top`.

    `target` f32 [h, w, 3]: eyeballs and mouth interior carried on under lids and lips; `extent` f32 [h, w]: where;
    `weight` f32 [h, w] of the squared error.
    """

    left: int
    top: int
    target: NDArray[np.float32]
    extent: NDArray[np.float32]
    weight: NDArray[np.float32]

    @cached_property
    def goal(self) -> core.Target:
        """`target` and `weight` as the rasteriser reads them in every pass."""
        return core.Target(self.target, self.weight)


@dataclass(frozen=True)
class Level:
    """Targets at one resolution. `sheets` bottom to top, the last is the merged picture.

    `openings`: outlines [3S, 2] in its px; `opening` f32 [H, W]: their coverage. `clips` f32 [k, H, W]: 1 wherever that
    is not zero, because renderers clip the local layer as a whole, once, and the rasteriser would clip every path of
    it. `silhouette` and `completion`: what fore and local paint alone; None without layers.
    """

    sheets: tuple[Sheet, ...]
    openings: tuple[NDArray[np.float64], ...]
    clips: NDArray[np.float32]
    opening: NDArray[np.float32]
    silhouette: Silhouette | None
    completion: Completion | None
    canvas: NDArray[np.float32]

    @property
    def picture(self) -> NDArray[np.float32]:
        return self.sheets[-1].target

    @property
    def frame(self) -> tuple[int, int]:
        """Width and height in px."""
        return self.picture.shape[1], self.picture.shape[0]

    def without_local_places(self) -> Level:
        """The same, but no new path is to start within the openings."""
        *others, merged = self.sheets
        return replace(self, sheets=(*others, replace(merged, claim=np.zeros_like(merged.claim), quota=0.0)))


def single_sheet_level(picture: NDArray[np.float32], group: int, canvas: NDArray[np.float32]) -> Level:
    """Everything in one group, for `--no-layers` and for pictures without a person."""
    height, width, _ = picture.shape
    ones, none = np.ones((height, width), np.float32), np.zeros((height, width), np.float32)
    sheet = Sheet(TOP, picture, ones, ones, np.full((height, width), group, np.int64))
    return Level((sheet,), (), np.zeros((0, height, width), np.float32), none, None, None, canvas)
