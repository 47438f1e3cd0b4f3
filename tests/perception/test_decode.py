"""Closed forms on pictures made here; every hard file gives a portrait or one clear message."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from vectortalker.decode import Limits, canonical, decode
from vectortalker.errors import VectorTalkerError

REFUSED = {
    "bad-crc.png",
    "bomb-20000x20000-1bit.png",
    "empty.png",
    "huge-header.png",
    "one-pixel.png",
    "text-named.png",
    "truncated-60pct.png",
    "truncated-half.jpg",
    "vector-input.svg",
}


def encoded(image: Image.Image, format_: str, **options: object) -> bytes:
    buffer = io.BytesIO()
    image.save(buffer, format_, **options)
    return buffer.getvalue()


def flat(colour: tuple[int, ...] | int, mode: str = "RGB", size: tuple[int, int] = (40, 20)) -> Image.Image:
    return Image.new(mode, size, colour)


@pytest.mark.parametrize("format_", ["PNG", "BMP", "TIFF", "GIF", "WEBP", "JPEG"])
def test_format_keeps_its_colour(format_: str) -> None:
    portrait = decode(encoded(flat((200, 100, 48)), format_), "flat")
    assert np.abs(portrait.rgb.astype(int) - (200, 100, 48)).max() <= 3


def test_transparent_pixels_become_white_whatever_colour_they_hide() -> None:
    portrait = decode(encoded(flat((255, 0, 255, 0), "RGBA"), "PNG"), "magenta")
    assert (portrait.rgb == 255).all()
    assert portrait.alpha is not None and not portrait.alpha.any()


def test_half_transparent_black_over_white_is_half_grey() -> None:
    portrait = decode(encoded(flat((0, 0, 0, 128), "RGBA"), "PNG"), "veil")
    assert (portrait.rgb == 127).all()  # 255 · (1 − 128/255)


def test_sixteen_bit_grey_is_scaled_not_clipped() -> None:
    grey = Image.fromarray(np.full((20, 40), 257 * 100, np.uint16))
    assert (decode(encoded(grey, "PNG"), "grey").rgb == 100).all()


def test_cmyk_black_ink_darkens() -> None:
    portrait = decode(encoded(flat((0, 0, 0, 255), "CMYK"), "JPEG"), "ink")
    assert portrait.rgb.max() < 8
    assert portrait.notices == ("CMYK converted to RGB.",)


def test_exif_orientation_turns_the_picture_upright() -> None:
    exif = Image.Exif()
    exif[0x0112] = 6
    portrait = decode(encoded(flat((9, 9, 9)), "JPEG", exif=exif), "turned")
    assert (portrait.width, portrait.height) == (20, 40)


def test_animation_uses_its_first_frame_and_says_so() -> None:
    frames = [flat((10, 0, 0)), flat((200, 0, 0))]
    portrait = decode(encoded(frames[0], "GIF", save_all=True, append_images=frames[1:]), "film")
    assert portrait.rgb[0, 0, 0] == 10
    assert portrait.notices == ("First of 2 frames used.",)


def test_long_side_is_scaled_to_the_limit_with_a_notice() -> None:
    portrait = decode(
        encoded(flat((1, 2, 3), size=(100, 40)), "PNG"),
        "wide",
        Limits(max_long_side=50),
    )
    assert (portrait.width, portrait.height) == (50, 20)
    assert portrait.notices == ("Scaled from 100×40 to 50×20 (limit 50 px).",)


@pytest.mark.parametrize(
    ("limits", "code"),
    [
        (Limits(max_bytes=10), "picture_too_large"),
        (Limits(max_pixels=799), "picture_too_large"),
        (Limits(min_side=21), "bad_picture"),
        (Limits(max_aspect=1.9), "bad_picture"),
    ],
)
def test_limit_is_refused_with_its_code(limits: Limits, code: str) -> None:
    with pytest.raises(VectorTalkerError) as refused:
        decode(encoded(flat((1, 2, 3)), "PNG"), "flat", limits)
    assert refused.value.code == code


@pytest.mark.parametrize("kept", [0, 1, 30, 60])
def test_cut_file_is_refused(kept: int) -> None:
    noise = Image.fromarray(np.random.default_rng(0).integers(0, 255, (64, 64, 3), np.uint8))
    with pytest.raises(VectorTalkerError) as refused:
        decode(encoded(noise, "PNG")[: kept * 100], "cut.png")
    assert refused.value.code == "bad_picture"


def test_canonical_scales_up_and_down_to_the_side() -> None:
    portrait = decode(encoded(flat((5, 6, 7), size=(100, 40)), "PNG"), "wide")
    assert canonical(portrait, 50).shape == (20, 50, 3)
    assert canonical(portrait, 200).shape == (80, 200, 3)


def test_hard_files_give_a_portrait_or_one_message(shared_data: Path) -> None:
    refused = set()
    for file in sorted((shared_data / "hard").iterdir()):
        try:
            decode(file.read_bytes(), file.name)
        except VectorTalkerError as error:
            refused.add(file.name)
            assert file.name in error.message and "\n" not in error.message
    assert refused == REFUSED


def test_animation_cut_at_a_frame_is_refused() -> None:
    file = io.BytesIO()
    frames = [Image.new("RGB", (20, 20), colour) for colour in ("red", "blue")]
    frames[0].save(file, "GIF", save_all=True, append_images=frames[1:])
    cut = file.getvalue()[: file.getvalue().rindex(b"!\xf9") + 1]
    with pytest.raises(VectorTalkerError, match="damaged"):
        decode(cut, "cut.gif")


def test_name_that_is_no_text_is_shown_without_its_bytes() -> None:
    """As Python reads a file name with bytes that are no UTF-8."""
    file = io.BytesIO()
    Image.new("RGB", (20, 20)).save(file, "PNG")
    assert decode(file.getvalue(), "a\udcff\nb.png").name == "ab.png"
    assert decode(file.getvalue(), "\udcff").name == "portrait"
