"""The store that machines share: Redis. To keep jobs over a crash of Redis itself, run it with `appendonly yes`."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from math import inf
from typing import cast

import redis
from redis.backoff import ExponentialBackoff
from redis.client import Pipeline
from redis.retry import Retry

from vectortalker.errors import VectorTalkerError
from vectortalker.server.store import Change

PREFIX = "vectortalker"
CONNECT_SECONDS = 2.0
ANSWER_SECONDS = 5.0
RETRIES = 3  # within some 0.3 s: a dropped connection passes, an outage is reported


class RedisStore:
    """Implements `Store` by WATCH and MULTI: a change is tried on what was read and refused if that has changed."""

    def __init__(self, url: str) -> None:
        """Raises `ValueError` if `url` is none of Redis."""
        self._redis = redis.Redis.from_url(
            url,
            decode_responses=True,
            socket_connect_timeout=CONNECT_SECONDS,
            socket_timeout=ANSWER_SECONDS,
            retry=Retry(ExponentialBackoff(cap=0.2, base=0.05), RETRIES),
        )

    def read(self, keys: Sequence[str]) -> list[str | None]:
        with _translated():
            found = self._redis.mget([_document(key) for key in keys]) if keys else []
        return cast(list[str | None], found)  # text, since responses are decoded

    def members(self, index: str, below: float = inf, limit: int | None = None) -> list[str]:
        count = -1 if limit is None else limit
        with _translated():
            found = self._redis.zrangebyscore(_index(index), "-inf", _less_than(below), start=0, num=count)
        return cast(list[str], found)  # text, since responses are decoded

    def count(self, index: str, below: float = inf) -> int:
        with _translated():
            return self._redis.zcount(_index(index), "-inf", _less_than(below))

    def number(self, counter: str) -> int:
        with _translated():
            return int(self._redis.get(_counter(counter)) or 0)

    def count_up(self, counter: str) -> int:
        with _translated():
            return self._redis.incr(_counter(counter))

    def commit(self, change: Change) -> bool:
        expected = {_document(key): value for key, value in change.expected.items()}
        with _translated(), self._redis.pipeline() as pipe:
            try:
                if expected:
                    pipe.watch(*expected)
                    if pipe.mget(list(expected)) != list(expected.values()):
                        return False
                pipe.multi()
                _queue(pipe, change)
                pipe.execute()
            except redis.WatchError:
                return False
        return True

    def close(self) -> None:
        self._redis.close()


def _queue(pipe: Pipeline, change: Change) -> None:
    for key, value in change.values.items():
        if value is None:
            pipe.delete(_document(key))
        else:
            pipe.set(_document(key), value)
    for (index, member), score in change.ranks.items():
        if score is None:
            pipe.zrem(_index(index), member)
        else:
            pipe.zadd(_index(index), {member: score})


def _document(key: str) -> str:
    return f"{PREFIX}:document:{key}"


def _index(name: str) -> str:
    return f"{PREFIX}:index:{name}"


def _counter(name: str) -> str:
    return f"{PREFIX}:counter:{name}"


def _less_than(score: float) -> str:
    return "+inf" if score == inf else f"({score!r}"


@contextmanager
def _translated() -> Iterator[None]:
    try:
        yield
    except redis.RedisError as error:
        raise VectorTalkerError("unavailable", f"Redis does not answer ({type(error).__name__}): try again.") from error
