"""Builders of small scenes for the rasteriser's tests."""

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
import vectortalker_core as core
from numpy.typing import NDArray

Floats = NDArray[np.float32]
Checkpoints = list[tuple[int, Floats, Floats]]  # paths below, target [H, W, 3], weight [H, W]


@dataclass(frozen=True)
class Scene:
    """Arguments of the core by name; solid opaque black over white unless said otherwise."""

    points: Floats
    stops: Floats
    axis: Floats
    gradient: NDArray[np.bool_]
    clip: NDArray[np.int32]
    clips: Floats
    canvas: Floats = field(default_factory=lambda: np.ones(3, np.float32))

    def arguments(self) -> dict[str, Any]:
        return dict(self.__dict__)

    def changed(self, name: str, index: int, step: float) -> "Scene":
        """A copy with one number of one array moved."""
        moved = getattr(self, name).copy()
        moved.reshape(-1)[index] += step
        return replace(self, **{name: moved})

    def without(self, path: int) -> "Scene":
        """A copy in which one path is fully transparent."""
        stops = self.stops.copy()
        stops[path, :, 3] = 0
        return replace(self, stops=stops)


def paint(scene: Scene, width: int, height: int, **options: Any) -> Floats:
    return core.rasterize(**scene.arguments(), width=width, height=height, **options)


def placed(checkpoints: Checkpoints) -> list[tuple[int, core.Target]]:
    """Checkpoints as the core takes them."""
    return [(below, core.Target(target, weight)) for below, target, weight in checkpoints]


def polygon(*corners: tuple[float, float]) -> Floats:
    """Control points [1, 3S, 2] of straight cubics, handles at the thirds."""
    a = np.asarray(corners, np.float32)
    b = np.roll(a, -1, 0)
    return np.stack([a, a + (b - a) / 3, a + (b - a) * 2 / 3], 1).reshape(1, -1, 2)


def solid(points: Floats, colour: tuple[float, float, float] = (0, 0, 0), opacity: float = 1.0) -> Scene:
    """All paths of one colour."""
    n = len(points)
    stops = np.tile(np.array([*colour, opacity], np.float32), (n, 3, 1))
    return Scene(
        points,
        stops,
        np.zeros((n, 4), np.float32),
        np.zeros(n, bool),
        np.full(n, -1, np.int32),
        np.zeros((0, 1, 1), np.float32),
    )


def blobs(
    seed: int,
    n: int,
    width: int,
    height: int,
    radius: tuple[float, float],
    segments: int = 8,
    jitter: float = 0.2,
) -> Scene:
    """Jittered translucent circles around points of the frame, some across its borders, every other one a gradient."""
    rng = np.random.default_rng(seed)
    turn = np.arange(segments) * 2 * np.pi / segments
    handle = 4 / 3 * np.tan(np.pi / segments / 2)
    anchor, tangent = (
        np.stack([np.cos(turn), np.sin(turn)], -1),
        np.stack([-np.sin(turn), np.cos(turn)], -1),
    )
    ring = np.stack(
        [anchor, anchor + handle * tangent, np.roll(anchor - handle * tangent, -1, 0)],
        1,
    ).reshape(-1, 2)
    centre = rng.uniform(0, (width, height), (n, 1, 2))
    shape = ring * rng.uniform(*radius, (n, 1, 1)) * rng.uniform(1 - jitter, 1 + jitter, (n, 3 * segments, 2))
    points = (centre + shape).astype(np.float32)
    axis = np.concatenate(
        [
            points.mean(1) - rng.uniform(2, 9, (n, 2)),
            points.mean(1) + rng.uniform(2, 9, (n, 2)),
        ],
        1,
    )
    ends, canvas = rng.uniform(0.1, 0.9, (n, 2, 4)), rng.uniform(0.2, 0.8, 3)
    middles = rng.uniform(0.1, 0.9, (n, 4))
    return Scene(
        points,
        np.insert(ends, 1, middles, axis=1).astype(np.float32),
        axis.astype(np.float32),
        np.arange(n) % 2 == 0,
        np.full(n, -1, np.int32),
        np.zeros((0, height, width), np.float32),
        canvas.astype(np.float32),
    )


def noise(seed: int, height: int, width: int) -> tuple[Floats, Floats]:
    """A random target [H, W, 3] and weight [H, W]."""
    rng = np.random.default_rng(seed)
    return rng.uniform(size=(height, width, 3)).astype(np.float32), rng.uniform(0.5, 2, (height, width)).astype(
        np.float32
    )
