"""Options that name models of the user's own."""

from __future__ import annotations

import argparse
import os
from pathlib import Path


def add_segmentation_argument(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--segmentation-model",
        type=_files,
        default=_files(os.environ.get("VECTORTALKER_SEGMENTATION_MODEL", "")),
        metavar="FILE[,FILE]",
        help="an ONNX net of your own that finds the person: one of the U²-Net kind, or encoder and decoder of a SAM;"
        " default: VECTORTALKER_SEGMENTATION_MODEL",
    )


def _files(given: str) -> tuple[Path, ...]:
    return tuple(Path(name).expanduser().resolve() for name in given.split(",") if name)
