"""What users bring is kept until it was unused for too long: a folder of blobs, and its place in an index by last use.

The index is named as the folder that holds those of its kind.
"""

from __future__ import annotations

import time
from typing import Literal

from vectortalker.server.blobs import Blobs
from vectortalker.server.store import Change, Store

Kept = Literal["portraits", "recordings"]


def note_use(store: Store, kind: Kept, name: str) -> None:
    """It is kept from now on for the time that things are kept."""
    store.commit(Change(ranks={(kind, name): time.time()}))


def unused_since(store: Store, kind: Kept, epoch_seconds: float) -> list[str]:
    return store.members(kind, below=epoch_seconds)


def delete(store: Store, blobs: Blobs, kind: Kept, name: str) -> None:
    blobs.delete_folder(f"{kind}/{name}")
    store.commit(Change(ranks={(kind, name): None}))
