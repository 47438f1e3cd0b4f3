"""Figures for Prometheus."""

from __future__ import annotations

from fastapi import APIRouter, Request, Response
from prometheus_client import CONTENT_TYPE_LATEST

router = APIRouter(tags=["metrics"])


@router.get("/metrics", include_in_schema=False)
def get_metrics(request: Request) -> Response:
    return Response(request.app.state.figures.text(), headers={"Content-Type": CONTENT_TYPE_LATEST})
