"""Types of the Rust core."""

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

    def frame(
        self, vertices: Array, since: Array | None = None
    ) -> tuple[NDArray[np.uintp], NDArray[np.uintp], Array]:
        """Changed paths, the starts (one more) of their points, and the points."""

    def openings(self, vertices: Array) -> list[Array]: ...
