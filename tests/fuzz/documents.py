"""Valid JSON documents, spoilt in one or a few places: values of other kinds, of other sizes, missing, or too many."""

from __future__ import annotations

import copy
import json
from collections.abc import Callable
from random import Random
from typing import Any

HUGE = 10**400
VALUES = (
    None, True, 0, -1, 2, 68, 1e308, -1e308, 1e-320, HUGE, 0.1, "", "a", "nan", "\x00", "../../x", "<script>", [], {},
    [[]], [0] * 68, [[0, 0]] * 68, [[0, 0]] * 67, {"kind": "solid"}, float("nan"), float("inf"), "é" * 300,
)  # fmt: skip
DEPTH = 300  # of lists within each other; far deeper ones cannot be written by json itself and are tested apart


def spoilt(*documents: Any) -> Callable[[Random], bytes]:
    """A maker of JSON text of the documents after a few changes; NaN and infinity are written as Python writes them."""
    places = [(document, list(_places(document))) for document in documents]

    def make(random: Random) -> bytes:
        document, paths = random.choice(places)
        changed = copy.deepcopy(document)
        for _ in range(random.randint(1, 3)):
            changed = _changed(changed, random.choice(paths), random.randrange(len(VALUES) + 3))
        return json.dumps(changed).encode()

    return make


def _places(value: Any, path: tuple[Any, ...] = ()) -> Any:
    """Paths to what is in a document; of a long list only its first and last."""
    if path:
        yield path
    if isinstance(value, dict):
        for key in value:
            yield from _places(value[key], (*path, key))
    elif isinstance(value, list):
        for index in {0, len(value) - 1} - {-1}:
            yield from _places(value[index], (*path, index))


def _changed(value: Any, path: tuple[Any, ...], number: int) -> Any:
    key, *rest = path
    try:
        if rest:
            value[key] = _changed(value[key], tuple(rest), number)
        elif number < len(VALUES):
            value[key] = copy.deepcopy(VALUES[number])
        elif number == len(VALUES):
            del value[key]
        elif number == len(VALUES) + 1:
            value[key] = [value[key], value[key]]
        else:
            value[key] = _nested(value[key])
    except (KeyError, IndexError, TypeError):
        pass  # an earlier change took the place away
    return value


def _nested(value: Any) -> Any:
    for _ in range(DEPTH):
        value = [value]
    return value
