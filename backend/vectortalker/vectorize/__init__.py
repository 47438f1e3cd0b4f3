"""Progressive vectorisation: a portrait becomes a layered scene of closed cubic paths, level by level."""

from vectortalker.vectorize.job import vectorize
from vectortalker.vectorize.options import Settings, resolve
from vectortalker.vectorize.progress import Checkpoint, Progress, Result

__all__ = ["Checkpoint", "Progress", "Result", "Settings", "resolve", "vectorize"]
