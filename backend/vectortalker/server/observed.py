"""What requests and jobs look like from outside: a log line a request, and figures for Prometheus."""

from __future__ import annotations

import logging
import time
from collections.abc import Iterator

from prometheus_client import CollectorRegistry, Histogram, generate_latest
from prometheus_client.core import CounterMetricFamily, GaugeMetricFamily, Metric
from prometheus_client.registry import Collector
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from vectortalker.server.logs import about_job
from vectortalker.server.record import ENDED
from vectortalker.server.services import Services

BUCKETS = (0.005, 0.01, 0.025, 0.05, 0.1, 0.2, 0.5, 1.0, 2.5, 5.0, 10.0)  # seconds

log = logging.getLogger("vectortalker.requests")


class Figures:
    """Of this server's requests, and of the jobs of all processes, which the store knows."""

    def __init__(self, services: Services) -> None:
        self._registry = CollectorRegistry()
        self._registry.register(_Work(services))
        self.requests = Histogram(
            "vectortalker_request_seconds",
            "Time until a request was answered.",
            ("method", "route", "status"),
            buckets=BUCKETS,
            registry=self._registry,
        )

    def text(self) -> bytes:
        """In Prometheus' exposition format."""
        return generate_latest(self._registry)


class _Work(Collector):
    def __init__(self, services: Services) -> None:
        self._services = services

    def collect(self) -> Iterator[Metric]:
        jobs = self._services.jobs
        for phase in ("queued", "running"):
            yield GaugeMetricFamily(f"vectortalker_jobs_{phase}", f"Jobs that are {phase} now.", jobs.count(phase))
        yield GaugeMetricFamily("vectortalker_workers_ready", "Workers that take jobs.", jobs.ready_workers())
        ended = CounterMetricFamily("vectortalker_jobs_ended", "Jobs that have ended.", labels=["phase"])
        for phase in ENDED:
            ended.add_metric([phase], jobs.ended(phase))
        yield ended
        total = self._services.cache.total_bytes()
        yield GaugeMetricFamily("vectortalker_cache_bytes", "Size of the results kept for reuse.", total)
        free = self._services.blobs.free_bytes()
        if free is not None:
            yield GaugeMetricFamily("vectortalker_free_bytes", "Free space on the disk for blobs.", free)


class Observed:
    """Times every request by its route; those that change or fail are logged, without query or body."""

    def __init__(self, app: ASGIApp, figures: Figures) -> None:
        self._app = app
        self._figures = figures

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            return await self._app(scope, receive, send)
        began, status, seconds = time.perf_counter(), 500, 0.0

        async def send_timed(message: Message) -> None:
            nonlocal status, seconds
            if message["type"] == "http.response.start":
                status, seconds = message["status"], time.perf_counter() - began
            await send(message)

        try:
            await self._app(scope, receive, send_timed)
        finally:
            self._note(scope, status, seconds or time.perf_counter() - began)

    def _note(self, scope: Scope, status: int, seconds: float) -> None:
        route = getattr(scope.get("route"), "path", "page")  # "page": static files, and paths that are none
        self._figures.requests.labels(scope["method"], route, str(status)).observe(seconds)
        if not scope["path"].startswith("/api/"):
            return
        fields = {"method": scope["method"], "route": route, "status": status, "ms": round(1000 * seconds, 1)}
        job_id = scope.get("path_params", {}).get("job_id")
        is_news = scope["method"] != "GET" or status >= 400
        with about_job(job_id):
            log.log(logging.INFO if is_news else logging.DEBUG, "answered", extra=fields)
