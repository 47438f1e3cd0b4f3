"""Raw 68-point rows `t,x0,y0,…,x67,y67` of a tracked face become a landmark track, and points become such rows.

The neutral face is the row whose lips are nearest to closed among those whose eyes are open; offsets from it are in
units of its outer-eye distance. Head motion stays in the track.
"""

from __future__ import annotations

import io

import numpy as np
from numpy.typing import NDArray

from vectortalker.errors import VectorTalkerError
from vectortalker.schema import N_LANDMARKS, Track

COLUMNS = 1 + 2 * N_LANDMARKS
MAX_FPS = 240.0
MAX_FRAMES = 100_000  # after resampling: over an hour at 25 fps
OUTER_EYES = (36, 45)
INNER_LIPS = ((61, 67), (62, 66), (63, 65))  # upper and lower points
LIDS = ((37, 41), (38, 40), (43, 47), (44, 46))
MIN_EYE_DISTANCE = 1e-6  # in the unit of the file; below this there is no face

MAX_VALUE = 1e9  # no picture and no clock needs more, and no square overflows

Points = NDArray[np.float64]  # [frames, 68, 2]


def from_csv(text: str, name: str) -> Track:
    """Times in seconds, ascending; resampled to even steps of the median step. Raises `bad_track`."""
    times, points = _rows(text, name)
    fps = min(MAX_FPS, 1 / float(np.median(np.diff(times))))
    n_frames = round(float(times[-1] - times[0]) * fps) + 1
    if n_frames > MAX_FRAMES:
        raise _bad(f"{name} lasts {times[-1] - times[0]:g} s, {n_frames} frames of {fps:g} fps; limit: {MAX_FRAMES}.")
    even = times[0] + np.arange(n_frames) / fps
    flat = points.reshape(len(times), -1)
    resampled = np.stack([np.interp(even, times, column) for column in flat.T], axis=1).reshape(-1, N_LANDMARKS, 2)
    return track_of_points(resampled, fps, name)


def track_of_points(points: Points, fps: float, name: str) -> Track:
    """Frames of a face in any unit, y down, as offsets from its neutral face. Raises `bad_track`."""
    if len(points) == 0 or not np.isfinite(points).all():
        raise _bad(f"{name} has frames without finite numbers." if len(points) else f"{name} has no frames.")
    neutral = _neutral(points)
    scale = float(np.linalg.norm(neutral[OUTER_EYES[1]] - neutral[OUTER_EYES[0]]))
    if scale < MIN_EYE_DISTANCE:
        raise _bad(f"The outer eye corners of {name} coincide: it holds no face.")
    offsets = ((points - neutral) / scale).round(5)
    return Track(name=name, duration=len(points) / fps, fps=fps, landmarks=offsets.tolist())


def to_csv(points: Points, fps: float) -> str:
    """Rows of time and points, after one of column names; what `from_csv` reads."""
    names = ["t", *(f"{axis}{index}" for index in range(N_LANDMARKS) for axis in "xy")]
    table = np.column_stack([np.arange(len(points)) / fps, points.reshape(len(points), -1)])
    file = io.StringIO()
    np.savetxt(file, table, fmt="%.4f", delimiter=",", header=",".join(names), comments="")
    return file.getvalue()


def _rows(text: str, name: str) -> tuple[NDArray[np.float64], Points]:
    """Times [frames] and points; one line of column names may come first."""
    first = text.lstrip().partition("\n")[0]
    if first.count(",") != COLUMNS - 1:
        raise _bad(f"{name} has {first.count(',') + 1} columns; t,x0,y0,…,x67,y67 are {COLUMNS}.")
    has_names = not _is_number(first.partition(",")[0])
    try:
        table = np.loadtxt(io.StringIO(text.lstrip()), delimiter=",", skiprows=int(has_names), ndmin=2, comments=None)
    except ValueError as error:
        raise _bad(f"{name} has a row that cannot be read ({error}).") from error
    if len(table) < 2:
        raise _bad(f"{name} has {len(table)} rows; a track needs 2.")
    if not np.isfinite(table).all():
        row, column = np.argwhere(~np.isfinite(table))[0]
        raise _bad(f"Row {row + 1} of {name} has no finite number in column {column + 1}.")
    if np.abs(table).max() > MAX_VALUE:
        raise _bad(f"{name} has values beyond {MAX_VALUE:g}.")
    if (np.diff(table[:, 0]) <= 0).any():
        raise _bad(f"The times of {name} do not ascend.")
    return table[:, 0], table[:, 1:].reshape(-1, N_LANDMARKS, 2)


def _neutral(points: Points) -> NDArray[np.float64]:
    eyes = _gap(points, LIDS)
    lips = np.where(eyes >= np.median(eyes), _gap(points, INNER_LIPS), np.inf)
    return points[int(np.argmin(lips))]


def _gap(points: Points, pairs: tuple[tuple[int, int], ...]) -> NDArray[np.float64]:
    """Mean distance of the pairs of points, by frame."""
    upper, lower = (list(side) for side in zip(*pairs, strict=True))
    return np.linalg.norm(points[:, upper] - points[:, lower], axis=-1).mean(axis=-1)


def _is_number(field: str) -> bool:
    try:
        float(field)
    except ValueError:
        return False
    return True


def _bad(message: str) -> VectorTalkerError:
    return VectorTalkerError("bad_track", message)
