"""The picture against an independent renderer of the same SVG."""

import io

import numpy as np
import pytest
import resvg_py
import vectortalker_core as core
from PIL import Image
from scipy.ndimage import maximum_filter

from tests.raster.scenes import Scene, blobs, paint

SIZE = 160


def svg_of(scene: Scene) -> str:
    def css(rgba: np.ndarray) -> str:
        return "rgb(" + ",".join(f"{255 * v:.4f}" for v in rgba[:3]) + ")"

    parts = [f'<rect width="{SIZE}" height="{SIZE}" fill="{css(scene.canvas)}"/>']
    for i, ring in enumerate(scene.points):
        d = f"M{ring[0, 0]} {ring[0, 1]}"
        for j in range(0, len(ring), 3):
            d += "C" + " ".join(f"{x} {y}" for x, y in ring[[j + 1, j + 2, (j + 3) % len(ring)]])
        (x1, y1, x2, y2), stops = scene.axis[i], scene.stops[i]
        if scene.gradient[i]:
            shades = [
                f'<stop offset="{k / 2}" stop-color="{css(s)}" stop-opacity="{s[3]}"/>' for k, s in enumerate(stops)
            ]
            place = f'gradientUnits="userSpaceOnUse" x1="{x1}" y1="{y1}" x2="{x2}" y2="{y2}"'
            parts.append(f'<linearGradient id="g{i}" {place}>{"".join(shades)}</linearGradient>')
            parts.append(f'<path d="{d}z" fill="url(#g{i})"/>')
        else:
            parts.append(f'<path d="{d}z" fill="{css(stops[0])}" fill-opacity="{stops[0, 3]}"/>')
    return f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {SIZE} {SIZE}">{"".join(parts)}</svg>'


def painted_by_resvg(scene: Scene) -> np.ndarray:
    """Picture [H, W, 3] in [0, 255]."""
    png = resvg_py.svg_to_bytes(svg_string=svg_of(scene), width=SIZE, height=SIZE)
    return np.asarray(Image.open(io.BytesIO(bytes(png))).convert("RGB"), float)


def test_same_colours_away_from_edges() -> None:
    scene = blobs(0, 12, SIZE, SIZE, (15, 50))
    theirs = painted_by_resvg(scene)
    ours = np.rint(255 * paint(scene, SIZE, SIZE, subrows=4, quantise=True))
    inside = np.ones((SIZE, SIZE), bool)
    for ring in scene.points:
        partial = (cover := core.coverage(ring, SIZE, SIZE)) * (1 - cover) > 0
        inside &= ~maximum_filter(partial, 3)
    assert inside.mean() > 0.5
    assert abs(ours - theirs)[inside].max() <= 2
    assert abs(ours - theirs).mean() < 1  # edges too: resvg samples coverage 4×4


@pytest.mark.parametrize("seed", range(4))
def test_preview_rounds_and_samples_as_resvg_does(seed: int) -> None:
    scene = blobs(seed, 12, SIZE, SIZE, (15, 50))
    theirs = painted_by_resvg(scene)
    preview = 255 * core.preview(**scene.arguments(), width=SIZE, height=SIZE)
    exact = 255 * paint(scene, SIZE, SIZE, subrows=4)
    assert abs((preview - theirs).mean()) < 0.1  # the exact picture is half a level to a whole one darker
    assert np.sqrt(((preview - theirs) ** 2).mean()) < 0.5 * np.sqrt(((exact - theirs) ** 2).mean())
