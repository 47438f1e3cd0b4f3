"""A scene becomes the text of a static SVG: three groups in painter's order, local groups clipped by their openings."""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import groupby
from xml.sax.saxutils import escape

import numpy as np
from numpy.typing import NDArray

from vectortalker.scene import OPENING_OF_PART, OPENINGS, PARTS
from vectortalker.schema import Fill, LinearFill, LocalPath, Scene, ScenePath

NO_XML = re.compile("[^\t\n\r\u0020-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")  # no document may hold these
BLEED = 0.05  # of the frame's sides: more than half a pixel of any picture of 10 px or more


def to_svg(scene: Scene, openings: Sequence[NDArray[np.float64]], title: str, size: tuple[int, int]) -> str:
    """Valid SVG 1.1 on its own: `viewBox` in portrait pixels, `<g id="back">`, `<g id="fore">`, `<g id="local">`.

    `size`: width and height in px at which it is shown if the page says nothing; a working picture's whole pixels,
    because renderers that scale the `viewBox` alone round its sides in their own ways.
    `openings`: closed cubic outlines [3S, 2] of left eye, right eye and mouth (`scene.OPENINGS`); an empty one hides
    its paths, as a closed mouth does; none at all, and the local groups are not clipped.
    """
    paths = [*scene.back, *scene.fore, *scene.local]
    gradients = [_gradient(index, path.fill) for index, path in enumerate(paths) if isinstance(path.fill, LinearFill)]
    n_back, n_below = len(scene.back), len(scene.back) + len(scene.fore)
    box = f"0 0 {number(scene.width)} {number(scene.height)}"
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}" width="{size[0]}" height="{size[1]}">',
        f"<title>{escape(NO_XML.sub('', title))}</title>",
        f"<desc>Layered vector portrait of {len(paths)} paths: back, fore, local. Made with VectorTalker.</desc>",
        *_definitions(gradients, openings),
        _canvas(scene),
        *_group("back", scene.back, 0),
        *_group("fore", scene.fore, n_back),
        *_local_group(scene.local, n_below, clipped=len(openings) > 0),
        "</svg>",
    ]
    return "\n".join(lines) + "\n"


def number(value: float) -> str:
    """Shortest decimal of at most two places: `12.5`, `-3`, `0.07`."""
    text = f"{value:.2f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def path_data(points: Sequence[float]) -> str:
    """Closed chain of cubics as `d`: flat x, y of anchor, handle, handle per segment."""
    written = [number(value) for value in points]
    ends = [*written[2:], *written[:2]]
    pairs = [f"{x} {y}" for x, y in zip(ends[0::2], ends[1::2], strict=True)]
    return f"M{written[0]} {written[1]}C{' '.join(pairs)}Z"


def _definitions(gradients: list[str], openings: Sequence[NDArray[np.float64]]) -> list[str]:
    clips = [
        f'<clipPath id="opening-{name}">{_clip_outline(outline)}</clipPath>'
        for name, outline in zip(OPENINGS, openings, strict=False)
    ]
    return ["<defs>", *clips, *gradients, "</defs>"] if clips or gradients else []


def _clip_outline(outline: NDArray[np.float64]) -> str:
    return f'<path d="{path_data(outline.ravel().tolist())}"/>' if len(outline) else ""


def _gradient(path: int, fill: LinearFill) -> str:
    (x1, y1), (x2, y2) = fill.start, fill.end
    offsets = (number(index / (len(fill.stops) - 1)) for index in range(len(fill.stops)))
    stops = "".join(
        f'<stop offset="{offset}" stop-color="{stop.colour}"{_opacity("stop-opacity", stop.opacity)}/>'
        for offset, stop in zip(offsets, fill.stops, strict=True)
    )
    ends = f'x1="{number(x1)}" y1="{number(y1)}" x2="{number(x2)}" y2="{number(y2)}"'
    return f'<linearGradient id="g{path}" gradientUnits="userSpaceOnUse" {ends}>{stops}</linearGradient>'


def _canvas(scene: Scene) -> str:
    """Ground a little larger than the frame, so that no page shows beside it when a viewer rounds the sides."""
    width, height = number(scene.width * (1 + 2 * BLEED)), number(scene.height * (1 + 2 * BLEED))
    x, y = number(-scene.width * BLEED), number(-scene.height * BLEED)
    return f'<rect x="{x}" y="{y}" width="{width}" height="{height}" fill="{scene.canvas}"/>'


def _group(name: str, paths: Sequence[ScenePath], first_index: int) -> list[str]:
    return [f'<g id="{name}">', *(_path(path, first_index + i) for i, path in enumerate(paths)), "</g>"]


def _local_group(paths: Sequence[LocalPath], first_index: int, clipped: bool) -> list[str]:
    """One sub-group per run of paths with the same opening, so that painter's order is kept whatever the order."""
    lines = ['<g id="local">']
    for opening, run in groupby(enumerate(paths), key=lambda item: OPENING_OF_PART[PARTS.index(item[1].part)]):
        name = OPENINGS[opening]
        clip = f' clip-path="url(#opening-{name})"' if clipped else ""
        lines += [f'<g class="{name}"{clip}>']
        lines += [_path(path, first_index + i, f' data-part="{path.part}"') for i, path in run]
        lines += ["</g>"]
    return [*lines, "</g>"]


def _path(path: ScenePath, index: int, attributes: str = "") -> str:
    return f'<path{_paint(path.fill, index)}{attributes} d="{path_data(path.points)}"/>'


def _paint(fill: Fill, index: int) -> str:
    if isinstance(fill, LinearFill):
        return f' fill="url(#g{index})"'
    return f' fill="{fill.colour}"{_opacity("fill-opacity", fill.opacity)}'


def _opacity(attribute: str, value: float) -> str:
    return "" if value == 1 else f' {attribute}="{f"{value:.3f}".rstrip("0").rstrip(".")}"'
