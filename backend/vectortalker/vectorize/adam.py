"""Adam (Kingma & Ba 2015) over arrays whose rows are paths, each with its own age.

A row's moments and bias correction start when its path does, so that new paths do not reset the old ones'. Equal to
`torch.optim.Adam` for rows of one age (tested); importing torch alone costs three CPU-s.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import vectortalker_core as core
from numpy.typing import NDArray

BETA1 = 0.9
EPSILON = 1e-12  # gradients of a mean over 3·H·W values are tiny; the customary 1e-8 would damp steps


@dataclass
class Moments:
    """First and second moments of one parameter array, same shape; updated in place."""

    first: NDArray[np.float32]
    second: NDArray[np.float32]

    @staticmethod
    def zeros(shape: tuple[int, ...]) -> Moments:
        return Moments(np.zeros(shape, np.float32), np.zeros(shape, np.float32))


def step(
    values: NDArray[np.float32],
    gradient: NDArray[np.float32],
    moments: Moments,
    age: NDArray[np.int64],
    rate: float | NDArray[np.float32],
    beta2: float,
    limits: tuple[float | NDArray[np.float32], float | NDArray[np.float32]] = (-np.inf, np.inf),
) -> None:
    """Move `values` [n, …] in place against `gradient`; `age` [n] counts each row's steps, this one included.

    `rate` and the `limits` that values are cut to may differ along the last axis.
    """
    rates, least, most = (np.broadcast_to(np.float32(of), values.shape[1:]).ravel() for of in (rate, *limits))
    core.adam_step(values, gradient, moments.first, moments.second, age, rates, least, most, (BETA1, beta2), EPSILON)
