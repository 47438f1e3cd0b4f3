"""Who may use the API: with tokens set, those who bring one; and who is counted as the same client.

A token comes as `Authorization: Bearer TOKEN` or, for browsers, as a cookie that a first visit to `/?token=TOKEN` sets.
Portraits and jobs have no owners: their ids are 128 random bits, and who has one may use it.
"""

from __future__ import annotations

import hashlib
import secrets
from http.cookies import CookieError, SimpleCookie
from urllib.parse import parse_qs

from starlette.datastructures import Headers
from starlette.responses import RedirectResponse
from starlette.types import ASGIApp, Receive, Scope, Send

from vectortalker.errors import VectorTalkerError
from vectortalker.server.faults import answer

COOKIE = "vectortalker"
COOKIE_SECONDS = 30 * 86_400
OPEN_PATHS = ("/api/health",)  # for load balancers; it tells no more than counts
GUARDED_PATHS = ("/api/", "/metrics")  # the page itself holds no secrets
REFUSAL = VectorTalkerError(
    "unauthorised", "This server asks for an access token: open the address with ?token=… that its owner gave you."
)


class Gate:
    """Lets through who knows a token, and notes in the scope's state whose request it is."""

    def __init__(self, app: ASGIApp, tokens: tuple[str, ...]) -> None:
        self._app = app
        self._keys = tuple(_key(token) for token in tokens)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            return await self._app(scope, receive, send)
        if not self._keys:
            scope.setdefault("state", {})["client"] = _address(scope)
            return await self._app(scope, receive, send)
        given = parse_qs(scope["query_string"].decode("latin-1")).get("token", [""])[0]
        if scope["path"] == "/" and self._known(_key(given)):
            return await _admitted(_key(given))(scope, receive, send)
        key = _presented(Headers(scope=scope))
        known = self._known(key)
        scope.setdefault("state", {})["client"] = f"token:{key[:16]}" if known else _address(scope)
        if not known and scope["path"].startswith(GUARDED_PATHS) and scope["path"] not in OPEN_PATHS:
            return await answer(REFUSAL)(scope, receive, send)
        await self._app(scope, receive, send)

    def _known(self, key: str) -> bool:
        """All are compared, each in constant time, so that the time tells nothing."""
        return any([secrets.compare_digest(key, known) for known in self._keys])


def _key(token: str) -> str:
    """What is compared and kept in cookies instead of the token itself."""
    return hashlib.sha256(f"{COOKIE}:{token}".encode()).hexdigest()


def _presented(headers: Headers) -> str:
    """The key of the request, of one form whatever was sent."""
    scheme, _, token = headers.get("authorization", "").partition(" ")
    if scheme.lower() == "bearer":
        return _key(token.strip())
    try:
        cookie = SimpleCookie(headers.get("cookie", "")).get(COOKIE)
    except CookieError:
        cookie = None
    return cookie.value if cookie and cookie.value.isascii() else ""


def _admitted(key: str) -> RedirectResponse:
    response = RedirectResponse("./", 303)
    response.set_cookie(COOKIE, key, max_age=COOKIE_SECONDS, httponly=True, samesite="strict", path="/")
    return response


def _address(scope: Scope) -> str:
    return f"address:{scope['client'][0]}" if scope.get("client") else "address:unknown"
