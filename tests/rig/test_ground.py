"""The ground of the back layer: whatever a pose moves, nothing of what lies behind the picture shows."""

from __future__ import annotations

import numpy as np
import pytest
import vectortalker_core as core
from vectortalker.animate.frames import FrameRenderer, frame_size
from vectortalker.animate.rigged import frame_points, rig_scene
from vectortalker.bench.portraits import REPOSITORY, sitters
from vectortalker.scene import STOPS, empty_layer
from vectortalker.schema import Pose, VectorizeOptions
from vectortalker.vectorize import vectorize
from vectortalker.vectorize.ground import with_ground

POSES = (
    {},
    {"jaw": 1, "round": 1},
    {"smile": 1, "blink_left": 1, "blink_right": 1},
    {"yaw": 15, "pitch": 10, "roll": 15},
    {"yaw": -15, "pitch": -10, "roll": -15},
)


@pytest.mark.parametrize("segments", [3, 4, 8, 32])
@pytest.mark.parametrize("size", [(64, 64), (40, 90)])
def test_ground_covers_every_pixel(segments: int, size: tuple[int, int]) -> None:
    canvas = np.array([0.2, 0.4, 0.6], np.float32)
    ground = with_ground(empty_layer(segments), canvas, *size)
    assert (core.coverage(ground.points[0], *size) > 1 - 1e-6).all()
    np.testing.assert_array_equal(ground.stops[0], np.tile([*canvas, 1], (STOPS, 1)).astype(np.float32))


def test_no_pose_shows_what_lies_behind() -> None:
    (sitter,) = sitters([REPOSITORY / "public/samples/mona-lisa.jpg"])
    assert sitter.landmarks is not None
    options = VectorizeOptions(paths=24, levels=2, iterations=10, final_iterations=10, working_size=96)
    run = vectorize(sitter.portrait, sitter.landmarks, options, threads=1)
    while True:
        try:
            next(run)
        except StopIteration as end:
            scene = end.value.scene
            break
    assert len(scene.back) + len(scene.fore) + len(scene.local) == 24
    rigged = rig_scene(scene, sitter.landmarks)
    size = frame_size(rigged.drawing, 256, even=False)
    magenta, green = (FrameRenderer(rigged.drawing, size, colour) for colour in ("#ff00ff", "#00ff00"))
    for articulators in POSES:
        points = frame_points(rigged, rigged.rig.vertices(Pose(articulators=articulators)).vertices)
        np.testing.assert_array_equal(magenta.render(points), green.render(points))
