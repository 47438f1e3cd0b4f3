"""One portrait and one way of vectorising become a row of figures and a picture to look at."""

from __future__ import annotations

import resource
import time
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from vectortalker import metrics
from vectortalker.bench.lpips import Lpips
from vectortalker.bench.portraits import Sitter
from vectortalker.bench.tracers import TRACERS, n_segments
from vectortalker.decode import canonical
from vectortalker.schema import Metrics, VectorizeOptions
from vectortalker.vectorize import vectorize


@dataclass(frozen=True)
class Row:
    """Figures of one run. `lpips` None where the network is absent; `peak_bytes` of the whole process so far."""

    portrait: str
    way: str
    metrics: Metrics
    lpips: float | None
    eyes_and_mouth_psnr: float | None
    peak_bytes: int


@dataclass(frozen=True)
class Run:
    """A row with the picture u8 [H, W, 3] that resvg paints, the canonical image, and the SVG text."""

    row: Row
    picture: NDArray[np.uint8]
    target: NDArray[np.uint8]
    svg: str


def run_recipe(way: str, sitter: Sitter, options: VectorizeOptions, lpips: Lpips | None) -> Run:
    """Vectorise to the end."""
    steps = vectorize(sitter.portrait, sitter.landmarks, options)
    while True:
        try:
            next(steps)
        except StopIteration as end:
            result = end.value
            break
    return _run(way, sitter, result.svg, result.metrics, options.working_size or 512, lpips)


def run_tracer(way: str, sitter: Sitter, side: int, lpips: Lpips | None) -> Run:
    """Trace the canonical image of long side `side` with one of `TRACERS`."""
    target = canonical(sitter.portrait, side)
    height, width, _ = target.shape
    clock, cpu_clock = time.perf_counter(), _cpu_seconds()
    svg = TRACERS[way](target)
    seconds, cpu_seconds = time.perf_counter() - clock, _cpu_seconds() - cpu_clock
    painted = metrics.render(svg, width, height)
    squared_error = metrics.mse(painted, target)
    size, gzip_size = metrics.file_sizes(svg)
    figures = Metrics(
        paths=svg.count("<path"),
        segments=n_segments(svg),
        parameters=0,
        iterations=0,
        seconds=seconds,
        cpu_seconds=cpu_seconds,
        bytes=size,
        gzip_bytes=gzip_size,
        mse=squared_error,
        psnr=metrics.psnr(squared_error),
        ssim=metrics.ssim(painted, target),
    )
    return _run(way, sitter, svg, figures, side, lpips)


def _cpu_seconds() -> float:
    """Of this process and of the programs that it has run."""
    usages = (resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return sum(usage.ru_utime + usage.ru_stime for usage in usages)


def _run(way: str, sitter: Sitter, svg: str, figures: Metrics, side: int, lpips: Lpips | None) -> Run:
    target = canonical(sitter.portrait, side)
    picture = metrics.render(svg, target.shape[1], target.shape[0])
    distance = lpips.distance(picture, target) if lpips else None
    features = _eyes_and_mouth_psnr(picture, target, sitter)
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
    return Run(Row(sitter.portrait.name, way, figures, distance, features, peak), picture, target, svg)


FEATURES = (range(36, 42), range(42, 48), range(48, 68))  # iBUG: image-left eye, image-right eye, mouth
BOX_MARGIN = 0.25  # of a feature's width, on every side


def _eyes_and_mouth_psnr(picture: NDArray[np.uint8], target: NDArray[np.uint8], sitter: Sitter) -> float | None:
    """PSNR over the boxes of eyes and mouth; None without landmarks."""
    if sitter.landmarks is None:
        return None
    scale = np.array([target.shape[1] / sitter.portrait.width, target.shape[0] / sitter.portrait.height])
    points = np.array(sitter.landmarks.points) * scale
    inside = np.zeros(target.shape[:2], bool)
    for feature in FEATURES:
        low, high = points[list(feature)].min(axis=0), points[list(feature)].max(axis=0)
        margin = BOX_MARGIN * (high[0] - low[0])
        (x0, y0), (x1, y1) = np.maximum(low - margin, 0).astype(int), np.ceil(high + margin).astype(int)
        inside[y0 : y1 + 1, x0 : x1 + 1] = True
    return metrics.psnr(metrics.mse(picture[inside], target[inside])) if inside.any() else None
