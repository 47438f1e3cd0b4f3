"""Faces and their landmarks."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field, FiniteFloat

from vectortalker.schema.wire import Offset, Side, Unit, Wire, Xy

N_LANDMARKS = 68  # iBUG order


class Iris(Wire):
    centre: Xy
    radius: Side


class Landmarks(Wire):
    """68 iBUG points; irises image-left first; `depth` towards the viewer in units of the outer-eye distance."""

    points: Annotated[list[Xy], Field(min_length=N_LANDMARKS, max_length=N_LANDMARKS)]
    irises: tuple[Iris, Iris] | None = None
    depth: Annotated[list[Offset], Field(min_length=N_LANDMARKS, max_length=N_LANDMARKS)] | None = None


class Box(Wire):
    x: FiniteFloat
    y: FiniteFloat
    width: FiniteFloat
    height: FiniteFloat


class Face(Wire):
    box: Box
    landmarks: Landmarks
    confidence: Unit
    fit_advised: bool  # the fit is doubtful: ask the user to check it or to place the five pins


class Faces(Wire):
    """Detected faces, largest first. Empty: no face was found, the user fits five pins."""

    width: int
    height: int
    faces: list[Face]
