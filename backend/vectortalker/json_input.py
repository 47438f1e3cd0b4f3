"""JSON from strangers becomes plain values, or one sentence about what is wrong with it."""

from __future__ import annotations

import json
from typing import Any, NoReturn

from pydantic import ValidationError

from vectortalker.errors import ErrorCode, VectorTalkerError

MAX_PLACE = 80  # characters of a path into a document that are shown


def parse_json(data: bytes, code: ErrorCode, name: str) -> Any:
    """Strict JSON: no NaN, no infinity, no nesting that exhausts the stack. Raises an error of `code`."""
    try:
        return json.loads(data, parse_constant=_refuse_constant)
    except (ValueError, RecursionError) as error:
        reason = "nested too deeply" if isinstance(error, RecursionError) else str(error)
        raise VectorTalkerError(code, f"{name} is not JSON that can be read ({reason}).") from error


def sentence(error: ValidationError) -> str:
    """The first fault of a document: where it is and what it is."""
    fault = error.errors(include_url=False, include_input=False)[0]
    place = ".".join(str(part) for part in fault["loc"])[:MAX_PLACE]
    what = fault["msg"].removeprefix("Value error, ")
    return f"{place}: {what}." if place else f"{what}."


def _refuse_constant(constant: str) -> NoReturn:
    raise ValueError(f"{constant} is no number of JSON")
