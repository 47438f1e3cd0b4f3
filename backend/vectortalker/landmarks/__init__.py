"""A picture becomes faces: 68 iBUG landmarks, irises and depth, by a detector and a face mesh run in onnxruntime."""

from vectortalker.landmarks.faces import FaceDetection, detect
from vectortalker.landmarks.ibug import IrisDisc
from vectortalker.landmarks.wire import to_wire

__all__ = ["FaceDetection", "IrisDisc", "detect", "to_wire"]
