"""The committed OpenAPI document and the types made of it are what the models say."""

from __future__ import annotations

import json
import shutil
import subprocess
from pathlib import Path

import pytest
from vectortalker.server.openapi import document

REPOSITORY = Path(__file__).parents[2]
COMMITTED = REPOSITORY / "web" / "src" / "api" / "openapi.json"


def test_openapi_document_is_current() -> None:
    assert json.loads(COMMITTED.read_text(encoding="utf-8")) == document(), "run `npm run gen` and commit"


@pytest.mark.skipif(shutil.which("node") is None, reason="the generator of the types runs in Node")
def test_typescript_types_are_current() -> None:
    check = ["node", "scripts/gen.mjs", "--check"]
    done = subprocess.run(check, cwd=REPOSITORY, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def test_one_schema_serves_input_and_output() -> None:
    names = document()["components"]["schemas"]
    assert {"Project", "Track", "Pose", "JobState", "Scene"} <= set(names)
    assert not [name for name in names if name.endswith(("-Input", "-Output"))]
