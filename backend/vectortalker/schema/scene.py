"""A layered portrait: paths and their fills in painter's order."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import AfterValidator, Field

from vectortalker.schema.wire import Coordinate, HexColour, Side, Unit, Wire, Xy

NUMBERS_PER_SEGMENT = 6  # anchor, handle, handle
MOST_STOPS = 3
Part = Literal[
    "left_eye", "right_eye", "left_iris", "right_iris", "mouth_cavity", "mouth_lower", "tongue", "mouth_upper"
]


class SolidFill(Wire):
    kind: Literal["solid"] = "solid"
    colour: HexColour
    opacity: Unit = 1.0


class Stop(Wire):
    colour: HexColour
    opacity: Unit = 1.0


class LinearFill(Wire):
    """Linear gradient from `start` to `end`, its stops evenly spaced: padded, unpremultiplied sRGB."""

    kind: Literal["linear"] = "linear"
    start: Xy
    end: Xy
    stops: Annotated[list[Stop], Field(min_length=2, max_length=MOST_STOPS)]


Fill = Annotated[SolidFill | LinearFill, Field(discriminator="kind")]


def _whole_segments(points: list[float]) -> list[float]:
    if len(points) % NUMBERS_PER_SEGMENT:
        raise ValueError(f"{len(points)} numbers are no whole number of segments of {NUMBERS_PER_SEGMENT}")
    return points


class ScenePath(Wire):
    """Closed chain of cubics: flat x, y of `anchor, handle, handle` a segment; the last ends at the first anchor."""

    points: Annotated[list[Coordinate], Field(min_length=12), AfterValidator(_whole_segments)]
    fill: Fill


class LocalPath(ScenePath):
    part: Part


class Scene(Wire):
    """Layered portrait in painter's order. `canvas` fills the whole frame beneath `back`."""

    width: Side
    height: Side
    canvas: HexColour
    back: list[ScenePath]
    fore: list[ScenePath]
    local: list[LocalPath]
