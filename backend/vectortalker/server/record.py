"""A job as the store keeps it: one JSON document, and its places in the indexes, which follow from it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from pydantic import TypeAdapter

from vectortalker.schema import JobState
from vectortalker.server.store import Change, Rank

Kind = Literal["vectorize", "video", "speech"]

ENDED = ("done", "failed", "cancelled")
ALL = "jobs"  # index of all jobs by their last change
HELD_CANCELLED = "held_cancelled"  # index of cancelled jobs that a worker still holds, by their last change


@dataclass(frozen=True)
class Record:
    """`attempts` are counted when a worker takes the job, before it does anything, and from anew at each level."""

    id: str
    kind: Kind
    portrait_id: str | None  # or recording: what it is deleted with
    client: str  # whose job it is, for limits
    sequence: int  # place in the order of arrival, kept when the job is queued again
    state: JobState  # without what is computed on reading: queue position and estimate
    changed: float  # epoch seconds
    started: float = 0.0  # epoch seconds
    finish: bool = False  # the user wants it to end with what it has
    forgotten: bool = False  # gone for the user; removed when its worker lets go
    attempts: int = 0
    holder: str | None = None  # worker


_JSON = TypeAdapter(Record)


def document(job_id: str) -> str:
    """The key of a job's record in the store."""
    return f"job:{job_id}"


def phase_index(phase: str) -> str:
    """Jobs of a phase by arrival."""
    return f"phase:{phase}"


def portrait_index(portrait_id: str) -> str:
    return f"portrait:{portrait_id}"


def active_index(client: str) -> str:
    """Jobs of a client that have not ended."""
    return f"active:{client}"


def holder_index(worker: str) -> str:
    return f"holder:{worker}"


def read(text: str) -> Record:
    return _JSON.validate_json(text)


def write(record: Record) -> str:
    return _JSON.dump_json(record).decode()


def replacing(text: str | None, after: Record | None) -> Change:
    """From the stored `text` (None: a new job) to `after` (None: none), with the indexes that differ."""
    before = read(text) if text is not None else None
    assert before or after
    key = document((before or after).id)  # type: ignore[union-attr]  # asserted
    old, new = _ranks(before), _ranks(after)
    removed: dict[Rank, float | None] = dict.fromkeys(old.keys() - new.keys())
    added = {rank: score for rank, score in new.items() if old.get(rank) != score}
    return Change({key: text}, {key: write(after) if after else None}, removed | added)


def _ranks(record: Record | None) -> dict[Rank, float]:
    if record is None:
        return {}
    member, phase = record.id, record.state.phase
    ranks: dict[Rank, float] = {
        (ALL, member): record.changed,
        (phase_index(phase), member): record.sequence,
    }
    if record.portrait_id:
        ranks[portrait_index(record.portrait_id), member] = record.sequence
    if phase not in ENDED:
        ranks[active_index(record.client), member] = record.sequence
    if record.holder:
        ranks[holder_index(record.holder), member] = record.sequence
    if record.holder and phase == "cancelled":
        ranks[HELD_CANCELLED, member] = record.changed
    return ranks
