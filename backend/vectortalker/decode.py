"""Bytes of a picture become a `Portrait`: upright 8-bit sRGB over white, within stated limits."""

from __future__ import annotations

import io
import re
import struct
import warnings
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageOps, UnidentifiedImageError

from vectortalker.errors import VectorTalkerError

FORMATS = ("PNG", "JPEG", "WEBP", "BMP", "TIFF", "GIF")
SVG_PROBE_BYTES = 1024
UNREADABLE = (  # what Pillow's readers raise on damaged files
    OSError,
    SyntaxError,
    ValueError,
    EOFError,
    struct.error,
    zlib.error,
    ArithmeticError,
    LookupError,
    TypeError,
    AttributeError,
)


@dataclass(frozen=True)
class Limits:
    """What is refused (bytes, pixels, sides, aspect) and what is scaled down (long side)."""

    max_bytes: int = 25_000_000
    max_pixels: int = 50_000_000  # 50 MP decode in under 1 GB of memory
    min_side: int = 16  # a smaller picture holds no face and no SSIM window
    max_aspect: float = 40.0  # keeps the short side of a 512 px working image above 12 px
    max_long_side: int = 4096


@dataclass(frozen=True)
class Portrait:
    """`rgb` uint8 [H, W, 3] over white; `alpha` uint8 [H, W] if anything is transparent; `notices`: what changed."""

    rgb: NDArray[np.uint8]
    alpha: NDArray[np.uint8] | None
    name: str
    notices: tuple[str, ...]

    @property
    def width(self) -> int:
        return self.rgb.shape[1]

    @property
    def height(self) -> int:
        return self.rgb.shape[0]


def decode(data: bytes, name: str, limits: Limits | None = None) -> Portrait:
    """Read a PNG, JPEG, WebP, BMP, TIFF or GIF by its content, whatever its name.

    Raises `VectorTalkerError`: `picture_too_large` before any pixel is decoded, `bad_picture` for all that is not a
    whole picture.
    """
    limits, name = limits or Limits(), shown_name(name)
    if len(data) > limits.max_bytes:
        raise VectorTalkerError(
            "picture_too_large",
            f"{name} has {len(data) / 1e6:.1f} MB; the limit is {limits.max_bytes / 1e6:.0f} MB: save it smaller.",
        )
    with _quietly(), _open(data, name, limits) as image:
        _check_size(image.size, name, limits)
        notices = _frame_notice(image, name)
        try:
            image.load()
            upright = ImageOps.exif_transpose(image)
            normal, mode_notices = _to_eight_bits(upright, name)
        except UNREADABLE as error:
            raise VectorTalkerError(
                "bad_picture", f"{name} is damaged or incomplete ({error}): save or download it again."
            ) from error
    fitted, scale_notices = _fit_long_side(normal, limits.max_long_side)
    rgb, alpha = _over_white(fitted)
    alpha_notices = () if alpha is None else ("Transparent parts are shown over white.",)
    return Portrait(rgb, alpha, name, (*notices, *mode_notices, *alpha_notices, *scale_notices))


def shown_name(filename: str) -> str:
    """What of a file's name can be printed: names may hold line breaks, or bytes that are no text at all."""
    return "".join(character for character in filename if character.isprintable()) or "portrait"


def canonical(portrait: Portrait, side: int) -> NDArray[np.uint8]:
    """The image that metrics compare with, uint8 [h, w, 3]: longer side scaled to `side` by LANCZOS, up or down."""
    scale = side / max(portrait.width, portrait.height)
    size = (max(1, round(portrait.width * scale)), max(1, round(portrait.height * scale)))
    return np.asarray(Image.fromarray(portrait.rgb).resize(size, Image.Resampling.LANCZOS))


@contextmanager
def _quietly() -> Iterator[None]:
    """Pillow warns of odd metadata on stderr, where it helps nobody."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        yield


def _open(data: bytes, name: str, limits: Limits) -> Image.Image:
    """Parse the header only; Pillow's own bomb check comes before ours and is translated."""
    if not data:
        raise VectorTalkerError("bad_picture", f"{name} is empty (0 bytes): choose another file.")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error", Image.DecompressionBombWarning)
            return Image.open(io.BytesIO(data), formats=FORMATS)
    except (Image.DecompressionBombError, Image.DecompressionBombWarning) as error:
        found = re.search(r"\d+", str(error))
        raise _too_many_pixels(name, int(found.group()) if found else limits.max_pixels + 1, limits) from error
    except UnidentifiedImageError as error:
        if b"<svg" in data[:SVG_PROBE_BYTES].lower():
            message = f"{name} is an SVG drawing, already made of paths: give a PNG or JPEG of it."
        else:
            message = f"{name} is not a picture that can be read: give a PNG, JPEG, WebP, BMP, TIFF or GIF."
        raise VectorTalkerError("bad_picture", message) from error
    except UNREADABLE as error:
        raise VectorTalkerError("bad_picture", f"{name} has a damaged header ({error}): save it again.") from error


def _check_size(size: tuple[int, int], name: str, limits: Limits) -> None:
    width, height = size
    if width * height > limits.max_pixels:
        raise _too_many_pixels(name, width * height, limits)
    if min(size) < limits.min_side:
        raise VectorTalkerError(
            "bad_picture",
            f"{name} is {width}×{height}; the smallest side is {limits.min_side} px: give a larger picture.",
        )
    if max(size) > limits.max_aspect * min(size):
        raise VectorTalkerError(
            "bad_picture",
            f"{name} is {width}×{height}; one side may be {limits.max_aspect:.0f} times the other at most: crop it.",
        )


def _too_many_pixels(name: str, pixels: int, limits: Limits) -> VectorTalkerError:
    return VectorTalkerError(
        "picture_too_large",
        f"{name} has {pixels / 1e6:.0f} megapixels; the limit is {limits.max_pixels / 1e6:.0f}: scale it down first.",
    )


def _frame_notice(image: Image.Image, name: str) -> tuple[str, ...]:
    """Multi-picture JPEGs hold previews and depth maps, not frames, and need no notice."""
    try:
        n_frames = getattr(image, "n_frames", 1) if image.format in ("GIF", "WEBP", "PNG", "TIFF") else 1
        image.seek(0)
    except UNREADABLE as error:
        raise VectorTalkerError("bad_picture", f"{name} has damaged frames ({error}): save it again.") from error
    return (f"First of {n_frames} frames used.",) if n_frames > 1 else ()


def _to_eight_bits(image: Image.Image, name: str) -> tuple[Image.Image, tuple[str, ...]]:
    """Any mode of 8 or 16 bits to RGB, or to RGBA if it can be transparent. Pillow would clip `I;16` to white."""
    if image.mode.startswith("I;16"):
        eight_bits = np.rint(np.asarray(image).astype(np.float32) / 257).astype(np.uint8)
        return Image.fromarray(eight_bits).convert("RGB"), ("16 bits a channel reduced to 8.",)
    if image.mode in ("I", "F"):
        raise VectorTalkerError("bad_picture", f"{name} has 32 bits a channel; 8 and 16 are read: save it with 8.")
    notices = ("CMYK converted to RGB.",) if image.mode == "CMYK" else ()
    return image.convert("RGBA" if image.has_transparency_data else "RGB"), notices


def _fit_long_side(image: Image.Image, max_long_side: int) -> tuple[Image.Image, tuple[str, ...]]:
    """Pillow resizes RGBA premultiplied, so colours hidden under zero alpha do not bleed."""
    long_side = max(image.size)
    if long_side <= max_long_side:
        return image, ()
    scale = max_long_side / long_side
    size = (round(image.width * scale), round(image.height * scale))
    notice = f"Scaled from {image.width}×{image.height} to {size[0]}×{size[1]} (limit {max_long_side} px)."
    return image.resize(size, Image.Resampling.LANCZOS), (notice,)


def _over_white(image: Image.Image) -> tuple[NDArray[np.uint8], NDArray[np.uint8] | None]:
    if image.mode == "RGB":
        return np.asarray(image), None
    alpha = np.asarray(image.getchannel("A"))
    white = Image.new("RGBA", image.size, "white")
    white.alpha_composite(image)
    return np.asarray(white.convert("RGB")), None if alpha.min() == 255 else alpha
