"""Writes `face.json`, the rig vectors that Rust, Python and TypeScript must all reproduce.

Look at the difference before committing it. Run: python tests/vectors/rig/write.py
"""

import json
import math
from pathlib import Path

import numpy as np
from vectortalker.rig import build_rig, fit_pins
from vectortalker.schema import Pose, Scene

PINS = [(150, 160), (250, 165), (200, 220), (165, 265), (237, 268)]
POSES = [
    {"articulators": {"jaw": 0.8, "smile": 0.4}},
    {
        "articulators": {
            "blink_left": 1,
            "blink_right": 0.5,
            "gaze_x": -0.7,
            "brow_left": 1,
        }
    },
    {"articulators": {"yaw": 12, "pitch": -6, "roll": 9, "press": 0.6}},
    {
        "articulators": {},
        "offsets": [[0.05 * math.sin(i), 0.04 * math.cos(2 * i)] for i in range(68)],
    },
]


def blob(x: float, y: float, rx: float, ry: float) -> list[float]:
    """Closed chain of four arcs, flat."""
    k = 0.55
    ring = [
        (1, 0),
        (1, k),
        (k, 1),
        (0, 1),
        (-k, 1),
        (-1, k),
        (-1, 0),
        (-1, -k),
        (-k, -1),
        (0, -1),
        (k, -1),
        (1, -k),
    ]
    return [round(value, 3) for u, v in ring for value in (x + rx * u, y + ry * v)]


def main() -> None:
    grey = {"kind": "solid", "colour": "#808080"}
    scene = {
        "width": 400,
        "height": 400,
        "canvas": "#ffffff",
        "back": [{"points": blob(200, 200, 150, 150), "fill": grey}],
        "fore": [{"points": blob(140 + 30 * i, 150 + 35 * i, 60, 25 + i), "fill": grey} for i in range(5)],
        "local": [
            {"points": blob(x, y, 12, 6), "fill": grey, "part": part}
            for x, y, part in [
                (150, 160, "left_eye"),
                (250, 165, "right_iris"),
                (200, 268, "mouth_cavity"),
                (200, 272, "mouth_lower"),
                (200, 275, "tongue"),
                (200, 262, "mouth_upper"),
            ]
        ],
    }
    landmarks = fit_pins(PINS)
    assert landmarks is not None
    rig = build_rig(Scene.model_validate(scene), landmarks)
    frames = []
    for pose in POSES:
        posed = rig.vertices(Pose.model_validate(pose))
        moved = rig.moved_points(posed.vertices)
        frames.append(
            {
                "pose": pose,
                "scale": posed.scale,
                "vertices": np.round(posed.vertices, 9).ravel().tolist(),
                "changed": {str(path): np.round(points, 9).ravel().tolist() for path, points in moved.items()},
            }
        )
    document = {
        "scene": scene,
        "pins": PINS,
        "landmarks": landmarks.model_dump(),
        "frames": frames,
    }
    Path(__file__).with_name("face.json").write_text(json.dumps(document) + "\n")


if __name__ == "__main__":
    main()
