"""Typed errors. Raised where found, translated once at the border.

The server answers `{code, message}`; the CLI prints one line and exits with a code.
"""

from __future__ import annotations

from typing import Literal

ErrorCode = Literal[
    "bad_picture",  # not a picture, damaged, or of a kind that is not read
    "picture_too_large",
    "bad_option",
    "bad_landmarks",
    "bad_project",
    "bad_track",
    "bad_audio",
    "not_found",
    "queue_full",
    "storage_full",
    "unsupported",
    "unauthorised",  # the server asks for an access token
    "unavailable",  # the store of jobs cannot be reached just now
    "cancelled",
    "bad_request",  # HTTP that does not fit the API: unknown route, malformed or oversized body
    "internal",  # a fault of ours, or a worker that died
]


class VectorTalkerError(Exception):
    """A fault of the input or a limit reached. `message` is one sentence: the value, the limit, the way out."""

    def __init__(self, code: ErrorCode, message: str) -> None:
        super().__init__(message)
        self.code: ErrorCode = code
        self.message = message
