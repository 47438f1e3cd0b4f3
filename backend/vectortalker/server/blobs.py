"""Bytes by key through fsspec: a local folder by default; whole or not at all."""

from __future__ import annotations

import errno
import secrets
import shutil
from pathlib import Path

import fsspec

from vectortalker.errors import VectorTalkerError

OUT_OF_SPACE = (errno.ENOSPC, errno.EDQUOT)


class Blobs:
    """Keys are relative paths made by the server from its own ids, never from a client's names."""

    def __init__(self, folder: Path, min_free_bytes: int) -> None:
        self._folder = folder
        self._min_free_bytes = min_free_bytes
        self._files = fsspec.filesystem("dir", path=str(folder), fs=fsspec.filesystem("file", auto_mkdir=True))
        folder.mkdir(parents=True, exist_ok=True)

    def put(self, key: str, data: bytes) -> None:
        """Store under `key`, replacing at once what was there. Raises `storage_full`."""
        free = shutil.disk_usage(self._folder).free
        if free < self._min_free_bytes + len(data):
            raise _full(free)
        part = f"{key}.{secrets.token_hex(4)}.part"
        try:
            self._files.pipe_file(part, data)
            self._files.mv(part, key)
        except OSError as error:
            if self._files.exists(part):
                self._files.rm(part)
            if error.errno in OUT_OF_SPACE:
                raise _full(0) from error
            raise

    def get(self, key: str) -> bytes:
        """The bytes under `key`. Raises `not_found`."""
        try:
            return self._files.cat_file(key)
        except FileNotFoundError as error:
            raise VectorTalkerError("not_found", f"{key.rpartition('/')[2]} is not there (any more).") from error

    def find(self, key: str) -> bytes | None:
        return self._files.cat_file(key) if self._files.exists(key) else None

    def delete(self, key: str) -> None:
        if self._files.exists(key):
            self._files.rm_file(key)

    def delete_folder(self, key: str) -> None:
        if self._files.exists(key):
            self._files.rm(key, recursive=True)


def _full(free: int) -> VectorTalkerError:
    return VectorTalkerError(
        "storage_full", f"The server's disk is full ({free / 1e6:.0f} MB free): delete portraits or try again later."
    )
