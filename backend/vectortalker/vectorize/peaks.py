"""Residuals become seed centres: where the error agrees in sign over a disc, one flat shape can remove it."""

from __future__ import annotations

import numpy as np
import vectortalker_core as core
from numpy.typing import NDArray

BLUR = 0.8  # half side of the averaging box, in radii of the start
SPACING = 1.3  # least distance of two centres of one sheet, in radii


def coherent_energy(residual: NDArray[np.float32], weight: NDArray[np.float32], radius: float) -> NDArray[np.float32]:
    """|box mean of the weighted signed residual|², [H, W], of `residual` [H, W, 3] and `weight` [H, W].

    Texture averages out; an area of one wrong colour stays. Only what a box with any weight reaches is looked at.
    """
    reach, energy = max(0, round(BLUR * radius)), np.zeros_like(weight)
    rows, columns = (np.flatnonzero(weight.any(axis=axis)) for axis in (1, 0))
    if len(rows):
        near = tuple(slice(max(0, some[0] - reach), some[-1] + reach + 1) for some in (rows, columns))
        error, share = np.ascontiguousarray(residual[near]), np.ascontiguousarray(weight[near])
        energy[near] = core.coherent_energy(error, share, reach)
    return energy


def greedy_maxima(
    energies: NDArray[np.float32], radius: float, count: int
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """The `count` largest values of `energies` [sheets, H, W], none within `SPACING` radii of a larger of its sheet.

    Returns centres [m, 2] as x, y and sheet indices [m], largest first; m < count when no energy is left.
    """
    left = energies.copy()
    _, height, width = left.shape
    reach = max(1, round(SPACING * radius))
    disc = _disc(reach)
    rows = np.argmax(left.reshape(-1, width), axis=1)
    best_of_row = np.take_along_axis(left.reshape(-1, width), rows[:, None], axis=1)[:, 0]
    centres, sheets = [], []
    for _ in range(count):
        flat_row = int(np.argmax(best_of_row))
        if best_of_row[flat_row] <= 0:
            break
        sheet, y = divmod(flat_row, height)
        x = int(rows[flat_row])
        centres.append((x, y))
        sheets.append(sheet)
        y0, y1, x0, x1 = max(0, y - reach), min(height, y + reach + 1), max(0, x - reach), min(width, x + reach + 1)
        window = left[sheet, y0:y1, x0:x1]
        window[disc[y0 - y + reach : y1 - y + reach, x0 - x + reach : x1 - x + reach]] = 0
        touched = slice(sheet * height + y0, sheet * height + y1)
        rows[touched] = np.argmax(left[sheet, y0:y1], axis=1)
        best_of_row[touched] = np.max(left[sheet, y0:y1], axis=1)
    return np.array(centres, np.int64).reshape(-1, 2), np.array(sheets, np.int64)


def _disc(reach: int) -> NDArray[np.bool_]:
    y, x = np.ogrid[-reach : reach + 1, -reach : reach + 1]
    return x * x + y * y <= reach * reach


def error_samples(
    energies: NDArray[np.float32], count: int, generator: np.random.Generator
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Centres drawn with probability proportional to the error, as the paper's `init(errormap, n)` (supplement A)."""
    _, height, width = energies.shape
    cumulated = np.cumsum(energies, dtype=np.float64)
    flat = np.searchsorted(cumulated, generator.random(count) * cumulated[-1], side="right")
    sheets, pixel = np.divmod(np.minimum(flat, energies.size - 1), height * width)
    y, x = np.divmod(pixel, width)
    return np.stack([x, y], axis=1), sheets
