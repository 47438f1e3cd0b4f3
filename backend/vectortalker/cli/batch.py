"""Vectorise every picture of a folder; pictures that cannot be are named, and the rest goes on."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from vectortalker.cli.inputs import read_portrait
from vectortalker.cli.sharing import add_sharing_arguments, sharing_settings
from vectortalker.cli.tracing import (
    Traced,
    TracingSettings,
    add_tracing_arguments,
    project_bytes,
    trace,
    tracing_options,
    tracing_settings,
)
from vectortalker.errors import VectorTalkerError
from vectortalker.schema import VectorizeOptions

USER_AT_FAULT = 2


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("folder", type=Path, metavar="DIR")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="DIR", help="gets NAME.svg and NAME.vtalk")
    parser.add_argument(
        "--handed-in",
        action="store_true",
        help="leave the work to the running workers of --redis, or of --data on this machine",
    )
    add_sharing_arguments(parser)
    add_tracing_arguments(parser)


def run(options: argparse.Namespace) -> int:
    """2 if any picture was refused."""
    if options.handed_in and options.segmentation_model:
        raise VectorTalkerError(
            "bad_option", "--segmentation-model is for who does the work: start the workers with it."
        )
    if not options.folder.is_dir():
        raise VectorTalkerError("bad_option", f"{options.folder} is no folder: name one with pictures.")
    options.output.mkdir(parents=True, exist_ok=True)
    pictures = sorted(path for path in options.folder.iterdir() if path.is_file())
    if options.handed_in:
        n_refused = _hand_in(options, pictures, tracing_options(options))
    else:
        n_refused = _do(options.output, pictures, tracing_settings(options))
    return USER_AT_FAULT if n_refused else 0


def _do(output: Path, pictures: list[Path], settings: TracingSettings) -> int:
    """One after the other in this process; how many were refused."""
    from vectortalker.cli.progress import progress_bar

    n_refused = 0
    for path in pictures:
        try:
            with progress_bar(path.name) as bar:
                traced = trace(read_portrait(path), settings, bar)
        except VectorTalkerError as error:
            n_refused += 1
            _refuse(error)
            continue
        _write(output, path.name, traced)
    return n_refused


def _hand_in(options: argparse.Namespace, pictures: list[Path], settings: VectorizeOptions) -> int:
    """By other processes, as many at a time as there are; how many were refused."""
    from vectortalker.cli.handing_in import hand_in
    from vectortalker.cli.progress import progress_bar
    from vectortalker.server.services import open_services
    from vectortalker.server.settings import Settings

    services = open_services(Settings(**sharing_settings(options)))
    n_refused = 0
    try:
        with progress_bar(options.folder.name) as bar:
            for number, (path, outcome) in enumerate(hand_in(services, pictures, settings), 1):
                bar.show(f"{number} of {len(pictures)}", number / len(pictures))
                if isinstance(outcome, VectorTalkerError):
                    n_refused += 1
                    _refuse(outcome)
                else:
                    _write(options.output, path.name, outcome)
    finally:
        services.close()
    return n_refused


def _refuse(error: VectorTalkerError) -> None:
    print(f"vectortalker: {error.message}", file=sys.stderr)


def _write(output: Path, name: str, traced: Traced) -> None:
    from vectortalker.outputs import write_whole

    write_whole(output / f"{name}.svg", traced.result.svg.encode())
    write_whole(output / f"{name}.vtalk", project_bytes(traced))
