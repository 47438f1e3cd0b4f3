"""Turns a rigged scene and a track into the text of an animated SVG; the writer is the Rust core's."""

from __future__ import annotations

import numpy as np
import vectortalker_core as core

from vectortalker.animate.rigged import RiggedScene, vertices_at
from vectortalker.scene import STOPS, with_middle
from vectortalker.schema import Fill, LinearFill, Track

FPS = 25.0  # frames that keyframes are chosen from; the picture itself moves between them
TOLERANCE = 0.5  # portrait pixels, for portraits up to `TOLERANCE_SIDE`
TOLERANCE_SIDE = 1024.0  # the longer side that a portrait is shown with at most, nearly always


def animated_svg(rigged: RiggedScene, track: Track, title: str, *, looped: bool) -> str:
    """SVG text that plays `track` once, or over and over, and needs no script."""
    drawing = rigged.drawing
    n_frames = max(2, 1 + round(track.duration * FPS))
    times = np.linspace(0, track.duration, n_frames)
    local = drawing.layers[2]
    return core.animated_svg(
        rigged.rig.core_rig,
        size=(drawing.width, drawing.height),
        canvas=list(bytes.fromhex(drawing.canvas[1:])),
        layers=(drawing.n_back, drawing.n_fore),
        openings=drawing.openings[local.start : local.stop].tolist(),
        fills=np.array([_fill_numbers(fill) for fill in drawing.fills]).reshape(-1, 13),
        axes=rigged.axes,
        vertices=vertices_at(rigged, track, times),
        duration=track.duration,
        tolerance=tolerance_of(drawing.width, drawing.height),
        looped=looped,
        title=title,
        description=f"Animated vector portrait of {len(drawing.fills)} paths. Made with VectorTalker.",
    )


def tolerance_of(width: float, height: float) -> float:
    """Half a pixel where the longer side is shown with `TOLERANCE_SIDE` pixels, in portrait pixels."""
    return TOLERANCE * max(1.0, max(width, height) / TOLERANCE_SIDE)


def _fill_numbers(fill: Fill) -> list[float]:
    """Thirteen numbers: 0 solid or 1 linear, then red, green, blue (0…255) and opacity of three stops."""
    stops = fill.stops if isinstance(fill, LinearFill) else [fill] * STOPS
    numbers = np.array([[*bytes.fromhex(stop.colour[1:]), stop.opacity] for stop in stops])
    return [float(isinstance(fill, LinearFill)), *with_middle(numbers).ravel().tolist()]
