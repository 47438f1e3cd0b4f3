"""Track files of any kind become a `schema.Track`, and a track at a time becomes a `schema.Pose`."""

from vectortalker.tracks.reading import MAX_BYTES, read_track
from vectortalker.tracks.sampling import sample

__all__ = ["MAX_BYTES", "read_track", "sample"]
