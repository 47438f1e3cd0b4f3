"""The HTTP application: routes, guards and pages around one set of services."""

from __future__ import annotations

from importlib.metadata import version

from fastapi import FastAPI
from fastapi.staticfiles import StaticFiles

from vectortalker.server.access import Gate
from vectortalker.server.faults import ERROR_RESPONSES, add_fault_handlers
from vectortalker.server.guards import BodyLimit, ConfiningHeaders, KnownHosts
from vectortalker.server.observed import Figures, Observed
from vectortalker.server.routes import health, jobs, metrics, portraits, recordings, speech, tracks, videos
from vectortalker.server.services import Services


def create_app(services: Services) -> FastAPI:
    """The application; it starts no workers. Without a built page it serves the API alone."""
    app = FastAPI(
        title="VectorTalker",
        version=version("vectortalker"),
        docs_url=None,  # its page needs scripts from elsewhere, which the policy forbids
        redoc_url=None,
        openapi_url="/api/openapi.json",
        separate_input_output_schemas=False,
        responses=ERROR_RESPONSES,
        generate_unique_id_function=lambda route: route.name,
    )
    app.state.services = services
    app.state.figures = Figures(services)
    for routes in (health, metrics, portraits, jobs, videos, recordings, speech, tracks):
        app.include_router(routes.router)
    if services.settings.page.is_dir():
        app.mount("/", StaticFiles(directory=services.settings.page, html=True))
    add_fault_handlers(app)
    sounds = {recordings.router.prefix: services.settings.max_sound_bytes}
    app.add_middleware(BodyLimit, max_bytes=services.settings.max_body_bytes, max_bytes_of=sounds)
    app.add_middleware(Gate, tokens=services.settings.tokens)
    app.add_middleware(KnownHosts, hosts=services.settings.hosts)
    app.add_middleware(Observed, figures=app.state.figures)
    app.add_middleware(ConfiningHeaders)
    return app
