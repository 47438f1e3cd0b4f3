"""Work on jobs without serving: on this machine's data folder, or with other machines through Redis."""

from __future__ import annotations

import argparse
import signal
import threading

from vectortalker.cli.sharing import add_sharing_arguments, add_working_arguments, working_settings


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_sharing_arguments(parser)
    add_working_arguments(parser, default_workers=1)


def run(options: argparse.Namespace) -> None:
    """Until SIGINT or SIGTERM; what is being done then is queued again."""
    from vectortalker.server.logs import set_up_logs
    from vectortalker.server.services import open_services
    from vectortalker.server.settings import Settings
    from vectortalker.server.supervisor import Supervisor

    stop = threading.Event()
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: stop.set())
    settings = Settings(**working_settings(options))
    set_up_logs(settings.json_logs)
    Supervisor(open_services(settings)).run(stop)
