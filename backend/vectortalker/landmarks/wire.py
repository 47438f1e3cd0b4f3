"""Detected faces become the contract's `Faces`."""

from __future__ import annotations

from collections.abc import Sequence

from vectortalker import schema
from vectortalker.landmarks.faces import FaceDetection


def to_wire(detections: Sequence[FaceDetection], width: int, height: int) -> schema.Faces:
    """`width` and `height` are the portrait's; the order (largest first) is kept."""
    return schema.Faces(width=width, height=height, faces=[_face(detection) for detection in detections])


def _face(detection: FaceDetection) -> schema.Face:
    x, y, width, height = detection.box
    left, right = (schema.Iris(centre=disc.centre, radius=disc.radius) for disc in detection.irises)
    landmarks = schema.Landmarks(
        points=[(float(px), float(py)) for px, py in detection.points],
        irises=(left, right),
        depth=[float(z) for z in detection.depth],
    )
    return schema.Face(
        box=schema.Box(x=x, y=y, width=width, height=height),
        landmarks=landmarks,
        confidence=detection.confidence,
        fit_advised=detection.fit_advised,
    )
