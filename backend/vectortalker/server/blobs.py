"""Bytes by key through fsspec: a local folder by default, an object store by its URL; whole or not at all."""

from __future__ import annotations

import os
import secrets
import shutil
from pathlib import Path

import fsspec
from fsspec.implementations.dirfs import DirFileSystem

from vectortalker.errors import VectorTalkerError
from vectortalker.server.disk import full_disk_told, storage_full


class Blobs:
    """Keys are relative paths made by the server from its own ids, never from a client's names."""

    def __init__(self, place: str, min_free_bytes: int) -> None:
        """`place` is a folder or a URL of fsspec. Raises `bad_option` if nothing here opens it, `storage_full`."""
        try:
            files, path = fsspec.core.url_to_fs(place)
        except (ValueError, ImportError) as error:
            raise VectorTalkerError("bad_option", f"{place} cannot hold files ({error}): name a folder.") from error
        self._min_free_bytes = min_free_bytes
        self._local = Path(path) if "file" in files.protocol else None
        if self._local:
            with full_disk_told():
                self._local.mkdir(parents=True, exist_ok=True)
        self._files = DirFileSystem(path=path, fs=files)

    def put(self, key: str, data: bytes) -> None:
        """Store under `key`, replacing at once what was there. Raises `storage_full`."""
        if self._local is None:
            return self._files.pipe_file(key, data)  # object stores show an object when it is whole
        free = self.free_bytes()
        if free is not None and free < self._min_free_bytes + len(data):
            raise storage_full(free)
        path = self._local / key
        part = path.with_name(f"{path.name}.{secrets.token_hex(4)}.part")
        try:
            with full_disk_told():
                path.parent.mkdir(parents=True, exist_ok=True)
                part.write_bytes(data)
                os.replace(part, path)
        finally:
            part.unlink(missing_ok=True)

    def get(self, key: str) -> bytes:
        """The bytes under `key`. Raises `not_found`."""
        data = self.find(key)
        if data is None:
            raise VectorTalkerError("not_found", f"{key.rpartition('/')[2]} is not there (any more).")
        return data

    def find(self, key: str) -> bytes | None:
        try:
            return self._files.cat_file(key)
        except FileNotFoundError:
            return None

    def delete(self, key: str) -> None:
        """Others may be deleting the same."""
        try:
            self._files.rm_file(key)
        except FileNotFoundError:
            return

    def delete_folder(self, key: str) -> None:
        """Others may be deleting the same."""
        try:
            if self._files.exists(key):
                self._files.rm(key, recursive=True)
        except FileNotFoundError:
            return

    def names(self, key: str) -> list[str]:
        """Of the folders and files right within `key`."""
        if not self._files.exists(key):
            return []
        return [str(entry).rpartition("/")[2] for entry in self._files.ls(key, detail=False)]

    def free_bytes(self) -> int | None:
        """Of the disk; None for object stores, which do not say."""
        return shutil.disk_usage(self._local).free if self._local else None
