"""A patch: a path that is made, not fitted, because the picture does not show what it depicts."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Patch:
    """Closed outline [n, 2] in portrait px and its OKLab colour; it comes up from nothing along `fade` [2, 2]."""

    outline: Array
    lab: Array
    fade: Array | None = None
