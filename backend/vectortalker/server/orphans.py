"""Files that nothing refers to, left by a crash between two steps, are found and, after a day, removed.

When each was first seen is in the store, so that supervisors agree and a restart forgets nothing. What is just being
made has files before it has a record, and is no orphan any more at the next look.
"""

from __future__ import annotations

import logging
import time
from collections.abc import Iterator

from vectortalker.server import cache, record
from vectortalker.server.services import Services
from vectortalker.server.settings import DAY_SECONDS
from vectortalker.server.store import Change

SEEN = "orphans"  # index of orphans by the time when they were first seen
PLACES = {  # among the blobs: the index of what may lie there
    "jobs": record.ALL,
    "portraits": "portraits",
    "recordings": "recordings",
    "cache": cache.USED,
}

log = logging.getLogger("vectortalker.removal")


def remove_orphans(services: Services, patience_seconds: float = DAY_SECONDS) -> None:
    """Note the new ones, forget those that are none any more, remove those seen for longer than `patience_seconds`."""
    now = time.time()
    found, known = set(_orphans(services)), set(services.store.members(SEEN))
    news: dict[tuple[str, str], float | None] = {(SEEN, key): now for key in found - known}
    services.store.commit(Change(ranks=news | {(SEEN, key): None for key in known - found}))
    for key in services.store.members(SEEN, below=now - patience_seconds):
        services.blobs.delete_folder(key)
        services.store.commit(Change(ranks={(SEEN, key): None}))
        log.info("files that nothing refers to were removed", extra={"place": key.partition("/")[0]})


def _orphans(services: Services) -> Iterator[str]:
    """Keys of folders and files right within `PLACES` that have no entry in the index."""
    for place, index in PLACES.items():
        names = services.blobs.names(place)
        members = set(services.store.members(index))
        yield from (f"{place}/{name}" for name in names if name.removesuffix(cache.ENDING) not in members)
