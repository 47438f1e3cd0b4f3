"""Types of the Rust core."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

# ---------------------------------------------------------------- geometry

def opening_outlines(landmarks: Array) -> list[tuple[str, Array, bool]]:
    """Outlines of `left_eye`, `right_eye` and `mouth` for landmarks [68, 2] at rest: (name, points [3S, 2], closed).

    Points are a closed chain `anchor, handle, handle, …`, linear in the landmarks. A closed opening has zero area.
    """
