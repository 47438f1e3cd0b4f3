"""What all wire models share: their base, and numbers within limits."""

from __future__ import annotations

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field, FiniteFloat

SCHEMA_VERSION = 1

Unit = Annotated[FiniteFloat, Field(ge=0, le=1)]
Coordinate = Annotated[FiniteFloat, Field(ge=-1e6, le=1e6)]  # far beyond any portrait, and no product overflows
Xy = tuple[Coordinate, Coordinate]
Side = Annotated[FiniteFloat, Field(gt=0, le=65536)]
Offset = Annotated[FiniteFloat, Field(ge=-100, le=100)]  # units of the outer-eye distance
OffsetXy = tuple[Offset, Offset]
HexColour = Annotated[str, Field(pattern=r"^#[0-9a-f]{6}$")]


class Wire(BaseModel):
    """Base of all wire models: immutable, unknown fields refused."""

    model_config = ConfigDict(frozen=True, extra="forbid")
