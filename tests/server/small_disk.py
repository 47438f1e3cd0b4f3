"""A disk small enough to be filled."""

from __future__ import annotations

import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

REASON = "mounting a small disk needs root"
BLOCK_BYTES = 4096


@contextmanager
def small_disk(folder: Path, megabytes: int) -> Iterator[bool]:
    """`folder` is such a disk meanwhile, if this user may mount one; whether it is."""
    folder.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", f"size={megabytes}m", "tmpfs", str(folder)]
    mounted = subprocess.run(mount, capture_output=True).returncode == 0
    try:
        yield mounted
    finally:
        if mounted:
            subprocess.run(["umount", "--lazy", str(folder)], check=True)


def fill(file: Path) -> None:
    """`file` takes all that is left of its disk."""
    with file.open("wb", buffering=0) as filling:
        try:
            while True:
                filling.write(bytes(BLOCK_BYTES))
        except OSError:
            return
