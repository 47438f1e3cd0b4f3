"""Types of the Rust core."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

# ---------------------------------------------------------------- geometry

def opening_outlines(landmarks: Array) -> list[tuple[str, Array, bool]]:
    """Outlines of `left_eye`, `right_eye` and `mouth` for landmarks [68, 2] at rest: (name, points [3S, 2], closed).

    Points are a closed chain `anchor, handle, handle, …`, linear in the landmarks. A closed opening has zero area.
    """

def channels() -> list[tuple[str, float, float]]:
    """Name, least and greatest value of each articulator, in the order `Rig.vertices` takes them."""

def path_data(points: Array) -> str:
    """SVG path data (`M … C … Z`, at most two decimals) of a closed chain [3S, 2]."""

def fit_pins(pins: Array) -> tuple[Array, list[list[float]]] | None:
    """Landmarks [68, 2] and two irises (x, y, radius) for five pins [5, 2]; None when the pins coincide."""

class Rig:
    def __init__(
        self,
        size: tuple[float, float],
        points: Array,
        segments: list[int],
        layers: list[int],
        landmarks: Array,
        irises: list[list[float]] | None = None,
        depth: list[float] | None = None,
        split: bool = True,
        smooth: bool = True,
    ) -> None:
        """Layers are 0 back, 1 fore, 2 + part. Raises ValueError when arrays do not fit or landmarks span no face."""

    @property
    def rest_vertices(self) -> Array: ...
    @property
    def triangles(self) -> NDArray[np.uintp]: ...
    @property
    def n_paths(self) -> int: ...
    def rest_path(self, path: int) -> Array: ...
    def vertices(self, articulators: list[float], offsets: Array | None = None) -> tuple[Array, float, list[int]]:
        """Vertices [V, 2], the kept share of the motion, and the triangles that limit it."""

    def frame(self, vertices: Array, since: Array | None = None) -> tuple[NDArray[np.uintp], NDArray[np.uintp], Array]:
        """Changed paths, the starts (one more) of their points, and the points."""

    def openings(self, vertices: Array) -> list[Array]: ...

# ---------------------------------------------------------------- smil

def animated_svg(
    rig: Rig,
    size: tuple[float, float],
    canvas: list[int],
    layers: tuple[int, int],
    openings: list[int],
    fills: Array,
    axes: Array,
    vertices: Array,
    duration: float,
    tolerance: float,
    looped: bool,
    title: str,
    description: str,
) -> str:
    """Animated SVG of a rigged scene.

    `layers`: numbers of back and fore paths; `openings` [n_local]; `fills` [n, 13]: 0 solid or 1 linear, then red, green,
    blue (0…255) and opacity of three stops; `axes` [2n, 2]: gradient ends at rest; `vertices` [frames, V, 2], evenly over
    `duration` seconds; `tolerance` in portrait pixels. Raises ValueError when they do not fit together.
    """

def follow_gradients(
    rig: Rig, changed: NDArray[np.uintp], starts: NDArray[np.uintp], points: Array, axes: Array
) -> Array:
    """Ends [2k, 2] of the gradients of the k changed paths of a frame, from their rest ends `axes` [2n, 2]."""

# ---------------------------------------------------------------- raster

Floats = NDArray[np.float32]
Flags = NDArray[np.bool_] | NDArray[np.uint8]
Gradients = tuple[NDArray[np.float64], Floats, Floats, Floats, Floats, NDArray[np.float64] | None]

class Target:
    """A picture to compare with, laid out once for all passes: `Σ weight·|C − target|² / 3HW`."""

    def __init__(self, target: Floats, weight: Floats) -> None:
        """`target` [H, W, 3], `weight` [H, W]. Raises ValueError when they do not fit or are not finite."""

def rasterize(
    points: Floats,
    stops: Floats,
    axis: Floats,
    gradient: Flags,
    clip: NDArray[np.int32],
    clips: Floats,
    canvas: Floats,
    width: int,
    height: int,
    subrows: int = 1,
    threads: int = 0,
    quantise: bool = False,
    flatness: float = 0.05,
) -> Floats:
    """Picture [H, W, 3] of paths in painter's order.

    `points` [n, 3S, 2] pixels; `stops` [n, 3, 4] RGBA in [0, 1], unpremultiplied, at start, middle and end of `axis` [n, 4] x1, y1, x2, y2;
    `gradient` [n]: linear fill, else the first stop alone; `clip` [n]: mask of `clips` [k, H, W] multiplying opacity,
    −1 for none; `canvas` [3]. `subrows` 1, 2 or 4: over how many rows of a pixel the nonzero rule is resolved.
    `flatness` (0.001 to 1): px that a chord may stray from its cubic. `quantise`: round to 8 bits after every blend.
    `threads` 0: all cores. Raises ValueError naming value and limit.
    """

def rasterize_stack(
    points: Floats,
    stops: Floats,
    axis: Floats,
    gradient: Flags,
    clip: NDArray[np.int32],
    clips: Floats,
    canvas: Floats,
    width: int,
    height: int,
    heights: Sequence[int],
    subrows: int = 1,
    threads: int = 0,
    flatness: float = 0.05,
) -> Floats:
    """Pictures [len(heights), H, W, 3] of the lowest paths, as many as each of the ascending `heights` says, in one pass."""

def preview(
    points: Floats,
    stops: Floats,
    axis: Floats,
    gradient: Flags,
    clip: NDArray[np.int32],
    clips: Floats,
    canvas: Floats,
    width: int,
    height: int,
    threads: int = 0,
) -> Floats:
    """Picture [H, W, 3] as resvg paints it: edges sampled on a grid of quarter pixels, every blend rounded as it rounds.

    The same arguments as `rasterize`; values are multiples of 1/255. Raises ValueError naming value and limit.
    """

def loss_and_gradients(
    points: Floats,
    stops: Floats,
    axis: Floats,
    gradient: Flags,
    clip: NDArray[np.int32],
    clips: Floats,
    canvas: Floats,
    checkpoints: Sequence[tuple[int, Target]],
    subrows: int = 1,
    threads: int = 0,
    importance: bool = False,
    quantise: bool = False,
    picture: bool = True,
    flatness: float = 0.05,
    bands: tuple[int, int] = (1, 0),
) -> Gradients:
    """Losses [k], picture, gradients of their sum by points, stops and axis, and (if asked for) importance [n].

    A checkpoint (paths below, target) compares the picture of the lowest paths with a target. Checkpoints ascend by paths below. Importance is the exact rise of the summed loss
    if the path were removed. Without `picture` the picture is [0, 0, 3]. Gradients pass straight through the rounding of `quantise`.
    `bands` (every, first): only these bands of 16 rows are looked at and stand for all, so that sums over pixels are
    right on the mean over all `first` < `every`.
    """

def gradients(
    points: Floats,
    stops: Floats,
    axis: Floats,
    gradient: Flags,
    clip: NDArray[np.int32],
    clips: Floats,
    canvas: Floats,
    grad_image: Floats,
    subrows: int = 1,
    threads: int = 0,
    quantise: bool = False,
    flatness: float = 0.05,
) -> Gradients:
    """As `loss_and_gradients` for any loss, given its gradient `grad_image` [H, W, 3] by the picture; no losses."""

def coherent_energy(residual: Floats, weight: Floats, reach: int) -> Floats:
    """|box mean of weight · residual|² [H, W] of `residual` [H, W, 3], `weight` [H, W]; boxes of 2·reach + 1 px a side.

    Outside the picture the residual is zero.
    """

def contour(field: Floats, x: int, y: int, level: float) -> tuple[NDArray[np.bool_], Floats] | None:
    """The 4-connected component of `field` [H, W] > `level` that holds pixel (x, y), None if that one is not above it.

    Returns its pixels [H, W] and its outer border as a polygon [m, 2] without a repeated point, pixel centres at integers,
    interpolated as marching squares does.
    """

def adam_step(
    values: Floats,
    gradient: Floats,
    first: Floats,
    second: Floats,
    age: NDArray[np.int64],
    rate: Floats,
    least: Floats,
    most: Floats,
    betas: tuple[float, float],
    epsilon: float,
) -> None:
    """One step of Adam in place on `values` [n, …] and their `first` and `second` moments, each row of its own `age` [n].

    `rate`, `least`, `most` [m]: step sizes and limits of the m values of a row.
    """

def coverage(points: Floats, width: int, height: int) -> Floats:
    """Coverage [H, W] of one closed path [3S, 2], resolved over 4 sub-rows."""

def overlap(points: Floats, width: int, height: int, threads: int = 0) -> NDArray[np.float64]:
    """Areas of every path in pixels, [n, 3]: covered; wound around more than once; wound against its main direction."""
