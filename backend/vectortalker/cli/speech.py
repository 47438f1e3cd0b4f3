"""Turn a recording of speech into a track: mouth, blinks, head and brows."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from vectortalker.cli.speaking import add_speech_arguments, spoken_track
from vectortalker.errors import VectorTalkerError

if TYPE_CHECKING:
    from vectortalker.tracks import Format

FORMATS: dict[str, Format] = {".tsv": "rhubarb-tsv", ".csv": "csv"}  # by ending; all others are JSON
ENDINGS = "OUT.tsv: mouth cues of Rhubarb; OUT.csv: rows of 68 points; else JSON"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("audio", type=Path, metavar="AUDIO", help="any sound file of up to 10 minutes")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="TRACK.json", help=ENDINGS)
    parser.add_argument("--as", dest="kind", choices=("articulators", "landmarks"), help="default: articulators")
    parser.add_argument("--seed", type=int, default=0, help="of blinks and head motion (default: %(default)s)")
    add_speech_arguments(parser)


def run(options: argparse.Namespace) -> None:
    from vectortalker.cli.progress import progress_bar
    from vectortalker.outputs import whole_file
    from vectortalker.speech import as_landmarks
    from vectortalker.tracks import write_track

    if options.model is not None and options.kind == "articulators":
        raise VectorTalkerError("bad_option", "--as articulators: a --model of your own gives landmarks.")
    with whole_file(options.output) as draft:
        with progress_bar(options.audio.name) as bar:
            track = spoken_track(options, bar)
            if options.kind == "landmarks" and track.landmarks is None:
                track = as_landmarks(track)
        draft.write_text(write_track(track, FORMATS.get(options.output.suffix, "json")), encoding="utf-8")
