"""What the server remembers across processes: values by key and ordered indexes, changed together or not at all.

Everything above speaks in these few operations, so that an embedded store and one that machines share are exchanged by
one setting.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import inf
from typing import Protocol

Rank = tuple[str, str]  # (index, member)


@dataclass(frozen=True)
class Change:
    """All of it happens, or nothing if a value is no longer what was expected.

    `expected`: what was read before, None for absent. `values`: new values, None to delete. `ranks`: new scores of
    members of indexes, None to remove.
    """

    expected: Mapping[str, str | None] = field(default_factory=dict)
    values: Mapping[str, str | None] = field(default_factory=dict)
    ranks: Mapping[Rank, float | None] = field(default_factory=dict)


class Store(Protocol):
    """Operations raise `unavailable` while the store cannot be reached and `storage_full` when its disk is full."""

    def read(self, keys: Sequence[str]) -> list[str | None]: ...

    def members(self, index: str, below: float = inf, limit: int | None = None) -> list[str]:
        """Those of a score less than `below`, lowest first."""
        ...

    def count(self, index: str, below: float = inf) -> int: ...

    def number(self, counter: str) -> int:
        """How often `count_up` was called."""
        ...

    def count_up(self, counter: str) -> int:
        """The next number, from 1; no two callers get the same."""
        ...

    def commit(self, change: Change) -> bool:
        """Whether it happened."""
        ...

    def close(self) -> None: ...
