"""Bytes of a track file, whatever its kind, become a `schema.Track`."""

from __future__ import annotations

from pydantic import ValidationError

from vectortalker.errors import VectorTalkerError
from vectortalker.json_input import parse_json, sentence
from vectortalker.schema import SCHEMA_VERSION, Track
from vectortalker.tracks import points_csv, rhubarb

MAX_BYTES = 32_000_000  # some five million numbers: half an hour of landmarks, any length of articulators


def read_track(data: bytes, name: str) -> Track:
    """Track JSON, Rhubarb JSON or TSV, or raw 68-point CSV, told apart by content.

    Raises `bad_track`: too large, of no known kind, with wrong counts, NaN or out of range, or of a newer version.
    """
    if len(data) > MAX_BYTES:
        raise _bad(f"{name} has {len(data) / 1e6:.0f} MB; the limit is {MAX_BYTES / 1e6:.0f} MB: cut or thin it.")
    try:
        return _read(data, name)
    except ValidationError as error:
        raise _bad(f"{name} is not a valid track: {sentence(error)}") from error


def _read(data: bytes, name: str) -> Track:
    if data.lstrip()[:1] in (b"{", b"["):
        document = parse_json(data, "bad_track", name)
        if not isinstance(document, dict):
            raise _bad(f"{name} is a list; a track is an object with duration, fps and landmarks or articulators.")
        if "mouthCues" in document:
            return rhubarb.from_json(document, name)
        return _current(document, name)
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise _bad(f"{name} is neither JSON nor text: give a track file.") from error
    return rhubarb.from_tsv(text, name) if rhubarb.is_tsv(text) else points_csv.from_csv(text, name)


def _current(document: dict, name: str) -> Track:
    version = document.get("schema_version")
    if not isinstance(version, int) or version < 1:
        raise _bad(f"{name} has no valid schema_version ({version!r:.40}).")
    if version > SCHEMA_VERSION:
        raise _bad(f"{name} is of track version {version}; this VectorTalker reads up to {SCHEMA_VERSION}: update it.")
    return Track.model_validate(document)


def _bad(message: str) -> VectorTalkerError:
    return VectorTalkerError("bad_track", message)
