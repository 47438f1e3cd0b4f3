"""Small whole pictures of every kind that is read."""

from __future__ import annotations

import io

import numpy as np
from PIL import Image

SIDE = 20


def _saved(kind: str, mode: str = "RGB", **options: object) -> bytes:
    y, x = np.mgrid[0:SIDE, 0:SIDE]
    waves = np.stack([128 + 90 * np.sin(x / 3 + k) * np.cos(y / 4 - k) for k in range(3)], axis=-1)
    file = io.BytesIO()
    Image.fromarray(waves.astype(np.uint8)).convert(mode).save(file, kind, **options)
    return file.getvalue()


def _exif() -> Image.Exif:
    exif = Image.Exif()
    exif[0x0112] = 6  # orientation
    return exif


WHOLE = (
    _saved("PNG"),
    _saved("PNG", "RGBA"),
    _saved("PNG", "P"),
    _saved("PNG", "1"),
    _saved("JPEG", exif=_exif()),
    _saved("JPEG", "CMYK", progressive=True),
    _saved("WEBP"),
    _saved("WEBP", "RGBA", lossless=True),
    _saved("BMP"),
    _saved("TIFF", compression="tiff_lzw"),
    _saved("TIFF", compression="tiff_deflate"),
    _saved("GIF", save_all=True, append_images=[Image.new("RGB", (SIDE, SIDE), "red")]),
)
