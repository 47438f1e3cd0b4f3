"""Find the faces of a portrait and their landmarks."""

from __future__ import annotations

import argparse
from pathlib import Path

from vectortalker.cli.inputs import read_portrait


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("portrait", type=Path, metavar="PORTRAIT")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="OUT.json")


def run(options: argparse.Namespace) -> None:
    """Writes `schema.Faces`, largest face first; no face is an answer, too."""
    from vectortalker.landmarks import detect, to_wire
    from vectortalker.outputs import write_whole

    portrait = read_portrait(options.portrait)
    faces = to_wire(detect(portrait.rgb), portrait.width, portrait.height)
    write_whole(options.output, faces.model_dump_json(indent=2).encode() + b"\n")
