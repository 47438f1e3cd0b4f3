"""Files that are written whole or not at all."""

from __future__ import annotations

import errno
import os
import secrets
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from vectortalker.errors import VectorTalkerError


@contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """A path beside `path` to write to, of the same ending; it takes the place of `path` if the block succeeds.

    Raises `bad_option` when the folder is not there or cannot be written to, `storage_full` when its disk is full.
    """
    part = path.with_name(f".{path.stem}-{secrets.token_hex(4)}{path.suffix}")
    try:
        part.touch(exist_ok=False)
    except OSError as error:
        raise VectorTalkerError("bad_option", f"{path} cannot be written ({error.strerror}).") from error
    try:
        yield part
        os.replace(part, path)
    except IsADirectoryError as error:
        raise VectorTalkerError("bad_option", f"{path} is a folder: name a file.") from error
    except OSError as error:
        if error.errno != errno.ENOSPC:
            raise
        raise VectorTalkerError("storage_full", f"The disk of {path} is full: make room there.") from error
    finally:
        part.unlink(missing_ok=True)


def write_whole(path: Path, data: bytes) -> None:
    with whole_file(path) as part:
        part.write_bytes(data)
