"""Files named on the command line become bytes and portraits."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from vectortalker.errors import ErrorCode, VectorTalkerError

if TYPE_CHECKING:
    from vectortalker.decode import Portrait

MEGABYTE = 1_000_000


def read_file(path: Path, code: ErrorCode, max_bytes: int) -> bytes:
    """The whole file. Raises an error of `code` when it is not there, not readable, or larger than `max_bytes`."""
    try:
        size = path.stat().st_size
        if size > max_bytes:
            limit = f"the limit is {max_bytes / MEGABYTE:.0f} MB"
            raise VectorTalkerError(code, f"{path} has {size / MEGABYTE:.1f} MB; {limit}: save it smaller.")
        return path.read_bytes()
    except FileNotFoundError as error:
        raise VectorTalkerError(code, f"{path} does not exist: check the name.") from error
    except OSError as error:
        raise VectorTalkerError(code, f"{path} cannot be read ({error.strerror}).") from error


def read_portrait(path: Path) -> Portrait:
    from vectortalker.decode import Limits, decode

    return decode(read_file(path, "bad_picture", Limits().max_bytes), path.name)
