"""What `vectorize` reports on its way, what it hands over at the end, and what it needs to resume."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from numpy.typing import NDArray

from vectortalker import schema


@dataclass(frozen=True)
class Checkpoint:
    """State after a whole level: plain arrays, so that a store can keep it without knowing what it is.

    `arrays` holds the paths of the level's frame by name; `level` counts finished levels;
    `iterations` those spent; `settings` identifies what it was made with (a resumed run must agree).
    """

    level: int
    iterations: int
    settings: str
    arrays: dict[str, NDArray[Any]]


@dataclass(frozen=True)
class Progress:
    """One report. `stage` is ready to be shown; `fraction` of the whole in [0, 1].

    `compose` comes with a new picture, `checkpoint` with the last report of every level.
    """

    stage: str
    level: int
    levels: int
    n_paths: int
    fraction: float
    compose: Callable[[], schema.Scene] | None = None
    checkpoint: Checkpoint | None = None

    @cached_property
    def scene(self) -> schema.Scene | None:
        """The new picture, made when it is first asked for: a command shows none but the last."""
        return self.compose() if self.compose else None


@dataclass(frozen=True)
class Result:
    """The finished scene and its SVG text; `measure` scores that text's resvg rendering, which takes about a second."""

    scene: schema.Scene
    svg: str
    measure: Callable[[], schema.Metrics]

    @cached_property
    def metrics(self) -> schema.Metrics:
        """Scores, measured when they are first asked for: a draft should not wait for what nobody reads."""
        return self.measure()
