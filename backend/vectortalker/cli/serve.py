"""Serve the editor and its API, with workers of its own."""

from __future__ import annotations

import argparse
import ipaddress
import os
import secrets
import signal
import sys
import threading
from typing import TYPE_CHECKING

from vectortalker.cli.sharing import add_sharing_arguments, add_working_arguments, working_settings
from vectortalker.errors import VectorTalkerError

if TYPE_CHECKING:
    import uvicorn

    from vectortalker.server.services import Services
    from vectortalker.server.settings import Settings

PORT = 8000
SHUTDOWN_SECONDS = 2  # open event streams are cut after this
KEEP_ALIVE_SECONDS = 75  # longer than clients pause, so that none sends on a connection that is just being closed
JOIN_SECONDS = 10.0  # for a supervisor that waits for an unreachable store; workers end with the server in any case
ANY_HOST = ("0.0.0.0", "::")
LOCAL_NAMES = ("localhost",)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--host", default="127.0.0.1", help="address to listen on (default: %(default)s)")
    parser.add_argument("--port", type=int, default=os.environ.get("PORT", PORT), help="default: PORT, else 8000")
    parser.add_argument(
        "--token",
        action="append",
        metavar="TOKEN",
        help="only who knows it may use the API; may be given more than once; default: VECTORTALKER_TOKEN (several"
        " parted by commas). Without one, a server that others can reach makes its own and prints it",
    )
    add_sharing_arguments(parser)
    add_working_arguments(parser, default_workers=1)
    parser.add_argument("--max-queued", type=int, default=500, metavar="N", help="waiting jobs, then 429")
    parser.add_argument("--max-active", type=int, default=50, metavar="N", help="jobs of one client, then 429")


def run(options: argparse.Namespace) -> None:
    """Until SIGINT or SIGTERM; what the workers are at is queued again."""
    from vectortalker.server.logs import set_up_logs
    from vectortalker.server.services import open_services
    from vectortalker.server.settings import LOOPBACK, Settings

    settings = Settings(
        **working_settings(options),
        hosts=() if options.host in ANY_HOST else (*LOOPBACK, options.host),
        tokens=_tokens(options),
        max_queued=options.max_queued,
        max_active=options.max_active,
    )
    set_up_logs(settings.json_logs)
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: sys.exit())  # uvicorn raises the signal again when it has shut down
    services = open_services(settings)
    _serve(services, _server(services, options.host, options.port), _address(options, settings))


def _tokens(options: argparse.Namespace) -> tuple[str, ...]:
    given = options.token or [token for token in os.environ.get("VECTORTALKER_TOKEN", "").split(",") if token]
    if not all(given):
        raise VectorTalkerError("bad_option", "--token is empty: give one of some 20 random characters.")
    return tuple(given) if given or _is_loopback(options.host) else (secrets.token_urlsafe(24),)


def _is_loopback(host: str) -> bool:
    if host in LOCAL_NAMES:
        return True
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False


def _address(options: argparse.Namespace, settings: Settings) -> str:
    return f"http://{options.host}:{options.port}" + (f"/?token={settings.tokens[0]}" if settings.tokens else "")


def _server(services: Services, host: str, port: int) -> uvicorn.Server:
    import uvicorn

    from vectortalker.server.app import create_app

    config = uvicorn.Config(
        create_app(services),
        host=host,
        port=port,
        log_config=None,
        access_log=False,
        timeout_graceful_shutdown=SHUTDOWN_SECONDS,
        timeout_keep_alive=KEEP_ALIVE_SECONDS,
        server_header=False,
    )
    return uvicorn.Server(config)


def _serve(services: Services, server: uvicorn.Server, address: str) -> None:
    from vectortalker.server import portraits
    from vectortalker.server.supervisor import Supervisor

    threading.Thread(target=portraits.warm_up, name="warm-up", daemon=True).start()
    stop = threading.Event()
    supervisor = threading.Thread(target=Supervisor(services).run, args=[stop], name="supervisor", daemon=True)
    supervisor.start()
    print(f"VectorTalker: {address}", flush=True)
    try:
        server.run()
    finally:
        stop.set()
        supervisor.join(JOIN_SECONDS)
