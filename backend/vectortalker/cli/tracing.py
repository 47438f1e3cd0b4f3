"""What `vectorize` and `batch` share: one portrait becomes the bytes of its files, with a progress bar."""

from __future__ import annotations

import argparse
import io
from dataclasses import dataclass
from typing import TYPE_CHECKING

from pydantic import ValidationError

from vectortalker.cli.own_models import add_segmentation_argument
from vectortalker.errors import VectorTalkerError
from vectortalker.schema import VectorizeOptions

if TYPE_CHECKING:
    from vectortalker.cli.progress import Bar
    from vectortalker.decode import Portrait
    from vectortalker.schema import Landmarks
    from vectortalker.segmenter import Segmenter
    from vectortalker.vectorize import Result

NUMBERS = {
    "paths": "budget of paths in all layers; default: the preset's",
    "segments": "cubics of a path; default: 8",
    "levels": "coarse to fine; default: the preset's",
    "iterations": "in every level but the last; default: the preset's",
    "final_iterations": "in the last level; default: the preset's",
    "seed": "of all random choices: the same seed gives the same SVG; default: 0",
    "working_size": "longer side in px at which paths are fitted; default: the preset's",
}
CHOICES = {
    "preset": (
        ("draft", "standard", "fine"),
        "draft: 250 paths, quick; standard: 500; fine: 1,200 at 1,024 px; default: standard",
    ),
    "recipe": (
        ("best", "paper", "diffvg"),
        "paper: the VectorTalker paper's; diffvg: all paths at once from random circles; both with their own "
        "schedules whatever the preset; default: best",
    ),
    "fills": (("solid", "gradient"), "default: gradient for best, solid for the others"),
    "opacity": (("free", "opaque"), "opaque paths are easier to edit and fit a decibel worse; default: free"),
}


@dataclass(frozen=True)
class TracingSettings:
    """`segmenter`: a net of the user's own, or None."""

    options: VectorizeOptions
    segmenter: Segmenter | None


@dataclass(frozen=True)
class Traced:
    portrait: Portrait
    landmarks: Landmarks | None
    result: Result


def add_tracing_arguments(parser: argparse.ArgumentParser) -> None:
    """Those of `schema.VectorizeOptions`; what is not given is left to the preset."""
    for name, meaning in NUMBERS.items():
        parser.add_argument(_flag(name), type=int, metavar="N", help=meaning)
    for name, (choices, meaning) in CHOICES.items():
        parser.add_argument(_flag(name), choices=choices, help=meaning)
    parser.add_argument("--no-layers", dest="layers", action="store_const", const=False, help="one flat picture")
    add_segmentation_argument(parser)


def tracing_settings(options: argparse.Namespace) -> TracingSettings:
    """Raises `bad_option`."""
    from vectortalker.segmenter import open_segmenter

    files = options.segmentation_model
    return TracingSettings(tracing_options(options), open_segmenter(files) if files else None)


def tracing_options(options: argparse.Namespace) -> VectorizeOptions:
    """Raises `bad_option`."""
    given = {name: getattr(options, name) for name in (*NUMBERS, *CHOICES, "layers")}
    try:
        return VectorizeOptions.model_validate({name: value for name, value in given.items() if value is not None})
    except ValidationError as error:
        fault = error.errors()[0]
        flag = _flag(str(fault["loc"][0]))
        raise VectorTalkerError("bad_option", f"{flag} {fault['input']}: {fault['msg']}.") from error


def trace(portrait: Portrait, settings: TracingSettings, bar: Bar) -> Traced:
    """Detect the largest face and vectorise."""
    from vectortalker.landmarks import detect, to_wire
    from vectortalker.vectorize import vectorize

    bar.show("finding the face", 0)
    faces = to_wire(detect(portrait.rgb), portrait.width, portrait.height).faces
    landmarks = faces[0].landmarks if faces else None
    steps = vectorize(portrait, landmarks, settings.options, segmenter=settings.segmenter)
    while True:
        try:
            progress = next(steps)
        except StopIteration as end:
            bar.show("done", 1)
            return Traced(portrait, landmarks, end.value)
        bar.show(progress.stage, progress.fraction)


def project_bytes(traced: Traced) -> bytes:
    """The `.vtalk` file; its source is the normalised picture, in whose pixels all coordinates are."""
    from PIL import Image

    from vectortalker.project import ProjectFile, pack
    from vectortalker.schema import Project

    source = io.BytesIO()
    Image.fromarray(traced.portrait.rgb).save(source, "PNG")
    name = traced.portrait.name
    project = Project(name=name, scene=traced.result.scene, landmarks=traced.landmarks, source="source.png")
    return pack(ProjectFile(project, source.getvalue()))


def _flag(name: str) -> str:
    return f"--{name.replace('_', '-')}"
