"""Folders of files that are written whole or not at all."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from vectortalker.errors import VectorTalkerError


@contextmanager
def whole_folder(path: Path) -> Iterator[Path]:
    """An empty folder to write to; it becomes `path` when the block ends without an exception.

    Raises `bad_option` when `path` already holds something.
    """
    if path.exists() and (not path.is_dir() or any(path.iterdir())):
        raise VectorTalkerError("bad_option", f"{path} exists and is not an empty folder. Name a new one.")
    draft = Path(tempfile.mkdtemp(prefix=f".{path.name}-", dir=path.absolute().parent))
    try:
        yield draft
        draft.chmod(0o755)
        draft.replace(path)
    finally:
        shutil.rmtree(draft, ignore_errors=True)
