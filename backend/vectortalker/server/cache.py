"""Results by content: what was made of the same picture with the same request by the same code is not made again.

An entry is a blob; its last use and its size are in the store, through which any number of processes agree on what is
dropped. Least recently used goes first.
"""

from __future__ import annotations

import hashlib
import importlib.util
import json
import time
from functools import cache as once
from pathlib import Path

from pydantic import BaseModel, TypeAdapter

import vectortalker
from vectortalker.schema import JobRequest, Metrics
from vectortalker.server.blobs import Blobs
from vectortalker.server.store import Change, Store

USED = "cache"  # index of entries by their last use
ENDING = ".json"  # of the files of entries
RUST_CORE = "vectortalker_core"


class CachedResult(BaseModel):
    """The files of a finished job, and what its last snapshot says of them."""

    scene: str
    svg: str
    metrics: Metrics
    levels: int


_RESULT = TypeAdapter(CachedResult)


class Cache:
    def __init__(self, store: Store, blobs: Blobs, max_bytes: int, models: str = "") -> None:
        """`models`: digest of models that take the place of the package's."""
        self._store = store
        self._blobs = blobs
        self._max_bytes = max_bytes
        self._models = models

    def find(self, picture: str, request: JobRequest) -> CachedResult | None:
        """`picture` is the digest of the file that the portrait came as."""
        entry = self._entry(picture, request)
        (size,) = self._store.read([_size(entry)])
        data = self._blobs.find(_blob(entry)) if size is not None else None
        if data is None:
            return None
        self._store.commit(Change({_size(entry): size}, ranks={(USED, entry): time.time()}))
        return _RESULT.validate_json(data)

    def add(self, picture: str, request: JobRequest, result: CachedResult) -> None:
        """Keep a result, and drop the longest unused until all fit. Raises `storage_full`."""
        data = _RESULT.dump_json(result)
        if len(data) > self._max_bytes:
            return
        entry = self._entry(picture, request)
        self._blobs.put(_blob(entry), data)
        self._store.commit(Change(values={_size(entry): str(len(data))}, ranks={(USED, entry): time.time()}))
        self._shrink()

    def forget(self, picture: str) -> None:
        """Everything that was made of a picture."""
        for entry in self._store.members(USED):
            if entry.startswith(f"{picture}-"):
                self._drop(entry)

    def drop_unused_since(self, epoch_seconds: float) -> None:
        for entry in self._store.members(USED, below=epoch_seconds):
            self._drop(entry)

    def total_bytes(self) -> int:
        return sum(self._sizes().values())

    def _entry(self, picture: str, request: JobRequest) -> str:
        asked = request.model_dump(mode="json", exclude={"portrait_id"})
        return f"{picture}-{digest(json.dumps([asked, code_version(), self._models], sort_keys=True).encode())}"

    def _sizes(self) -> dict[str, int]:
        """By entry, longest unused first."""
        entries = self._store.members(USED)
        sizes = self._store.read([_size(entry) for entry in entries]) if entries else []
        return {entry: int(size or 0) for entry, size in zip(entries, sizes, strict=True)}

    def _shrink(self) -> None:
        sizes = self._sizes()
        excess = sum(sizes.values()) - self._max_bytes
        for entry, size in sizes.items():
            if excess <= 0:
                return
            self._drop(entry)
            excess -= size

    def _drop(self, entry: str) -> None:
        """First from the index, so that a reader finds the whole entry or none."""
        self._store.commit(Change(values={_size(entry): None}, ranks={(USED, entry): None}))
        self._blobs.delete(_blob(entry))


def digest(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()


@once
def code_version() -> str:
    """Digest of the code that makes results, so that none of another version is served."""
    package = Path(vectortalker.__file__).parent
    core = importlib.util.find_spec(RUST_CORE)
    assert core is not None and core.origin is not None
    binaries = sorted(Path(core.origin).parent.glob("*.so"))
    files = [*sorted(package.rglob("*.py")), package / "models" / "models.json", *binaries]
    return digest(b"".join(file.read_bytes() for file in files))


def _blob(entry: str) -> str:
    return f"cache/{entry}{ENDING}"


def _size(entry: str) -> str:
    return f"cache:{entry}"
