"""Turns a stream of frames into a looping GIF or a folder of PNGs, by Pillow."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np
from PIL import Image

from vectortalker.animate.frames import Rgba

GIF_COLOURS = 256
GIF_TICK = 0.01  # seconds; GIF knows no finer time
GIF_FPS_LIMIT = 50.0  # browsers slow shorter delays than two ticks down to ten


def write_gif(frames: Iterable[Rgba], path: Path, fps: float, palette_frames: Sequence[Rgba]) -> None:
    """Looping GIF at `fps` (at most `GIF_FPS_LIMIT`); the palette, shared by all frames, is made for `palette_frames`.

    Colours are not dithered: flat fills stay flat, and the unchanged parts of a frame cost nothing.
    """
    palette = _palette(palette_frames)
    images = (
        Image.fromarray(frame).convert("RGB").quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames
    )
    first = next(images)
    first.save(
        path, format="GIF", save_all=True, append_images=images, duration=_gif_delay(fps), loop=0, optimize=False
    )


def write_pngs(frames: Iterable[Rgba], folder: Path) -> None:
    """`frame-00000.png`, `frame-00001.png`, … in `folder`, which exists."""
    for index, frame in enumerate(frames):
        Image.fromarray(frame).convert("RGB").save(folder / f"frame-{index:05}.png", compress_level=3)


def gif_fps(fps: float) -> float:
    """Nearest frame rate to `fps` that whole ticks between frames allow."""
    return 1000 / _gif_delay(fps)


def _gif_delay(fps: float) -> int:
    """Milliseconds between frames, a multiple of the tick."""
    return round(1 / (min(fps, GIF_FPS_LIMIT) * GIF_TICK)) * round(1000 * GIF_TICK)


def _palette(frames: Sequence[Rgba]) -> Image.Image:
    """Paletted image of the `GIF_COLOURS` colours that stand best for all of `frames`."""
    strip = np.concatenate([frame[::2, ::2, :3] for frame in frames])
    return Image.fromarray(strip).quantize(GIF_COLOURS, method=Image.Quantize.MEDIANCUT)
