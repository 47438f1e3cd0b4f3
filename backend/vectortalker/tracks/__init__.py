"""Track files of any kind become a `schema.Track` and back, and a track at a time becomes a `schema.Pose`."""

from vectortalker.tracks.reading import MAX_BYTES, read_track
from vectortalker.tracks.sampling import sample
from vectortalker.tracks.writing import ENDINGS, Format, write_track

__all__ = ["ENDINGS", "MAX_BYTES", "Format", "read_track", "sample", "write_track"]
