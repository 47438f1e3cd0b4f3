"""The jobs table: the one place where the server's state lives.

A job goes queued → running → done | failed, and from either of the first two to cancelled. Each change stores a whole
`JobState` under the next revision. A worker *holds* the job it works on, also for the moment between a cancel and its
next step; the lease that its supervisor renews tells when it is gone.
"""

from __future__ import annotations

import sqlite3
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from vectortalker.errors import VectorTalkerError
from vectortalker.schema import ApiError, JobState
from vectortalker.server.database import Database

Kind = Literal["vectorize", "video"]
Wish = Literal["go_on", "finish", "stop"]  # what the user wants of a running job

ENDED = ("done", "failed", "cancelled")
LEASE_SECONDS = 10.0  # supervisors renew every second; a server that died is noticed after this
MAX_DEATHS = 2  # of workers, on one job
ORPHAN_SECONDS = 5.0  # a queued job without a queue entry is entered again after this

TABLES = """
CREATE TABLE IF NOT EXISTS jobs (
    sequence INTEGER PRIMARY KEY,
    id TEXT NOT NULL UNIQUE,
    kind TEXT NOT NULL,
    portrait_id TEXT,
    phase TEXT NOT NULL,
    state TEXT NOT NULL,               -- JobState; its queue position is counted on reading
    finish INTEGER NOT NULL DEFAULT 0,
    deaths INTEGER NOT NULL DEFAULT 0, -- of workers that held it
    holder TEXT,                       -- worker
    lease REAL NOT NULL DEFAULT 0,     -- epoch seconds
    started REAL NOT NULL DEFAULT 0,
    changed REAL NOT NULL
);
CREATE INDEX IF NOT EXISTS jobs_by_phase ON jobs (phase, sequence);
CREATE INDEX IF NOT EXISTS jobs_by_portrait ON jobs (portrait_id);
CREATE TABLE IF NOT EXISTS workers (name TEXT PRIMARY KEY, lease REAL NOT NULL);
"""


@dataclass(frozen=True)
class Held:
    """A cancelled job whose worker has not let go of it."""

    job_id: str
    worker: str


class Jobs:
    def __init__(self, path: Path) -> None:
        self._database = Database(path, TABLES)

    # ------------------------------------------------------------ for the routes

    def check_room(self, max_queued: int) -> None:
        """Raises `queue_full`."""
        queued = self.count("queued")
        if queued >= max_queued:
            raise VectorTalkerError(
                "queue_full", f"{queued} jobs are waiting; the limit is {max_queued}: try again in a few minutes."
            )

    def create(self, job_id: str, kind: Kind, portrait_id: str | None) -> JobState:
        """A new queued job."""
        state = JobState(
            id=job_id,
            revision=1,
            phase="queued",
            stage="waiting",
            level=0,
            levels=0,
            n_paths=0,
            progress=0,
            elapsed_seconds=0,
            remaining_seconds=None,
            queue_position=None,
            scene_revision=0,
        )
        with self._database.change() as sql:
            sql.execute(
                "INSERT INTO jobs (id, kind, portrait_id, phase, state, changed) VALUES (?, ?, ?, 'queued', ?, ?)",
                (job_id, kind, portrait_id, state.model_dump_json(), time.time()),
            )
        return self.get(job_id)

    def get(self, job_id: str) -> JobState:
        """The latest snapshot. Raises `not_found`."""
        rows = self._database.rows(
            "SELECT state, phase, (SELECT count(*) FROM jobs ahead WHERE ahead.phase = 'queued'"
            " AND ahead.sequence < jobs.sequence) AS ahead FROM jobs WHERE id = ?",
            job_id,
        )
        state = JobState.model_validate_json(_only(rows, job_id)["state"])
        return state.model_copy(update={"queue_position": rows[0]["ahead"]}) if state.phase == "queued" else state

    def finish(self, job_id: str) -> JobState:
        """Ask a job to end with what it has, at its next step; a job that has ended stays as it is."""
        with self._database.change() as sql:
            sql.execute("UPDATE jobs SET finish = 1 WHERE id = ?", (job_id,))
        return self.get(job_id)

    def cancel(self, job_id: str) -> JobState:
        """Cancelled from now on; the worker that holds it stops at its next step or is killed."""
        with self._database.change() as sql:
            row = _row(sql, job_id)
            if row["phase"] not in ENDED:
                _store(sql, row, phase="cancelled", stage="cancelled", remaining_seconds=None)
                _move_queue(sql)
        return self.get(job_id)

    def of_portrait(self, portrait_id: str) -> list[str]:
        return [row["id"] for row in self._database.rows("SELECT id FROM jobs WHERE portrait_id = ?", portrait_id)]

    def forget(self, job_id: str) -> None:
        """Remove a job that nobody holds; a held one, cancelled before, stays until its worker lets go."""
        with self._database.change() as sql:
            sql.execute("DELETE FROM jobs WHERE id = ? AND holder IS NULL", (job_id,))

    def count(self, phase: str) -> int:
        return self._database.rows("SELECT count(*) AS n FROM jobs WHERE phase = ?", phase)[0]["n"]

    def ready_workers(self) -> int:
        return self._database.rows("SELECT count(*) AS n FROM workers WHERE lease > ?", time.time())[0]["n"]

    # ------------------------------------------------------------ for workers

    def enlist(self, worker: str) -> None:
        """The worker has loaded everything and waits for jobs."""
        with self._database.change() as sql:
            sql.execute("INSERT OR REPLACE INTO workers VALUES (?, ?)", (worker, time.time() + LEASE_SECONDS))

    def claim(self, job_id: str, worker: str) -> Kind | None:
        """Take a queued job; None if it was cancelled, forgotten or taken meanwhile."""
        now = time.time()
        with self._database.change() as sql:
            row = sql.execute("SELECT * FROM jobs WHERE id = ? AND phase = 'queued'", (job_id,)).fetchone()
            if row is None:
                return None
            sql.execute(
                "UPDATE jobs SET holder = ?, lease = ?, started = ? WHERE id = ?",
                (worker, now + LEASE_SECONDS, now, job_id),
            )
            _store(sql, row, phase="running", stage="starting")
            _move_queue(sql)
        return row["kind"]

    def wish(self, job_id: str, worker: str) -> Wish:
        rows = self._database.rows("SELECT phase, finish, holder FROM jobs WHERE id = ?", job_id)
        if not rows or rows[0]["phase"] != "running" or rows[0]["holder"] != worker:
            return "stop"
        return "finish" if rows[0]["finish"] else "go_on"

    def is_unwanted(self, job_id: str) -> bool:
        """Cancelled or forgotten: nobody will ask for its files."""
        rows = self._database.rows("SELECT phase FROM jobs WHERE id = ?", job_id)
        return not rows or rows[0]["phase"] == "cancelled"

    def report(self, job_id: str, worker: str, **fields: object) -> None:
        """Store the next snapshot of a running job; nothing if it is no longer this worker's to run."""
        with self._database.change() as sql:
            row = sql.execute(
                "SELECT * FROM jobs WHERE id = ? AND phase = 'running' AND holder = ?", (job_id, worker)
            ).fetchone()
            if row is not None:
                _store(sql, row, elapsed_seconds=round(time.time() - row["started"], 2), **fields)

    def release(self, job_id: str, worker: str) -> None:
        """Let go of a job, however it ended."""
        with self._database.change() as sql:
            sql.execute("UPDATE jobs SET holder = NULL WHERE id = ? AND holder = ?", (job_id, worker))

    # ------------------------------------------------------------ for supervisors

    def renew(self, workers: list[str]) -> None:
        """The workers are alive: they and what they hold have another lease."""
        lease = time.time() + LEASE_SECONDS
        with self._database.change() as sql:
            for worker in workers:
                sql.execute("UPDATE workers SET lease = ? WHERE name = ?", (lease, worker))
                sql.execute("UPDATE jobs SET lease = ? WHERE holder = ?", (lease, worker))

    def stubborn(self, seconds: float) -> list[Held]:
        """Jobs that were cancelled more than `seconds` ago and are still held."""
        rows = self._database.rows(
            "SELECT id, holder FROM jobs WHERE phase = 'cancelled' AND holder IS NOT NULL AND changed < ?",
            time.time() - seconds,
        )
        return [Held(row["id"], row["holder"]) for row in rows]

    def blame(self, worker: str) -> None:
        """The worker died by itself, perhaps of what it was doing."""
        with self._database.change() as sql:
            sql.execute("UPDATE jobs SET deaths = deaths + 1 WHERE holder = ?", (worker,))

    def dismiss(self, worker: str) -> None:
        """The worker is gone: its lease ends now."""
        with self._database.change() as sql:
            sql.execute("DELETE FROM workers WHERE name = ?", (worker,))
            sql.execute("UPDATE jobs SET lease = 0 WHERE holder = ?", (worker,))

    def recover(self) -> list[str]:
        """Queue the jobs of workers that are gone again, and return them; fail those that too many died of."""
        now = time.time()
        if not self._database.rows("SELECT 1 FROM jobs WHERE holder IS NOT NULL AND lease < ? LIMIT 1", now):
            return []
        queued = []
        with self._database.change() as sql:
            for row in sql.execute("SELECT * FROM jobs WHERE holder IS NOT NULL AND lease < ?", (now,)).fetchall():
                sql.execute("UPDATE jobs SET holder = NULL WHERE id = ?", (row["id"],))
                if row["phase"] == "running" and row["deaths"] < MAX_DEATHS:
                    _store(sql, row, phase="queued", stage="waiting after its worker stopped")
                    queued.append(row["id"])
                elif row["phase"] == "running":
                    message = f"The worker stopped unexpectedly {MAX_DEATHS} times on this job: try other options."
                    _store(sql, row, phase="failed", stage="failed", error=ApiError(code="internal", message=message))
        return queued

    def orphans(self) -> list[str]:
        """Queued jobs that have waited long enough to have been seen by an idle worker."""
        rows = self._database.rows(
            "SELECT id FROM jobs WHERE phase = 'queued' AND changed < ? ORDER BY sequence",
            time.time() - ORPHAN_SECONDS,
        )
        return [row["id"] for row in rows]

    def close(self) -> None:
        self._database.close()


def _only(rows: list[sqlite3.Row], job_id: str) -> sqlite3.Row:
    if not rows:
        raise VectorTalkerError("not_found", f"Job {job_id} is not known (any more): start it again.")
    return rows[0]


def _row(sql: sqlite3.Connection, job_id: str) -> sqlite3.Row:
    return _only(sql.execute("SELECT * FROM jobs WHERE id = ?", (job_id,)).fetchall(), job_id)


def _store(sql: sqlite3.Connection, row: sqlite3.Row, **fields: object) -> None:
    """Write `fields` over the row's snapshot as its next revision."""
    before = JobState.model_validate_json(row["state"])
    after = JobState.model_validate({**before.model_dump(), **fields, "revision": before.revision + 1})
    sql.execute(
        "UPDATE jobs SET state = ?, phase = ?, changed = ? WHERE id = ?",
        (after.model_dump_json(), after.phase, time.time(), row["id"]),
    )


def _move_queue(sql: sqlite3.Connection) -> None:
    """Somebody left the queue: those behind have a new position, hence a new revision."""
    for row in sql.execute("SELECT * FROM jobs WHERE phase = 'queued'").fetchall():
        _store(sql, row)
