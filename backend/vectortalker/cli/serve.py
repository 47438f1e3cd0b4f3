"""Serve the editor and its API, with workers of its own."""

from __future__ import annotations

import argparse
import os
import signal
import sys
import threading
from pathlib import Path

PORT = 8000
SHUTDOWN_SECONDS = 2  # open event streams are cut after this
ANY_HOST = ("0.0.0.0", "::")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--host", default="127.0.0.1", help="address to listen on (default: %(default)s)")
    parser.add_argument("--port", type=int, default=os.environ.get("PORT", PORT), help="default: PORT, else 8000")
    parser.add_argument("--data", type=Path, metavar="DIR", help="portraits and jobs; default: VECTORTALKER_DATA")
    parser.add_argument("--workers", type=int, default=1, help="worker processes (default: %(default)s)")


def run(options: argparse.Namespace) -> None:
    """Until a signal ends it; the workers end with it."""
    import uvicorn

    from vectortalker.server import portraits
    from vectortalker.server.app import create_app
    from vectortalker.server.services import open_services
    from vectortalker.server.settings import LOOPBACK, Settings, data_folder
    from vectortalker.server.supervisor import Supervisor

    hosts = () if options.host in ANY_HOST else (*LOOPBACK, options.host)
    services = open_services(Settings(data_folder(options.data), workers=options.workers, hosts=hosts))
    config = uvicorn.Config(
        create_app(services),
        host=options.host,
        port=options.port,
        log_level="warning",
        timeout_graceful_shutdown=SHUTDOWN_SECONDS,
        server_header=False,
    )
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: sys.exit())  # uvicorn raises the signal again when it has shut down
    threading.Thread(target=portraits.warm_up, name="warm-up", daemon=True).start()
    stop = threading.Event()
    supervisor = threading.Thread(target=Supervisor(services).run, args=[stop], name="supervisor")
    supervisor.start()
    print(f"VectorTalker: http://{options.host}:{options.port}", flush=True)
    try:
        uvicorn.Server(config).run()
    finally:
        stop.set()
        supervisor.join()
