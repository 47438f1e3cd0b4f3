"""Turns recordings of speech into tracks that a portrait plays."""

from vectortalker.speech.landmarks import as_landmarks
from vectortalker.speech.own_model import track_by_model
from vectortalker.speech.styles import STYLES, Options
from vectortalker.speech.track import track_from_audio, track_from_blocks

__all__ = ["STYLES", "Options", "as_landmarks", "track_by_model", "track_from_audio", "track_from_blocks"]
