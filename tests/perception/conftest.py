"""Portraits of the repository, and the optional folder of development data."""

from __future__ import annotations

import os
from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest
from vectortalker.decode import Portrait, decode

ROOT = Path(__file__).resolve().parents[2]
SAMPLES = ROOT / "public" / "samples"
SHARED = Path(os.environ.get("VECTORTALKER_SHARED", ROOT.parent / "shared"))


@pytest.fixture(scope="session")
def sample() -> Callable[[str], Portrait]:
    """Decodes one of the sample pictures by its file name."""
    return cache(lambda name: decode((SAMPLES / name).read_bytes(), name))


@pytest.fixture(scope="session")
def shared_data() -> Path:
    data = SHARED / "data"
    if not data.is_dir():
        pytest.skip("the folder of development data is not there (set VECTORTALKER_SHARED)")
    return data
