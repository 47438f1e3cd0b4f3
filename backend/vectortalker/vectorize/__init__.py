"""Progressive vectorisation: a portrait becomes a layered scene of closed cubic paths, level by level.

vectorize(portrait: decode.Portrait, landmarks: schema.Landmarks | None, options: schema.VectorizeOptions, *,
          finish_early: Callable[[], bool], resume: Checkpoint | None) -> Generator[Progress, None, Result]
"""

from vectortalker.vectorize.options import Settings, resolve
from vectortalker.vectorize.progress import Checkpoint, Progress, Result

__all__ = ["Checkpoint", "Progress", "Result", "Settings", "resolve"]
