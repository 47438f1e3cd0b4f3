"""Small layered portraits made from numbers alone."""

from __future__ import annotations

import math

import numpy as np
from vectortalker.schema import (
    Landmarks,
    LinearFill,
    LocalPath,
    Part,
    Project,
    Scene,
    ScenePath,
    SolidFill,
    Stop,
    Track,
)

WIDTH, HEIGHT = 240.0, 300.0


def blob(x: float, y: float, radius: float, segments: int = 6) -> list[float]:
    """Points of a closed chain of cubics about (x, y), a little uneven."""
    turn = np.arange(3 * segments) / (3 * segments) * math.tau
    reach = radius * (1 + 0.1 * np.sin(3 * turn))
    return np.stack([x + reach * np.cos(turn), y + reach * np.sin(turn)], axis=1).round(2).ravel().tolist()


def landmarks() -> Landmarks:
    """A frontal face with closed lips and open eyes in iBUG order, in the middle of the picture."""
    jaw = [(120 - 70 * math.cos(a), 140 + 95 * math.sin(a)) for a in np.linspace(0, math.pi, 17)]
    brows = [(x, 112 - 6 * math.sin((x - x0) / 36 * math.pi)) for x0 in (66, 138) for x in np.linspace(x0, x0 + 36, 5)]
    nose = [(120, y) for y in (128, 142, 156, 170)] + [(x, 178) for x in (106, 113, 120, 127, 134)]
    eyes = [(x + dx, 130 + dy) for x in (72, 140) for dx, dy in ((0, 0), (9, -6), (19, -6), (28, 0), (19, 5), (9, 5))]
    lips = [
        (90, 205),
        (100, 199),
        (112, 196),
        (120, 198),
        (128, 196),
        (140, 199),
        (150, 205),
    ]
    lips += [(140, 212), (128, 216), (120, 217), (112, 216), (100, 212)]
    inner = [
        (94, 205),
        (110, 204),
        (120, 204),
        (130, 204),
        (146, 205),
        (130, 205),
        (120, 205),
        (110, 205),
    ]
    return Landmarks(points=[(float(x), float(y)) for x, y in [*jaw, *brows, *nose, *eyes, *lips, *inner]])


def scene() -> Scene:
    """Backdrop, head, cheeks, lips, eyes and mouth; solid and gradient, opaque and translucent fills."""
    skin = LinearFill(
        start=(80, 60),
        end=(160, 240),
        stops=[Stop(colour="#f0c8a8"), Stop(colour="#a87858", opacity=0.8)],
    )
    fore = [ScenePath(points=blob(120, 150, 95), fill=skin)]
    fore += [ScenePath(points=blob(x, 170, 24), fill=SolidFill(colour="#e08080", opacity=0.4)) for x in (75, 165)]
    fore += [ScenePath(points=blob(120, 206, 30), fill=SolidFill(colour="#b04048"))]
    local = [_local(part, x, 130, r, colour) for part, x, r, colour in EYES] + [
        _local("mouth_cavity", 120, 210, 40, "#301010"),
        _local("mouth_lower", 120, 232, 18, "#e8e0d8"),
        _local("mouth_upper", 120, 196, 18, "#f0ece4"),
    ]
    back = [ScenePath(points=blob(60, 60, 90), fill=SolidFill(colour="#5080b0"))]
    return Scene(width=WIDTH, height=HEIGHT, canvas="#304050", back=back, fore=fore, local=local)


EYES: tuple[tuple[Part, float, float, str], ...] = (
    ("left_eye", 86, 20, "#f8f4f0"),
    ("left_iris", 86, 6, "#304060"),
    ("right_eye", 154, 20, "#f8f4f0"),
    ("right_iris", 154, 6, "#304060"),
)


def _local(part: Part, x: float, y: float, radius: float, colour: str) -> LocalPath:
    return LocalPath(points=blob(x, y, radius), fill=SolidFill(colour=colour), part=part)


def project() -> Project:
    return Project(name="Test & Co", scene=scene(), landmarks=landmarks())


def track(duration: float = 1.0) -> Track:
    """Speaks, blinks once in the middle, and tilts its head."""
    fps = 25.0
    time = np.arange(round(duration * fps)) / fps
    channels = {
        "jaw": np.abs(np.sin(9 * time)),
        "blink_left": np.exp(-(((time - duration / 2) / 0.1) ** 2)),
        "blink_right": np.exp(-(((time - duration / 2) / 0.1) ** 2)),
        "roll": 10 * np.sin(time / duration * math.tau),
    }
    articulators = {name: values.round(4).tolist() for name, values in channels.items()}
    return Track(duration=duration, fps=fps, articulators=articulators)
