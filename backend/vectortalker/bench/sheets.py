"""Runs become contact sheets: the portrait and every way's picture side by side, one line per portrait."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from vectortalker.bench.measure import Run

CELL = 320  # px
CAPTION = 16


def contact_sheet(lines: Sequence[Sequence[Run]]) -> Image.Image:
    """One line per portrait: canonical image, then its runs, captioned with way and PSNR."""
    columns = 1 + max(len(line) for line in lines)
    sheet = Image.new("RGB", (columns * CELL, len(lines) * (CELL + CAPTION)), "white")
    for row, runs in enumerate(lines):
        cells = [(runs[0].target, runs[0].row.portrait)]
        cells += [(run.picture, f"{run.row.way}: {run.row.metrics.psnr:.2f} dB") for run in runs]
        for column, (picture, caption) in enumerate(cells):
            sheet.paste(_cell(picture, caption), (column * CELL, row * (CELL + CAPTION)))
    return sheet


def _cell(picture: NDArray[np.uint8], caption: str) -> Image.Image:
    cell = Image.new("RGB", (CELL, CELL + CAPTION), "white")
    image = Image.fromarray(picture)
    image.thumbnail((CELL, CELL), Image.Resampling.LANCZOS)
    cell.paste(image, ((CELL - image.width) // 2, CAPTION))
    ImageDraw.Draw(cell).text((3, 2), caption, fill="black")
    return cell
