"""Vectorise every picture of a folder; pictures that cannot be are named, and the rest goes on."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from vectortalker.cli.inputs import read_portrait
from vectortalker.cli.tracing import add_tracing_arguments, project_bytes, trace, tracing_options
from vectortalker.errors import VectorTalkerError

USER_AT_FAULT = 2


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("folder", type=Path, metavar="DIR")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="DIR", help="gets NAME.svg and NAME.vtalk")
    add_tracing_arguments(parser)


def run(options: argparse.Namespace) -> int:
    """2 if any picture was refused."""
    from vectortalker.cli.progress import progress_bar
    from vectortalker.outputs import write_whole

    settings = tracing_options(options)
    if not options.folder.is_dir():
        raise VectorTalkerError("bad_option", f"{options.folder} is no folder: name one with pictures.")
    options.output.mkdir(parents=True, exist_ok=True)
    n_refused = 0
    for path in sorted(path for path in options.folder.iterdir() if path.is_file()):
        try:
            with progress_bar(path.name) as bar:
                traced = trace(read_portrait(path), settings, bar)
        except VectorTalkerError as error:
            n_refused += 1
            print(f"vectortalker: {error.message}", file=sys.stderr)
            continue
        write_whole(options.output / f"{path.name}.svg", traced.result.svg.encode())
        write_whole(options.output / f"{path.name}.vtalk", project_bytes(traced))
    return USER_AT_FAULT if n_refused else 0
