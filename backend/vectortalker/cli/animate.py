"""Play a track on a project: animated SVG, web page, MP4, WebM, GIF or PNG frames, by the ending of OUT."""

from __future__ import annotations

import argparse
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from vectortalker.cli.inputs import read_file
from vectortalker.errors import VectorTalkerError

if TYPE_CHECKING:
    from vectortalker.project import ProjectFile

WITH_SOUND = (".html", ".mp4", ".webm")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("project", type=Path, metavar="PROJECT.vtalk")
    parser.add_argument("--track", type=Path, required=True, help="track JSON, 68-point CSV, or Rhubarb JSON or TSV")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="OUT", help="without ending: a folder")
    parser.add_argument("--audio", type=Path, metavar="FILE", help="sound; default: that of the project, if any")
    parser.add_argument("--fps", type=float, default=25, help="frames a second (default: %(default)s)")
    parser.add_argument("--size", type=int, default=512, help="longer side in pixels (default: %(default)s)")


def run(options: argparse.Namespace) -> None:
    from vectortalker.animate import Options, animate
    from vectortalker.cli.progress import progress_bar
    from vectortalker.project import MAX_FILE_BYTES, unpack
    from vectortalker.tracks import MAX_BYTES, read_track

    file = unpack(read_file(options.project, "bad_project", MAX_FILE_BYTES), options.project.name)
    track = read_track(read_file(options.track, "bad_track", MAX_BYTES), options.track.name)
    look = Options(fps=options.fps, size=options.size)
    with _sound(options, file) as audio, progress_bar(options.output.name) as bar:
        animate(file.project, track, options.output, look, lambda share: bar.show("drawing", share), audio)


@contextmanager
def _sound(options: argparse.Namespace, file: ProjectFile) -> Iterator[Path | None]:
    """The file named, else the project's sound as a file if the output can hold it. Raises `bad_audio`."""
    if options.audio is not None and not options.audio.is_file():
        raise VectorTalkerError("bad_audio", f"{options.audio} does not exist: check the name.")
    if options.audio is not None or file.audio is None or options.output.suffix not in WITH_SOUND:
        yield options.audio
        return
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / str(file.project.audio)
        path.write_bytes(file.audio)
        yield path
