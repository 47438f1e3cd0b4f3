"""Rows become tables of means over portraits, as text for the terminal and as Markdown."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from statistics import fmean

from vectortalker.bench.measure import Row

COLUMNS: tuple[tuple[str, Callable[[Row], float | None], str], ...] = (
    ("paths", lambda row: row.metrics.paths, ".0f"),
    ("segments", lambda row: row.metrics.segments, ".0f"),
    ("MSE", lambda row: row.metrics.mse, ".5f"),
    ("LPIPS (AlexNet)", lambda row: row.lpips, ".3f"),
    ("PSNR", lambda row: row.metrics.psnr, ".2f"),
    ("SSIM", lambda row: row.metrics.ssim, ".4f"),
    ("eyes, mouth PSNR", lambda row: row.eyes_and_mouth_psnr, ".2f"),
    ("iterations", lambda row: row.metrics.iterations, ".0f"),
    ("wall s", lambda row: row.metrics.seconds, ".1f"),
    ("CPU s", lambda row: row.metrics.cpu_seconds, ".1f"),
    ("CPU ms/iteration", lambda row: _per_iteration(row), ".1f"),
    ("kB", lambda row: row.metrics.bytes / 1000, ".0f"),
    ("kB gzip", lambda row: row.metrics.gzip_bytes / 1000, ".0f"),
)
ABSENT = "–"


def means(title: str, rows: Sequence[Row]) -> str:
    """Markdown table: a line per way, in order of appearance, means of the per-image values."""
    ways = list(dict.fromkeys(row.way for row in rows))
    lines = [["way", "portraits", *(name for name, _, _ in COLUMNS)]]
    for way in ways:
        own = [row for row in rows if row.way == way]
        lines.append([way, str(len(own)), *(_mean(own, value, form) for _, value, form in COLUMNS)])
    return f"### {title}\n\n{markdown(lines)}\n"


def side_by_side(title: str, rows: Sequence[Row]) -> str:
    """Markdown table of PSNR: a line per portrait, a column per way."""
    ways = list(dict.fromkeys(row.way for row in rows))
    psnr = {(row.portrait, row.way): f"{row.metrics.psnr:.2f}" for row in rows}
    portraits = list(dict.fromkeys(row.portrait for row in rows))
    lines = [["PSNR", *ways], *([name, *(psnr.get((name, way), ABSENT) for way in ways)] for name in portraits)]
    return f"### {title}\n\n{markdown(lines)}\n"


def _mean(rows: Sequence[Row], value: Callable[[Row], float | None], form: str) -> str:
    values = [found for row in rows if (found := value(row)) is not None]
    return format(fmean(values), form) if values else ABSENT


def _per_iteration(row: Row) -> float | None:
    return 1000 * row.metrics.cpu_seconds / row.metrics.iterations if row.metrics.iterations else None


def markdown(lines: list[list[str]]) -> str:
    """The first line are the headings."""
    widths = [max(len(line[column]) for line in lines) for column in range(len(lines[0]))]
    text = [
        "| " + " | ".join(cell.ljust(width) for cell, width in zip(line, widths, strict=True)) + " |" for line in lines
    ]
    text.insert(1, "|" + "|".join("-" * (width + 2) for width in widths) + "|")
    return "\n".join(text)
