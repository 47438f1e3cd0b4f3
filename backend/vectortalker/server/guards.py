"""ASGI middleware around all routes: a limit on bodies, and headers that confine the page."""

from __future__ import annotations

from collections.abc import Mapping

from starlette.datastructures import Headers, MutableHeaders
from starlette.exceptions import HTTPException
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from vectortalker.errors import VectorTalkerError
from vectortalker.server.faults import answer

CONTENT_SECURITY_POLICY = "; ".join(
    (
        "default-src 'self'",
        "script-src 'self' 'wasm-unsafe-eval'",  # the Rust core
        "style-src 'self'",
        "img-src 'self' blob: data:",
        "media-src 'self' blob:",
        "worker-src 'self' blob:",
        "connect-src 'self' blob: data:",
        "object-src 'none'",
        "base-uri 'none'",
        "form-action 'none'",
        "frame-ancestors 'none'",
    )
)
HEADERS = {
    "Content-Security-Policy": CONTENT_SECURITY_POLICY,
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
}


class ConfiningHeaders:
    """Adds `HEADERS` to every answer; what the API says is not cached unless the route says so."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        async def send_confined(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                headers.update(HEADERS)
                headers.setdefault("Cache-Control", "no-store" if scope["path"].startswith("/api/") else "no-cache")
            await send(message)

        await self._app(scope, receive, send_confined if scope["type"] == "http" else send)


class KnownHosts:
    """Refuses names of the server that it does not go by: a foreign page that rebinds its name to us reads nothing."""

    def __init__(self, app: ASGIApp, hosts: tuple[str, ...]) -> None:
        self._app = app
        self._hosts = hosts

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        host = Headers(scope=scope).get("host", "") if scope["type"] == "http" else ""
        name = host[: host.rfind(":")] if host[host.rfind("]") + 1 :].count(":") else host
        if scope["type"] != "http" or not self._hosts or name.lower() in self._hosts:
            return await self._app(scope, receive, send)
        refusal = VectorTalkerError("bad_request", f"This server is not {name[:100]}: use {self._hosts[0]}.")
        await answer(refusal, 421)(scope, receive, send)


class BodyLimit:
    """Refuses a body as soon as its announced or its real length passes the limit, for some paths one of their own."""

    def __init__(self, app: ASGIApp, max_bytes: int, max_bytes_of: Mapping[str, int]) -> None:
        self._app = app
        self._max_bytes = max_bytes
        self._max_bytes_of = max_bytes_of

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            return await self._app(scope, receive, send)
        limit = self._max_bytes_of.get(scope["path"], self._max_bytes)
        refusal = f"The request is too large; the limit is {limit / 1e6:.0f} MB: send less."
        announced = Headers(scope=scope).get("content-length", "0")
        if announced.isdecimal() and int(announced) > limit:
            return await answer(VectorTalkerError("bad_request", refusal), 413)(scope, receive, send)
        received = 0

        async def receive_limited() -> Message:
            nonlocal received
            message = await receive()
            received += len(message.get("body", b""))
            if received > limit:
                raise HTTPException(413, refusal)  # raised within the route, translated with the other faults
            return message

        await self._app(scope, receive_limited, send)
