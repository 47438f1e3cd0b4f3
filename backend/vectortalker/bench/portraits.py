"""A folder of pictures becomes the portraits of a benchmark, with the landmarks of the largest face."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from vectortalker.decode import Portrait, decode
from vectortalker.landmarks import detect, to_wire
from vectortalker.schema import Landmarks

REPOSITORY = Path(__file__).resolve().parents[3]
PICTURES = (".png", ".jpg", ".jpeg", ".webp")
QUICK = 6  # portraits of `--quick`: every third or so of the development set


@dataclass(frozen=True)
class Sitter:
    """A portrait to be vectorised and its landmarks, None where no face was found."""

    portrait: Portrait
    landmarks: Landmarks | None


def shared_folder() -> Path | None:
    """Optional development data: `VECTORTALKER_SHARED`, or the folder `shared` beside the repository."""
    folder = Path(os.environ.get("VECTORTALKER_SHARED", REPOSITORY.parent / "shared"))
    return folder if folder.is_dir() else None


def portrait_folder() -> Path:
    """The development portraits, or those that the project ships."""
    shared = shared_folder()
    return shared / "data" / "portraits" if shared else REPOSITORY / "public" / "samples"


def portrait_files(folder: Path, quick: bool, names: str | None) -> list[Path]:
    """Pictures of a folder by name; `names`: comma-separated parts of file names; `quick`: `QUICK` of them, spread."""
    files = sorted(path for path in folder.iterdir() if path.suffix.lower() in PICTURES)
    if names:
        files = [path for path in files if any(name in path.name for name in names.split(","))]
    if quick:
        step = max(1, len(files) // QUICK)
        files = files[::step][:QUICK]
    return files


def sitters(files: list[Path]) -> Iterator[Sitter]:
    """Decode and find the face, one file at a time."""
    for path in files:
        portrait = decode(path.read_bytes(), path.name)
        faces = to_wire(detect(portrait.rgb), portrait.width, portrait.height).faces
        yield Sitter(portrait, faces[0].landmarks if faces else None)
