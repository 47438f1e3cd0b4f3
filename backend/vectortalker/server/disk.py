"""A full disk is one answer, wherever it is noticed: among blobs, in SQLite, or when the folders are made."""

from __future__ import annotations

import errno
import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager

from vectortalker.errors import VectorTalkerError

OUT_OF_SPACE = (errno.ENOSPC, errno.EDQUOT)
SQLITE_OUT_OF_SPACE = (sqlite3.SQLITE_FULL, sqlite3.SQLITE_IOERR_SHMSIZE)  # the second: none for the log's index


def storage_full(free_bytes: int) -> VectorTalkerError:
    return VectorTalkerError(
        "storage_full",
        f"The server's disk is full ({free_bytes / 1e6:.0f} MB free): delete portraits or try again later.",
    )


@contextmanager
def full_disk_told() -> Iterator[None]:
    """Failures for want of space become `storage_full`; others pass."""
    try:
        yield
    except sqlite3.OperationalError as error:
        if error.sqlite_errorcode not in SQLITE_OUT_OF_SPACE:
            raise
        raise storage_full(0) from error
    except OSError as error:
        if error.errno not in OUT_OF_SPACE:
            raise
        raise storage_full(0) from error
