"""Where the server keeps its data and what it allows."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

import platformdirs

REPOSITORY = Path(__file__).parents[3]
MEGABYTE = 1_000_000
LOOPBACK = ("127.0.0.1", "localhost", "[::1]")


@dataclass(frozen=True)
class Settings:
    """`data` holds blobs and databases; `page` is the built web page, public files included."""

    data: Path
    page: Path = REPOSITORY / "web" / "dist"
    workers: int = 1  # one job uses all cores at most of its steps
    max_queued: int = 100
    max_body_bytes: int = 32 * MEGABYTE  # a picture (25 MB) or a scene with an hour's reduced track
    min_free_bytes: int = 200 * MEGABYTE
    hosts: tuple[str, ...] = LOOPBACK  # names the server answers to; none: to any


def data_folder(given: Path | None) -> Path:
    """The folder named on the command line, else by VECTORTALKER_DATA, else the user's data folder of the platform."""
    named = given or os.environ.get("VECTORTALKER_DATA") or platformdirs.user_data_dir("vectortalker", appauthor=False)
    return Path(named).expanduser().resolve()
