"""Picture, masks and openings become what each layer is fitted to: pictures completed where other layers hide them.

*back* goes on behind the person, *fore* goes on as skin or lip under the openings and beyond the silhouette, and
*local* goes on as eyeball and mouth interior under the lids and lips. At rest the three make the picture again.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import binary_dilation, distance_transform_edt

from vectortalker.inpaint import fill
from vectortalker.interior import MOUTH, cavity_colour
from vectortalker.irises import SeenIris, light_part, radius_map
from vectortalker.oklab import to_srgb

EDGE_PX = 2.5  # mixed pixels of a soft mask's edge belong to neither side
BACK_MARGIN = 0.06  # of the face height: hair wisps and shadows beside the person are not trusted as scenery
BACK_MARGIN_NO_FACE = 0.02  # of the long side
LASH_MARGIN = 0.18  # of an opening's width: lashes and lip line are not trusted as skin
MOST_UNLIKE = 0.4  # distance in RGB from the colour around an opening at which a pixel is no skin
BALL_GROWTH = 0.35  # of an opening's width: how far the eyeball and the mouth interior go on around it
IRIS_RINGS = 12
IRIS_EDGE = 1.1  # the limbus and its blur end at this radius
MIN_KNOWN_PX = 6


@dataclass(frozen=True)
class LayerTargets:
    """`back`, `fore`, `local` f32 [H, W, 3]; `local_extent` f32 [H, W]: 1 where `local` is completed."""

    back: NDArray[np.float32]
    fore: NDArray[np.float32]
    local: NDArray[np.float32]
    local_extent: NDArray[np.float32]


def targets(
    image: NDArray[np.float32],
    fore: NDArray[np.float32],
    clips: NDArray[np.float32],
    irises: Sequence[SeenIris] = (),
    face_height: float | None = None,
) -> LayerTargets:
    """Targets of f32 [H, W, 3] in 0..1; `fore` [H, W]: the person's mask, `clips` [k, H, W]: coverage of the openings.

    Openings are left eye, right eye, mouth; `irises` belong to the first two. Everything is in the pixels of `image`.
    """
    local, extent = image.copy(), np.zeros(fore.shape, np.float32)
    skin = _inside_silhouette(image, fore)
    for index, clip in enumerate(clips):
        opening = clip > 0.02
        if not opening.any():
            continue
        near = _surroundings(opening)
        skin[near] = _closed_over(skin[near], opening[near], plain=index != MOUTH)
        iris = _shifted(irises[index], near) if index < len(irises) else None
        completed, grown = _completed_interior(image[near], clip[near], iris)
        if index == MOUTH and grown.any():
            completed = _floored(completed, clip[near] > 0.98)
        local[near] = _pasted(local[near], completed, grown)
        extent[near][grown] = 1
    margin = BACK_MARGIN * face_height if face_height else BACK_MARGIN_NO_FACE * max(fore.shape)
    return LayerTargets(_behind(image, fore, margin), skin, local, extent)


def _behind(image: NDArray[np.float32], fore: NDArray[np.float32], margin: float) -> NDArray[np.float32]:
    """Scenery continued under the person. Colours beside the silhouette count little, so that none of it bleeds in."""
    away = _distance_to(fore > 0.02)
    trust = ((away - EDGE_PX) / max(margin, 1.0)).clip(0, 1).astype(np.float32)
    return _pasted(image, fill(image, trust), away <= EDGE_PX) if trust.any() else image


def _inside_silhouette(image: NDArray[np.float32], fore: NDArray[np.float32]) -> NDArray[np.float32]:
    """The person, whose colours are carried on beyond the silhouette."""
    trust = (_distance_to(fore < 0.98) > EDGE_PX).astype(np.float32)
    return _pasted(image, fill(image, trust), fore < 0.5) if trust.any() else image.copy()


def _closed_over(skin: NDArray[np.float32], opening: NDArray[np.bool_], plain: bool) -> NDArray[np.float32]:
    """Skin or lip in place of an opening, from beyond the lashes; `plain`: not the colours of hair, brow, glasses."""
    lash = max(LASH_MARGIN * _width(opening), 1.0)
    away = (_distance_to(opening) - EDGE_PX) / lash
    trust = away.clip(0, 1) ** 2
    around = (away > 1) & (away < 2)
    if plain and around.any():
        unlike = np.linalg.norm(skin - np.median(skin[around], axis=0), axis=2)
        trust *= (1 - unlike / MOST_UNLIKE).clip(0, 1)
    return _pasted(skin, fill(skin, trust.astype(np.float32)), np.asarray(binary_dilation(opening), bool))


def _completed_interior(
    image: NDArray[np.float32], clip: NDArray[np.float32], iris: SeenIris | None
) -> tuple[NDArray[np.float32], NDArray[np.bool_]]:
    """Eyeball or mouth interior carried on around its opening, and the region that holds it; empty for a closed one."""
    core = clip > 0.98
    if core.sum() < MIN_KNOWN_PX:
        return image, np.zeros(clip.shape, bool)
    grown = _distance_to(clip > 0.5) <= BALL_GROWTH * _width(core)
    if iris is None:
        return fill(image, core.astype(np.float32)), grown
    radius = radius_map(iris, clip.shape)
    sclera = light_part(image, core) & (radius > IRIS_EDGE)
    ball = fill(image, (sclera if sclera.sum() >= MIN_KNOWN_PX else core).astype(np.float32))
    disc = _whole_iris(image, core, radius)
    edge = ((IRIS_EDGE - radius) * min(iris.radii) / EDGE_PX).clip(0, 1)[..., None].astype(np.float32)
    completed = (ball + edge * (disc - ball)).astype(np.float32)
    return _pasted(completed, image, core), grown


def _floored(interior: NDArray[np.float32], core: NDArray[np.bool_]) -> NDArray[np.float32]:
    """The mouth with a dark cavity below its opening: what a smile shows must not go on under the lower lip."""
    rgb = np.rint(interior * 255).astype(np.uint8)
    dark = to_srgb(cavity_colour(rgb, core)).astype(np.float32)
    columns = np.flatnonzero(core.any(axis=0))
    lowest = len(core) - np.argmax(core[::-1], axis=0)
    nearest = columns[np.abs(np.arange(core.shape[1])[:, None] - columns).argmin(axis=1)]
    below = np.arange(len(core))[:, None] >= lowest[nearest]
    return np.where(below[..., None], dark, interior)


def _whole_iris(
    image: NDArray[np.float32], known: NDArray[np.bool_], radius: NDArray[np.float64]
) -> NDArray[np.float32]:
    """The disc by its rings: each hidden pixel takes the mean colour of what shows at its distance from the centre."""
    ring = np.minimum((radius / IRIS_EDGE * IRIS_RINGS).astype(int), IRIS_RINGS)
    seen = ring[known]
    counts = np.bincount(seen, minlength=IRIS_RINGS + 1)[:IRIS_RINGS]
    present = np.flatnonzero(counts)
    if not present.size:
        return image
    profile = np.empty((IRIS_RINGS + 1, 3), np.float32)
    for channel in range(3):
        sums = np.bincount(seen, image[known][:, channel], minlength=IRIS_RINGS + 1)[:IRIS_RINGS]
        profile[:, channel] = np.interp(np.arange(IRIS_RINGS + 1), present, sums[present] / counts[present])
    return profile[ring]


def _surroundings(opening: NDArray[np.bool_]) -> tuple[slice, slice]:
    """Rows and columns of the opening and once its width around it: all that its completion looks at."""
    rows, columns = np.flatnonzero(opening.any(axis=1)), np.flatnonzero(opening.any(axis=0))
    margin = int(columns[-1] - columns[0]) + 1 + ceil(EDGE_PX)
    top, left = max(0, int(rows[0]) - margin), max(0, int(columns[0]) - margin)
    return slice(top, int(rows[-1]) + margin + 1), slice(left, int(columns[-1]) + margin + 1)


def _shifted(iris: SeenIris, near: tuple[slice, slice]) -> SeenIris:
    return SeenIris((iris.centre[0] - near[1].start, iris.centre[1] - near[0].start), iris.radii)


def _distance_to(region: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Pixels to the nearest pixel of the region; infinite if it is empty."""
    if not region.any():
        return np.full(region.shape, np.inf)
    return np.asarray(distance_transform_edt(~region))


def _width(region: NDArray[np.bool_]) -> int:
    columns = np.flatnonzero(region.any(axis=0))
    return int(columns[-1] - columns[0] + 1)


def _pasted(under: NDArray[np.float32], over: NDArray[np.float32], where: NDArray[np.bool_]) -> NDArray[np.float32]:
    return np.where(where[..., None], over, under)
