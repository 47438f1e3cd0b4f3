"""Hard files of the development data: each is read, or refused in one line that tells why."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from vectortalker.cli import main
from vectortalker.schema import Faces

SHARED = Path(os.environ.get("VECTORTALKER_SHARED", Path(__file__).parents[3] / "shared"))
HARD = SHARED / "data" / "hard"

REFUSED = {
    "bad-crc.png": "damaged",
    "bomb-20000x20000-1bit.png": "megapixels; the limit is 50",
    "empty.png": "0 bytes",
    "huge-header.png": "megapixels; the limit is 50",
    "one-pixel.png": "the smallest side is 16 px",
    "text-named.png": "not a picture",
    "truncated-60pct.png": "damaged or incomplete",
    "truncated-half.jpg": "damaged or incomplete",
    "vector-input.svg": "SVG",
}
FACES = {
    "exif-orientation-6.jpg": 1,
    "huge-6000x4000.jpg": 1,
    "noface-blank-white.png": 0,
    "palette-64.png": 1,
    "rgb-16bit.png": 1,
    "two-faces-officials.jpg": 2,
    "upside-down.png": 1,
}

pytestmark = pytest.mark.skipif(not HARD.is_dir(), reason=f"the development data is not at {HARD}")


@pytest.mark.parametrize("name", REFUSED)
def test_file_is_refused_in_one_line(name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["vectorize", str(HARD / name), "-o", str(tmp_path / "out.svg")]) == 2
    shown = capsys.readouterr().err
    assert shown.count("\n") == 1 and REFUSED[name] in shown
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", FACES)
def test_file_shows_its_faces(name: str, tmp_path: Path) -> None:
    out = tmp_path / "faces.json"
    assert main(["landmarks", str(HARD / name), "-o", str(out)]) == 0
    assert len(Faces.model_validate_json(out.read_text()).faces) == FACES[name]
