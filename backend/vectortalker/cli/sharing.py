"""The options of all commands that serve, do or hand in jobs: where these lie, and who else sees them."""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path
from typing import Any

from vectortalker.cli.own_models import add_segmentation_argument
from vectortalker.errors import VectorTalkerError


def add_sharing_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--data", type=Path, metavar="DIR", help="portraits and jobs; default: VECTORTALKER_DATA")
    parser.add_argument(
        "--redis",
        metavar="URL",
        default=os.environ.get("VECTORTALKER_REDIS"),
        help="share jobs with other machines through redis://HOST:PORT/NUMBER; default: VECTORTALKER_REDIS, else SQLite"
        " in the data folder",
    )
    parser.add_argument(
        "--blobs",
        metavar="URL",
        default=os.environ.get("VECTORTALKER_BLOBS"),
        help="keep pictures and results in a shared folder or in any store of fsspec (s3://…); default:"
        " VECTORTALKER_BLOBS, else the data folder",
    )


def add_working_arguments(parser: argparse.ArgumentParser, default_workers: int) -> None:
    parser.add_argument(
        "--workers",
        type=int,
        default=default_workers,
        metavar="N",
        help="worker processes; two or more get cores of their own (default: %(default)s)",
    )
    parser.add_argument(
        "--max-attempts", type=int, default=3, metavar="N", help="starts of a job that never gets on, then it fails"
    )
    parser.add_argument(
        "--no-worker-seconds", type=float, default=300, metavar="S", help="waiting jobs fail after S without any worker"
    )
    add_segmentation_argument(parser)
    parser.add_argument("--retention-days", type=float, default=30, metavar="D", help="unused data is deleted after D")
    parser.add_argument("--cache-mb", type=float, default=1000, metavar="MB", help="results kept for reuse; 0: none")
    parser.add_argument("--min-free-mb", type=float, default=200, metavar="MB", help="of the disk, which stay free")
    parser.add_argument(
        "--log-format", choices=("text", "json"), default="text" if sys.stderr.isatty() else "json", help="of stderr"
    )


def sharing_settings(options: argparse.Namespace) -> dict[str, Any]:
    """Fields of `Settings`."""
    from vectortalker.server.settings import data_folder

    return {"data": data_folder(options.data), "redis": options.redis, "blobs": options.blobs}


def working_settings(options: argparse.Namespace) -> dict[str, Any]:
    """Fields of `Settings`. Raises `bad_option`."""
    from vectortalker.server.settings import DAY_SECONDS, MEGABYTE

    least = {"workers": 0, "max_attempts": 1, "no_worker_seconds": 0, "retention_days": 0, "cache_mb": 0}
    for name, minimum in {**least, "min_free_mb": 0}.items():
        value = getattr(options, name)
        if not value >= minimum:
            flag = f"--{name.replace('_', '-')}"
            raise VectorTalkerError("bad_option", f"{flag} {value:g}: at least {minimum} is needed.")
    return {
        **sharing_settings(options),
        "workers": options.workers,
        "segmentation_model": options.segmentation_model,
        "max_attempts": options.max_attempts,
        "no_worker_seconds": options.no_worker_seconds,
        "retention_seconds": options.retention_days * DAY_SECONDS,
        "max_cache_bytes": int(options.cache_mb * MEGABYTE),
        "min_free_bytes": int(options.min_free_mb * MEGABYTE),
        "json_logs": options.log_format == "json",
    }
