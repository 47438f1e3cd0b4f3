"""CPU-ms of one forward and backward pass against path count and picture size, as a Markdown table.

Scenes are jittered circles that cover every pixel about three times, whatever their number. Optimised scenes have
longer outlines. Usage, on an idle machine: python tests/bench/raster_speed.py
"""

import os
import time

import numpy as np
import vectortalker_core as core
from numpy.typing import NDArray

SEGMENTS = 8
OVERDRAW = 3.0
REPEATS = 10
REFERENCE_SIDE, REFERENCE_PATHS = 512, 500
PATHS = (100, 250, 500, 1000, 2000, 4000)
SIDES = (256, 1024, 2048)


def scene(n: int, side: int, seed: int = 0) -> dict[str, NDArray[np.generic]]:
    """Arguments of the core for `n` jittered circles on a square canvas."""
    rng = np.random.default_rng(seed)
    radius = side * np.sqrt(OVERDRAW / (np.pi * n))
    turn = np.arange(SEGMENTS) * 2 * np.pi / SEGMENTS
    handle = 4 / 3 * np.tan(np.pi / SEGMENTS / 2)
    anchor, tangent = np.stack([np.cos(turn), np.sin(turn)], -1), np.stack([-np.sin(turn), np.cos(turn)], -1)
    ring = np.stack([anchor, anchor + handle * tangent, np.roll(anchor - handle * tangent, -1, 0)], 1).reshape(-1, 2)
    centre = rng.uniform(0, side, (n, 1, 2))
    points = centre + radius * ring * rng.uniform(0.7, 1.3, (n, 3 * SEGMENTS, 2))
    return {
        "points": points.astype(np.float32),
        "stops": rng.uniform(0.1, 0.9, (n, 3, 4)).astype(np.float32),
        "axis": np.concatenate([centre[:, 0] - radius, centre[:, 0] + radius], 1).astype(np.float32),
        "gradient": np.arange(n) % 2 == 0,
        "clip": np.full(n, -1, np.int32),
        "clips": np.zeros((0, side, side), np.float32),
        "canvas": np.full(3, 0.5, np.float32),
    }


def measure(n: int, side: int, threads: int, **options: int | bool | tuple[int, int]) -> tuple[float, float]:
    """Least CPU-ms of the process and least wall ms of a pass."""
    arguments = scene(n, side)
    rng = np.random.default_rng(1)
    target = rng.uniform(size=(side, side, 3)).astype(np.float32)
    checkpoints = [(n, core.Target(target, np.ones((side, side), np.float32)))]
    cpu, wall = [], []
    for _ in range(REPEATS):
        used, start = time.process_time(), time.perf_counter()
        core.loss_and_gradients(**arguments, checkpoints=checkpoints, threads=threads, picture=False, **options)
        wall.append(1e3 * (time.perf_counter() - start))
        cpu.append(1e3 * (time.process_time() - used))
    return min(cpu), min(wall)


def row(n: int, side: int) -> list[float]:
    """CPU-ms of a pass: whole, half of the bands, with importance, with four sub-rows; wall ms on all cores."""
    whole, half, weighed, fine = (
        measure(n, side, 1, **options)[0] for options in ({}, {"bands": (2, 0)}, {"importance": True}, {"subrows": 4})
    )
    return [whole, half, weighed, fine, measure(n, side, 0)[1]]


def main() -> None:
    print("| paths | px | CPU-ms | every other band | importance | 4 sub-rows | wall ms, all cores |")
    print("|---|---|---|---|---|---|---|")
    for n, side in [(n, REFERENCE_SIDE) for n in PATHS] + [(REFERENCE_PATHS, side) for side in SIDES]:
        print(f"| {n:,} | {side:,} | " + " | ".join(f"{ms:.1f}" for ms in row(n, side)) + " |", flush=True)
    print(f"\nLoad: {' '.join(f'{load:.1f}' for load in os.getloadavg())}")


if __name__ == "__main__":
    main()
