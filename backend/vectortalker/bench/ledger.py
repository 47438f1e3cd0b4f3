"""Runs become files of a folder, and files runs again: a benchmark that was interrupted goes on where it stopped."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path

import numpy as np
from PIL import Image

from vectortalker.bench.measure import Row, Run
from vectortalker.schema import Metrics


def keep(folder: Path, run: Run) -> None:
    """Write a run's row, SVG and pictures; the row comes last, so that what has one is whole."""
    place = _place(folder, run.row.portrait, run.row.way)
    place.parent.mkdir(parents=True, exist_ok=True)
    place.with_suffix(".svg").write_text(run.svg, encoding="utf-8")
    Image.fromarray(run.picture).save(place.with_suffix(".png"))
    Image.fromarray(run.target).save(place.with_name("target.png"))
    row = {**asdict(run.row), "metrics": run.row.metrics.model_dump()}
    place.with_suffix(".json").write_text(json.dumps(row, indent=1), encoding="utf-8")


def kept(folder: Path, portrait: str, way: str) -> Run | None:
    """The run of an earlier call, None if there is none."""
    place = _place(folder, portrait, way)
    if not place.with_suffix(".json").is_file():
        return None
    row = json.loads(place.with_suffix(".json").read_text(encoding="utf-8"))
    row["metrics"] = Metrics.model_validate(row["metrics"])
    picture, target = (_pixels(path) for path in (place.with_suffix(".png"), place.with_name("target.png")))
    return Run(Row(**row), picture, target, place.with_suffix(".svg").read_text(encoding="utf-8"))


def _place(folder: Path, portrait: str, way: str) -> Path:
    """One folder per portrait; names of ways without what file systems refuse."""
    return folder / Path(portrait).stem / way.replace(", ", "-").replace(" ", "-")


def _pixels(path: Path) -> np.ndarray:
    return np.asarray(Image.open(path).convert("RGB"))
