"""Make a portrait say a recording: vectorize, speech and animate in one go."""

from __future__ import annotations

import argparse
from pathlib import Path

from vectortalker.cli.animate import WITH_SOUND
from vectortalker.cli.inputs import read_portrait
from vectortalker.cli.speaking import add_speech_arguments, spoken_track
from vectortalker.cli.tracing import add_tracing_arguments, trace, tracing_settings
from vectortalker.errors import VectorTalkerError


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("portrait", type=Path, metavar="PORTRAIT")
    parser.add_argument("audio", type=Path, metavar="AUDIO")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="OUT", help="without ending: a folder")
    parser.add_argument("--fps", type=float, default=25, help="frames a second (default: %(default)s)")
    parser.add_argument("--size", type=int, default=512, help="longer side in pixels (default: %(default)s)")
    add_speech_arguments(parser)
    add_tracing_arguments(parser)


def run(options: argparse.Namespace) -> None:
    """Speech comes first: it takes seconds, and a fault of the recording should not wait for the picture."""
    from vectortalker.animate import Options, animate
    from vectortalker.animate.run import ENDINGS
    from vectortalker.cli.progress import progress_bar
    from vectortalker.schema import Project

    if options.output.suffix not in ("", *ENDINGS):
        known = ", ".join(ENDINGS)
        raise VectorTalkerError(
            "bad_option", f"{options.output.name}: known endings are {known}, or none for a folder."
        )
    settings = tracing_settings(options)
    portrait = read_portrait(options.portrait)
    with progress_bar(options.audio.name) as bar:
        track = spoken_track(options, bar)
    with progress_bar(options.portrait.name) as bar:
        traced = trace(portrait, settings, bar)
    project = Project(name=portrait.name, scene=traced.result.scene, landmarks=traced.landmarks)
    audio = options.audio if options.output.suffix in WITH_SOUND else None
    look = Options(fps=options.fps, size=options.size)
    with progress_bar(options.output.name) as bar:
        animate(project, track, options.output, look, lambda share: bar.show("drawing", share), audio)
