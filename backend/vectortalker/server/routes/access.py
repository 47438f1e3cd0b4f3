"""What routes are given: the services of the running app, whose request it is, and ids that have the right form."""

from __future__ import annotations

from typing import Annotated

from fastapi import Depends, Path, Request

from vectortalker.server.services import Services

Id = Annotated[str, Path(pattern="^[0-9a-f]{32}$")]


def _services(request: Request) -> Services:
    return request.app.state.services


Has = Annotated[Services, Depends(_services)]


def _client(request: Request) -> str:
    return request.state.client


Client = Annotated[str, Depends(_client)]
