"""Every error that leaves the server becomes `{code, message}` with a fitting status, here and nowhere else."""

from __future__ import annotations

import logging
from collections.abc import Mapping

from fastapi import FastAPI, Request, Response
from fastapi.exceptions import RequestValidationError
from fastapi.responses import JSONResponse
from starlette.exceptions import HTTPException

from vectortalker.errors import ErrorCode, VectorTalkerError
from vectortalker.schema import ApiError

log = logging.getLogger("vectortalker.server")

STATUS: Mapping[ErrorCode, int] = {
    "unauthorised": 401,
    "not_found": 404,
    "cancelled": 409,
    "picture_too_large": 413,
    "queue_full": 429,
    "internal": 500,
    "unavailable": 503,
    "storage_full": 507,
    "bad_request": 400,
}
INPUT_STATUS = 422  # all other codes: the request was understood, its content is at fault
RETRY_AFTER: Mapping[ErrorCode, str] = {"queue_full": "30", "unavailable": "5"}  # seconds
CODE_OF_FIELD: Mapping[str, ErrorCode] = {
    "landmarks": "bad_landmarks",
    "track": "bad_track",
    "scene": "bad_project",
    "visemes": "bad_track",
    "options": "bad_option",
}
ERROR_RESPONSES: dict[int | str, dict[str, object]] = {
    "default": {
        "description": "What went wrong, in one sentence",
        "content": {"application/json": {"schema": {"$ref": "#/components/schemas/ApiError"}}},
    }
}


class StreamEndedError(Exception):
    """A client that has seen the last snapshot asks for more: 204 tells an EventSource not to come back."""


def answer(error: VectorTalkerError, status: int | None = None) -> JSONResponse:
    body = ApiError(code=error.code, message=error.message)
    headers = {"Retry-After": RETRY_AFTER[error.code]} if error.code in RETRY_AFTER else None
    return JSONResponse(body.model_dump(), status or STATUS.get(error.code, INPUT_STATUS), headers)


def add_fault_handlers(app: FastAPI) -> None:
    @app.exception_handler(VectorTalkerError)
    async def _ours(_: Request, error: VectorTalkerError) -> Response:
        return answer(error)

    @app.exception_handler(RequestValidationError)
    async def _invalid(_: Request, error: RequestValidationError) -> Response:
        return answer(_first_fault(error))

    @app.exception_handler(HTTPException)
    async def _http(request: Request, error: HTTPException) -> Response:
        if error.status_code == 404:
            return answer(VectorTalkerError("not_found", f"There is nothing at {request.url.path[:200]}."))
        return answer(VectorTalkerError("bad_request", f"{error.detail.rstrip('.')}."), error.status_code)

    @app.exception_handler(StreamEndedError)
    async def _ended(_: Request, __: StreamEndedError) -> Response:
        return Response(status_code=204)

    @app.exception_handler(Exception)
    async def _unexpected(_: Request, error: Exception) -> Response:
        log.error("a request failed", exc_info=error)
        message = f"The server failed on this request ({type(error).__name__}): try again."
        return answer(VectorTalkerError("internal", message))


def _first_fault(error: RequestValidationError) -> VectorTalkerError:
    """One sentence about the first of the faults; ids that cannot exist are not found."""
    fault = error.errors()[0]
    place, *inner = fault["loc"]
    if place == "path":
        return VectorTalkerError("not_found", f"There is no {inner[0]} of this form.")
    code = CODE_OF_FIELD.get(str(inner[0]) if inner else "", "bad_request")
    name = ".".join(str(part) for part in inner) or place
    return VectorTalkerError(code, f"{name}: {fault['msg'].removeprefix('Value error, ')}.")
