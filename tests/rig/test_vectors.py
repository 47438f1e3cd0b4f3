"""Golden: Python gives the rig vectors that Rust and TypeScript give too."""

import json
from pathlib import Path

import numpy as np
import pytest
from vectortalker.rig import build_rig, fit_pins
from vectortalker.schema import Landmarks, Pose, Scene

VECTORS = json.loads((Path(__file__).parents[1] / "vectors/rig/face.json").read_text())
TOLERANCE = 1e-6  # px; the numbers are written to 1e-9


@pytest.mark.parametrize("index", range(len(VECTORS["frames"])))
def test_posed_frames_match_the_vectors(index: int) -> None:
    expected = VECTORS["frames"][index]
    rig = build_rig(
        Scene.model_validate(VECTORS["scene"]),
        Landmarks.model_validate(VECTORS["landmarks"]),
    )
    posed = rig.vertices(Pose.model_validate(expected["pose"]))
    moved = rig.moved_points(posed.vertices)
    assert posed.scale == pytest.approx(expected["scale"])
    np.testing.assert_allclose(posed.vertices.ravel(), expected["vertices"], atol=TOLERANCE)
    assert [str(path) for path in moved] == list(expected["changed"])
    for path, points in moved.items():
        np.testing.assert_allclose(points.ravel(), expected["changed"][str(path)], atol=TOLERANCE)


def test_pins_fit_the_vectors_landmarks() -> None:
    fitted = fit_pins(VECTORS["pins"])
    assert fitted is not None
    np.testing.assert_allclose(fitted.points, VECTORS["landmarks"]["points"], atol=TOLERANCE)
