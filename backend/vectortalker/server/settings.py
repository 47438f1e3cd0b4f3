"""Where the server keeps its data and what it allows."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

import platformdirs

REPOSITORY = Path(__file__).parents[3]
MEGABYTE = 1_000_000
DAY_SECONDS = 86_400.0
LOOPBACK = ("127.0.0.1", "localhost", "[::1]")


@dataclass(frozen=True)
class Settings:
    """`data` holds blobs and databases; `page` is the built web page, public files included.

    `redis` (a URL) takes the place of the databases and `blobs` (a URL of fsspec) that of the folder for blobs, so that
    machines can share them.
    """

    data: Path
    page: Path = REPOSITORY / "web" / "dist"
    redis: str | None = None
    blobs: str | None = None
    workers: int = 1  # one job uses all cores at most of its steps
    max_queued: int = 500
    max_active: int = 50  # jobs of one client that wait or run
    max_attempts: int = 3  # at a job that never got on; then it is set aside
    no_worker_seconds: float = 300.0  # jobs that wait fail when no worker was ready for so long
    max_body_bytes: int = 32 * MEGABYTE  # a picture (25 MB) or a scene with an hour's reduced track
    max_sound_bytes: int = 120 * MEGABYTE  # ten minutes of stereo WAV
    segmentation_model: tuple[Path, ...] = ()  # of the user's own (`segmenter.open_segmenter`)
    min_free_bytes: int = 200 * MEGABYTE
    max_cache_bytes: int = 1000 * MEGABYTE
    retention_seconds: float = 30 * DAY_SECONDS  # after their last use portraits and jobs are deleted
    hosts: tuple[str, ...] = LOOPBACK  # names the server answers to; none: to any
    tokens: tuple[str, ...] = ()  # one of them opens the API; none: it is open
    json_logs: bool = False


def data_folder(given: Path | None) -> Path:
    """The folder named on the command line, else by VECTORTALKER_DATA, else the user's data folder of the platform."""
    named = given or os.environ.get("VECTORTALKER_DATA") or platformdirs.user_data_dir("vectortalker", appauthor=False)
    return Path(named).expanduser().resolve()
