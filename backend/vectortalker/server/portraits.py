"""Portraits: the file as it came, its description and its faces among the blobs.

An id is 128 random bits: who knows it may see the picture, nobody can guess it, and nothing lists them.
"""

from __future__ import annotations

import io
import secrets

import numpy as np
from PIL import Image

from vectortalker import decode, schema
from vectortalker.errors import VectorTalkerError
from vectortalker.server.blobs import Blobs
from vectortalker.server.cache import digest
from vectortalker.server.kept import note_use
from vectortalker.server.store import Store

MAX_NAME = 120
PNG_COMPRESSION = 1  # half the time of the default for a tenth more bytes


def add(store: Store, blobs: Blobs, data: bytes, filename: str) -> schema.Portrait:
    """Decode and keep a picture. Raises `bad_picture`, `picture_too_large` or `storage_full`."""
    decoded = decode.decode(data, display_name(filename))
    portrait = schema.Portrait(
        id=secrets.token_hex(16),
        name=decoded.name,
        width=decoded.width,
        height=decoded.height,
        notices=list(decoded.notices),
    )
    note_use(store, "portraits", portrait.id)
    blobs.put(_key(portrait.id, "source"), data)
    blobs.put(_key(portrait.id, "digest"), digest(data).encode())
    blobs.put(_key(portrait.id, "portrait.json"), portrait.model_dump_json().encode())
    return portrait


def describe(blobs: Blobs, portrait_id: str) -> schema.Portrait:
    """Raises `not_found`."""
    data = blobs.find(_key(portrait_id, "portrait.json"))
    if data is None:
        raise VectorTalkerError("not_found", f"Portrait {portrait_id} is not known (any more): upload it again.")
    return schema.Portrait.model_validate_json(data)


def load(blobs: Blobs, portrait_id: str) -> decode.Portrait:
    """The pixels, from the file as it came. Raises `not_found`."""
    name = describe(blobs, portrait_id).name
    return decode.decode(blobs.get(_key(portrait_id, "source")), name)


def picture(blobs: Blobs, portrait_id: str) -> str:
    """Digest of the file as it came. Raises `not_found`."""
    return blobs.get(_key(portrait_id, "digest")).decode()


def image(blobs: Blobs, portrait_id: str) -> bytes:
    """The normalised picture as PNG. Raises `not_found`."""
    return _png(load(blobs, portrait_id))


def faces(blobs: Blobs, portrait_id: str) -> schema.Faces:
    """Detected once, then remembered. Raises `not_found`."""
    from vectortalker import landmarks  # loads onnxruntime, which the server's start should not wait for

    key = _key(portrait_id, "faces.json")
    known = blobs.find(key)
    if known is not None:
        return schema.Faces.model_validate_json(known)
    portrait = load(blobs, portrait_id)
    found = landmarks.to_wire(landmarks.detect(portrait.rgb), portrait.width, portrait.height)
    blobs.put(key, found.model_dump_json().encode())
    return found


def warm_up() -> None:
    """Load the models of `faces`, so that the first user need not wait."""
    from vectortalker import landmarks

    landmarks.detect(np.full((64, 64, 3), 128, np.uint8))


def display_name(filename: str, default: str = "portrait") -> str:
    """The last part of a client's file name, printable and short; it is shown and never used as a path."""
    last = filename.replace("\\", "/").rpartition("/")[2]
    printable = "".join(character for character in last if character.isprintable()).strip()
    return printable[-MAX_NAME:] or default


def _key(portrait_id: str, name: str) -> str:
    return f"portraits/{portrait_id}/{name}"


def _png(portrait: decode.Portrait) -> bytes:
    file = io.BytesIO()
    Image.fromarray(portrait.rgb).save(file, "PNG", compress_level=PNG_COMPRESSION)
    return file.getvalue()
