"""Turn a portrait into a layered SVG, progressively."""

from __future__ import annotations

import argparse
from contextlib import ExitStack
from pathlib import Path

from vectortalker.cli.inputs import read_portrait
from vectortalker.cli.tracing import add_tracing_arguments, project_bytes, trace, tracing_settings


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("portrait", type=Path, metavar="PORTRAIT")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="OUT.svg")
    parser.add_argument("--project", type=Path, metavar="OUT.vtalk", help="also write a project for editor and animate")
    parser.add_argument("--metrics", type=Path, metavar="OUT.json", help="also write sizes, times and scores")
    add_tracing_arguments(parser)


def run(options: argparse.Namespace) -> None:
    """All files are written at the end, or none."""
    from vectortalker.cli.progress import progress_bar
    from vectortalker.outputs import whole_file

    settings = tracing_settings(options)
    portrait = read_portrait(options.portrait)
    with ExitStack() as outputs:
        svg, project, metrics = (
            outputs.enter_context(whole_file(path)) if path else None
            for path in (options.output, options.project, options.metrics)
        )
        with progress_bar(options.portrait.name) as bar:
            traced = trace(portrait, settings, bar)
        assert svg is not None
        svg.write_text(traced.result.svg, encoding="utf-8")
        if project is not None:
            project.write_bytes(project_bytes(traced))
        if metrics is not None:
            metrics.write_text(traced.result.metrics.model_dump_json(indent=2) + "\n", encoding="utf-8")
