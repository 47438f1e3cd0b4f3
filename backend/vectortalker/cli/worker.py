"""Work on the jobs of a data folder without serving it."""

from __future__ import annotations

import argparse
import signal
import threading
from pathlib import Path


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--data", type=Path, metavar="DIR", help="portraits and jobs; default: VECTORTALKER_DATA")
    parser.add_argument("--workers", type=int, default=1, help="worker processes (default: %(default)s)")


def run(options: argparse.Namespace) -> None:
    """Until SIGINT or SIGTERM."""
    from vectortalker.server.services import open_services
    from vectortalker.server.settings import Settings, data_folder
    from vectortalker.server.supervisor import Supervisor

    stop = threading.Event()
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: stop.set())
    settings = Settings(data_folder(options.data), workers=options.workers)
    Supervisor(open_services(settings)).run(stop)
