"""The paper's ablation: curves that are not split where they cross triangle edges, beside those that are.

Without splitting, a curve whose control points lie in several triangles follows none of their maps in between: borders
that lay on each other part, and shapes bulge.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from vectortalker.animate.drawing import Points
from vectortalker.animate.rigged import RiggedScene, Vertices, frame_points, rig_scene
from vectortalker.bench.portraits import Sitter
from vectortalker.bench.posed import traced
from vectortalker.bench.posed_views import VIEWS, Camera, strip
from vectortalker.bench.tables import markdown
from vectortalker.outputs import whole_file
from vectortalker.schema import Pose, Preset

MOUTH = VIEWS[1]
POSE = Pose(articulators={"jaw": 1.0, "smile": 0.5})
SAMPLES = 6  # a cubic
SEEN = 0.5  # px of a picture of 512 px
SIDE = 512
ON_EDGE = 1e-9  # barycentric
COLUMNS = ("portrait", "control points", "unsplit", "off by > .5 px", "mean of these", "worst", "split: worst")


def unsplit_table(people: Sequence[Sitter], preset: Preset, folder: Path) -> str:
    """How far the fore's curves are from the exact map in one pose, unsplit and split; a strip of pictures each."""
    folder.mkdir(parents=True, exist_ok=True)
    lines: list[list[str]] = [list(COLUMNS)]
    for sitter in people:
        if sitter.landmarks is None:
            continue
        name = Path(sitter.portrait.name).stem
        scene = traced(sitter, preset, folder / f"{name}.vtalk").scene
        split, unsplit = (rig_scene(scene, sitter.landmarks, split=on, smooth=False) for on in (True, False))
        frames = [(split, split.rest), (split, _posed(split)), (unsplit, _posed(unsplit))]
        pictures = [Camera(r, MOUTH, np.array(sitter.landmarks.points)).picture(points) for r, points in frames]
        with whole_file(folder / f"{name}-unsplit.png") as part:
            strip(len(pictures), list(zip(("rest", "split", "not split"), pictures, strict=True))).save(part)
        lines.append([name, *_cells(split, unsplit, SIDE / max(scene.width, scene.height))])
    return f"### Curves split at triangle edges, and not: jaw 1, smile .5, {preset} preset\n\n{markdown(lines)}\n"


def _posed(rigged: RiggedScene) -> Points:
    return frame_points(rigged, rigged.rig.vertices(POSE).vertices)


def _cells(split: RiggedScene, unsplit: RiggedScene, scale: float) -> list[str]:
    apart, exact = distances_from_map(unsplit) * scale, distances_from_map(split) * scale
    seen = apart[apart > SEEN]
    counts = [str(int(np.diff(r.drawing.bounds)[list(r.drawing.layers[1])].sum())) for r in (split, unsplit)]
    mean = f"{seen.mean():.1f} px" if len(seen) else "–"
    return [*counts, f"{len(seen) / len(apart):.1%}", mean, f"{apart.max():.1f} px", f"{exact.max():.2f} px"]


def distances_from_map(rigged: RiggedScene) -> Points:
    """Distances [n] of points along the fore's moved outlines from where their triangles' affine maps take them."""
    vertices = rigged.rig.vertices(POSE).vertices
    warped, bounds = _posed(rigged), rigged.drawing.bounds
    errors = [np.zeros(1)]
    for path in rigged.drawing.layers[1]:
        span = slice(bounds[path], bounds[path + 1])
        rest, now = _along(rigged.rest[span]), _along(warped[span])
        if not np.array_equal(rest, now):
            errors.append(np.linalg.norm(now - _mapped(rest, rigged, vertices), axis=1))
    distances = np.concatenate(errors)
    return distances[np.isfinite(distances)]


def _mapped(points: Points, rigged: RiggedScene, vertices: Vertices) -> Points:
    """Resting points [n, 2] under the affine maps of their triangles (slow twin of the core's bindings).

    NaN on a slit, whose two sides go different ways.
    """
    rest, triangles = rigged.rig.rest_vertices, rigged.rig.triangles
    a, b, c = (rest[triangles[:, k]][None] for k in range(3))
    p = points[:, None]
    area = _cross(b - a, c - a)
    weights = np.stack([_cross(b - p, c - p), _cross(c - p, a - p), _cross(a - p, b - p)], axis=2) / area[..., None]
    inside = weights.min(axis=2)
    holders = inside >= np.minimum(inside.max(axis=1, keepdims=True), -ON_EDGE)
    mapped = np.einsum("ntk,tkd->ntd", weights, vertices[triangles])
    low = np.where(holders[..., None], mapped, np.inf).min(axis=1)
    high = np.where(holders[..., None], mapped, -np.inf).max(axis=1)
    torn = np.abs(high - low).max(axis=1) > SEEN
    return np.where(torn[:, None], np.nan, (low + high) / 2)


def _cross(u: Points, v: Points) -> Points:
    return u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]


def _along(chain: Points) -> Points:
    """Points of a closed chain of cubics [3S, 2], `SAMPLES` a segment."""
    t = (np.arange(SAMPLES) / SAMPLES)[:, None]
    a, b, c, d = (np.roll(chain, -k, axis=0)[::3, None] for k in range(4))
    return ((1 - t) ** 3 * a + 3 * t * (1 - t) ** 2 * b + 3 * t**2 * (1 - t) * c + t**3 * d).reshape(-1, 2)
