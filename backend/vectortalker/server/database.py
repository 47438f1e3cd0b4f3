"""SQLite with short transactions, shared by the threads of a process: one connection writes, one reads."""

from __future__ import annotations

import sqlite3
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from vectortalker.errors import VectorTalkerError
from vectortalker.server.disk import full_disk_told

BUSY_SECONDS = 10.0  # longer than any transaction here by three orders of magnitude


class Database:
    """In WAL mode a reader never waits for a writer; having its own connection, not within this process either."""

    def __init__(self, path: Path, tables: str) -> None:
        path.parent.mkdir(parents=True, exist_ok=True)
        self._writing, self._reading = threading.Lock(), threading.Lock()
        self._writer = _connect(path)
        self._writer.execute("PRAGMA journal_mode = wal")
        self._writer.executescript(tables)
        self._reader = _connect(path)

    def rows(self, query: str, *values: object) -> list[sqlite3.Row]:
        with self._reading:
            return self._reader.execute(query, values).fetchall()

    @contextmanager
    def change(self) -> Iterator[sqlite3.Connection]:
        """A write transaction, rolled back if the block raises."""
        with self._writing:
            self._writer.execute("BEGIN IMMEDIATE")
            try:
                yield self._writer
                self._writer.execute("COMMIT")
            except BaseException:
                if self._writer.in_transaction:  # a full disk has ended it already
                    self._writer.execute("ROLLBACK")
                raise

    def close(self) -> None:
        with self._writing, self._reading:
            self._reader.close()
            self._writer.close()


@contextmanager
def translated() -> Iterator[None]:
    """What SQLite and its folder may fail with becomes `storage_full` or `unavailable`."""
    try:
        with full_disk_told():
            yield
    except sqlite3.OperationalError as error:
        raise VectorTalkerError("unavailable", f"The server's store does not answer ({error}): try again.") from error


def _connect(path: Path) -> sqlite3.Connection:
    connection = sqlite3.connect(path, timeout=BUSY_SECONDS, isolation_level=None, check_same_thread=False)
    connection.row_factory = sqlite3.Row
    connection.execute("PRAGMA synchronous = normal")
    return connection
