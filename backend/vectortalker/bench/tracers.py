"""A picture becomes the SVG of a tracer that people use instead, at settings of its own.

vtracer runs at its defaults for photographs and near our number of paths. potrace knows black and white only: a picture
becomes a stack of k-means colours, dark to light, each traced where it or a lighter one lies, so that no gaps open.
"""

from __future__ import annotations

import io
import re
import shutil
import subprocess
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

import numpy as np
import vtracer
from numpy.typing import NDArray
from PIL import Image
from scipy.cluster.vq import kmeans2

Picture = NDArray[np.uint8]  # [H, W, 3]
POTRACE = "potrace"
K_MEANS_SAMPLE = 20_000  # pixels that the palette is made from
DRAWN = re.compile(r"([cl])([^a-zA-Z]*)")
NUMBER = re.compile(r"-?[\d.]+")
NUMBERS_OF = {"c": 6, "l": 2}


def available() -> tuple[str, ...]:
    """Names of `TRACERS` that can run here."""
    return tuple(name for name in TRACERS if not name.startswith(POTRACE) or shutil.which(POTRACE))


def n_segments(svg: str) -> int:
    """Curves and lines of a tracer's SVG, whose commands may carry several each."""
    drawn = (DRAWN.findall(data.lower()) for data in re.findall(r' d="(.*?)"', svg, re.DOTALL))
    return sum(max(1, len(NUMBER.findall(numbers)) // NUMBERS_OF[kind]) for path in drawn for kind, numbers in path)


def _vtracer(picture: Picture, **settings: Any) -> str:  # whatever its own arguments are
    png = io.BytesIO()
    Image.fromarray(picture).save(png, "PNG")
    return vtracer.convert_raw_image_to_svg(png.getvalue(), img_format="png", **settings)


def _potrace(picture: Picture, colours: int, speckle: int) -> str:
    """`colours` levels of which spots of up to `speckle` px are dropped; the program's defaults otherwise."""
    height, width, _ = picture.shape
    pixels = picture.reshape(-1, 3).astype(np.float64)
    sample = pixels[:: max(1, len(pixels) // K_MEANS_SAMPLE)]
    distinct = len(np.unique(sample, axis=0))
    palette, _ = kmeans2(sample, min(colours, distinct), minit="++", rng=0)
    palette = palette[np.argsort(palette.sum(axis=1), kind="stable")]
    level = np.argmin(((pixels[:, None] - palette) ** 2).sum(axis=2), axis=1).reshape(height, width)
    inks = ["#" + bytes(np.rint(colour).astype(np.uint8)).hex() for colour in palette]
    sheets = [_traced(level >= index, ink, speckle) for index, ink in enumerate(inks)]
    return f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}">{"".join(sheets)}</svg>'


def _traced(mask: NDArray[np.bool_], ink: str, speckle: int) -> str:
    """Group of one colour's paths."""
    height, width = mask.shape
    bitmap = b"P4 %d %d\n" % (width, height) + np.packbits(mask, axis=1).tobytes()
    command = [POTRACE, "--backend", "svg", "--turdsize", str(speckle), "--color", ink, "--output", "-", "-"]
    svg = subprocess.run(command, input=bitmap, capture_output=True, check=True).stdout.decode()
    return svg[svg.index("<g ") : svg.index("</svg>")]


TRACERS: Mapping[str, Callable[[Picture], str]] = {
    "vtracer": _vtracer,
    "vtracer, few paths": partial(_vtracer, filter_speckle=12, color_precision=5, layer_difference=32),
    "potrace, 24 colours": partial(_potrace, colours=24, speckle=2),
    "potrace, few paths": partial(_potrace, colours=16, speckle=20),
}
