"""The store of one machine: an SQLite file that all processes open."""

from __future__ import annotations

from collections.abc import Sequence
from math import inf
from pathlib import Path

from vectortalker.server.database import Database, translated
from vectortalker.server.store import Change

TABLES = """
CREATE TABLE IF NOT EXISTS documents (key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS counters (name TEXT PRIMARY KEY, number INTEGER NOT NULL) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS ranks (
    list TEXT NOT NULL,
    member TEXT NOT NULL,
    score REAL NOT NULL,
    PRIMARY KEY (list, member)
) WITHOUT ROWID;
CREATE INDEX IF NOT EXISTS ranks_by_score ON ranks (list, score, member);
"""


class SqliteStore:
    """Implements `Store`."""

    def __init__(self, path: Path) -> None:
        with translated():
            self._database = Database(path, TABLES)

    def read(self, keys: Sequence[str]) -> list[str | None]:
        with translated():
            marks = ", ".join("?" * len(keys))
            rows = self._database.rows(f"SELECT key, value FROM documents WHERE key IN ({marks})", *keys)
        values = {row["key"]: row["value"] for row in rows}
        return [values.get(key) for key in keys]

    def members(self, index: str, below: float = inf, limit: int | None = None) -> list[str]:
        query = "SELECT member FROM ranks WHERE list = ? AND score < ? ORDER BY score, member LIMIT ?"
        with translated():
            return [row["member"] for row in self._database.rows(query, index, below, -1 if limit is None else limit)]

    def count(self, index: str, below: float = inf) -> int:
        with translated():
            rows = self._database.rows("SELECT count(*) AS n FROM ranks WHERE list = ? AND score < ?", index, below)
        return rows[0]["n"]

    def number(self, counter: str) -> int:
        with translated():
            rows = self._database.rows("SELECT number FROM counters WHERE name = ?", counter)
        return rows[0]["number"] if rows else 0

    def count_up(self, counter: str) -> int:
        with translated(), self._database.change() as sql:
            sql.execute(
                "INSERT INTO counters VALUES (?, 1) ON CONFLICT (name) DO UPDATE SET number = number + 1", (counter,)
            )
            return sql.execute("SELECT number FROM counters WHERE name = ?", (counter,)).fetchone()["number"]

    def commit(self, change: Change) -> bool:
        with translated(), self._database.change() as sql:
            for key, value in change.expected.items():
                row = sql.execute("SELECT value FROM documents WHERE key = ?", (key,)).fetchone()
                if (row["value"] if row else None) != value:
                    return False
            for key, value in change.values.items():
                if value is None:
                    sql.execute("DELETE FROM documents WHERE key = ?", (key,))
                else:
                    sql.execute("INSERT OR REPLACE INTO documents VALUES (?, ?)", (key, value))
            for (index, member), score in change.ranks.items():
                if score is None:
                    sql.execute("DELETE FROM ranks WHERE list = ? AND member = ?", (index, member))
                else:
                    sql.execute("INSERT OR REPLACE INTO ranks VALUES (?, ?, ?)", (index, member, score))
        return True

    def close(self) -> None:
        self._database.close()
