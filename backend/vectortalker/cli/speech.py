"""Turn a recording of speech into a track: mouth, blinks, head and brows."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from vectortalker.cli.speaking import add_speech_arguments, speech_options

if TYPE_CHECKING:
    from vectortalker.tracks import Format

FORMATS: dict[str, Format] = {".tsv": "rhubarb-tsv", ".csv": "csv"}  # by ending; all others are JSON
ENDINGS = "OUT.tsv: mouth cues of Rhubarb; OUT.csv: rows of 68 points; else JSON"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("audio", type=Path, metavar="AUDIO", help="any sound file of up to 10 minutes")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="TRACK.json", help=ENDINGS)
    parser.add_argument("--as", dest="kind", choices=("articulators", "landmarks"), default="articulators")
    parser.add_argument("--seed", type=int, default=0, help="of blinks and head motion (default: %(default)s)")
    add_speech_arguments(parser)


def run(options: argparse.Namespace) -> None:
    from vectortalker.cli.progress import progress_bar
    from vectortalker.outputs import whole_file
    from vectortalker.speech import as_landmarks, track_from_audio
    from vectortalker.tracks import write_track

    with whole_file(options.output) as draft:
        with progress_bar(options.audio.name) as bar:
            track = track_from_audio(options.audio, speech_options(options), bar.show)
            if options.kind == "landmarks":
                track = as_landmarks(track)
        draft.write_text(write_track(track, FORMATS.get(options.output.suffix, "json")), encoding="utf-8")
