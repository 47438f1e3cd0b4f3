"""`schema.VectorizeOptions` with its gaps filled by preset and recipe: everything the optimiser is told."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from vectortalker.schema import Preset, Recipe, VectorizeOptions


@dataclass(frozen=True)
class Settings:
    """Resolved options. `iterations` per level but the last, `final_iterations` in the last; sizes: long side in px."""

    recipe: Recipe
    paths: int
    segments: int
    levels: int
    iterations: int
    final_iterations: int
    seed: int
    working_size: int
    fills: Literal["solid", "gradient"]
    opaque: bool
    layers: bool

    @property
    def total_iterations(self) -> int:
        return (self.levels - 1) * self.iterations + self.final_iterations


@dataclass(frozen=True)
class _Defaults:
    paths: int
    levels: int
    iterations: int
    final_iterations: int
    working_size: int


BEST: dict[Preset, _Defaults] = {
    "draft": _Defaults(paths=250, levels=3, iterations=60, final_iterations=100, working_size=512),
    "standard": _Defaults(paths=500, levels=5, iterations=200, final_iterations=1200, working_size=512),
    "fine": _Defaults(paths=1200, levels=5, iterations=300, final_iterations=2000, working_size=1024),
}
PAPER = _Defaults(paths=500, levels=5, iterations=200, final_iterations=400, working_size=512)  # paper, section 4.1
DIFFVG = _Defaults(paths=500, levels=1, iterations=0, final_iterations=1200, working_size=512)  # as many in all


def resolve(options: VectorizeOptions) -> Settings:
    """Fill what the user left open; the baselines keep their own schedule whatever the preset."""
    defaults = {"best": BEST[options.preset], "paper": PAPER, "diffvg": DIFFVG}[options.recipe]
    return Settings(
        recipe=options.recipe,
        paths=options.paths or defaults.paths,
        segments=options.segments,
        levels=1 if options.recipe == "diffvg" else options.levels or defaults.levels,
        iterations=options.iterations or defaults.iterations,
        final_iterations=options.final_iterations or defaults.final_iterations,
        seed=options.seed,
        working_size=options.working_size or defaults.working_size,
        fills=options.fills or ("gradient" if options.recipe == "best" else "solid"),
        opaque=options.opacity == "opaque",
        layers=options.layers,
    )
