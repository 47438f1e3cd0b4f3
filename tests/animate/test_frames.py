"""Frames painted by Skia against the static SVG painted by resvg, another program."""

from __future__ import annotations

import io

import numpy as np
import pytest
import resvg_py
from PIL import Image
from scipy.ndimage import binary_dilation
from vectortalker.animate.frames import FrameRenderer, Rgba, frame_size, render_frame
from vectortalker.animate.rigged import (
    RiggedScene,
    frame_points,
    rig_scene,
    vertices_at,
)
from vectortalker.svg import to_svg

from tests.animate.scenes import project, scene, track

SIZE = (480, 600)
FLAT = 2  # of 255: rounding of opacities and gradients
EDGE = 3  # pixels; curves are flattened and their coverage counted differently


@pytest.fixture(scope="module")
def rigged() -> RiggedScene:
    portrait = project()
    assert portrait.landmarks is not None
    return rig_scene(portrait.scene, portrait.landmarks)


def painted_by_resvg(svg: str) -> Rgba:
    png = bytes(resvg_py.svg_to_bytes(svg_string=svg, width=SIZE[0], height=SIZE[1]))
    return np.asarray(Image.open(io.BytesIO(png)).convert("RGBA"))


def near_edges(picture: Rgba) -> np.ndarray:
    """Pixels within `EDGE` of a step between neighbours that no gradient makes."""
    values = picture[..., :3].astype(int)
    steps = np.zeros(picture.shape[:2], bool)
    steps[:, 1:] |= np.abs(np.diff(values, axis=1)).max(axis=2) > 4
    steps[1:] |= np.abs(np.diff(values, axis=0)).max(axis=2) > 4
    return binary_dilation(steps, iterations=EDGE)


def test_rest_frame_looks_like_the_static_svg(rigged: RiggedScene) -> None:
    openings = rigged.rig.openings(rigged.rig.rest_vertices)
    expected = painted_by_resvg(to_svg(scene(), openings, "rest", SIZE))
    actual = render_frame(rigged.drawing, rigged.rest, SIZE)
    inside = ~near_edges(expected)
    assert inside.mean() > 0.7
    assert np.abs(actual.astype(int) - expected)[inside].max() <= FLAT


def test_rest_pose_is_the_rest_frame(rigged: RiggedScene) -> None:
    assert np.array_equal(frame_points(rigged, rigged.rig.rest_vertices), rigged.rest)


def test_frames_do_not_depend_on_those_before(rigged: RiggedScene) -> None:
    frames = [frame_points(rigged, vertices) for vertices in vertices_at(rigged, track(), np.array([0.1, 0.5, 0.9]))]
    renderer = FrameRenderer(rigged.drawing, SIZE)
    for points in [*frames, frames[0]]:
        assert np.array_equal(renderer.render(points), render_frame(rigged.drawing, points, SIZE))


def test_opaque_layers_hide_the_background_in_every_frame(rigged: RiggedScene) -> None:
    """What is head at rest stays head: no seam or hole shows another canvas through the opaque lips."""
    lips = rigged.drawing.bounds[4:6]
    for vertices in vertices_at(rigged, track(), np.linspace(0, 1, 9)):
        points = frame_points(rigged, vertices)
        x, y = (points[lips[0] : lips[1]].mean(axis=0) * 2).astype(int)
        magenta, green = (render_frame(rigged.drawing, points, SIZE, colour) for colour in ("#ff00ff", "#00ff00"))
        assert np.array_equal(magenta[y, x], green[y, x])


def test_frame_sizes_are_even_for_video(rigged: RiggedScene) -> None:
    assert frame_size(rigged.drawing, 334, even=True) == (268, 334)  # 267.2 wide
    assert frame_size(rigged.drawing, 334, even=False) == (267, 334)
