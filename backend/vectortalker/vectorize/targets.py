"""A portrait becomes what every level fits: the smoothed stack, and the layers with what they hide from each other."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import vectortalker_core as core
from numpy.typing import NDArray
from PIL import Image
from scipy.ndimage import grey_dilation

from vectortalker import smooth
from vectortalker.decode import Portrait
from vectortalker.landmarks.ibug import IrisDisc
from vectortalker.masks import segment
from vectortalker.scene import Layer, empty_layer
from vectortalker.schema import Landmarks
from vectortalker.segmenter import Segmenter
from vectortalker.vectorize.covers import covers, with_lids
from vectortalker.vectorize.frame import Frame, to_frame
from vectortalker.vectorize.interior_starts import first_paths
from vectortalker.vectorize.layering import LayerImages, layer_images, layered_level
from vectortalker.vectorize.level import BACK, FORE, Level, single_sheet_level
from vectortalker.vectorize.options import Settings
from vectortalker.vectorize.population import Population, empty_population
from vectortalker.vectorize.resize import resize
from vectortalker.vectorize.schedule import RECIPES, LevelPlan

FRINGE = 0.01  # of the longer side: width of soft hair and blended edges outside a mask


@dataclass(frozen=True)
class Targets:
    """`stack`: f32 [h, w, 3], coarse to fine; `canvas` f32 [3]; `openings`: outlines [3S, 2] in portrait px.

    `layers` is None where everything belongs to one `group`: without a person, or when the user wants one layer.
    `first_paths`: what eyes and mouth hide at rest, and lids, in the coarsest level's px. `floor`: what is added to the
    local layer after the fit.
    """

    stack: tuple[NDArray[np.float32], ...]
    canvas: NDArray[np.float32]
    openings: tuple[NDArray[np.float64], ...]
    layers: LayerImages | None
    group: int
    frame: Frame
    first_paths: Population
    floor: Layer

    def level(self, index: int, level_plan: LevelPlan) -> Level:
        """Targets of level `index` at its resolution."""
        smoothed = resize(self.stack[index], level_plan.frame)
        if self.layers is None:
            return single_sheet_level(smoothed, self.group, self.canvas)
        stretch = np.array(level_plan.frame) / (self.frame.width, self.frame.height)
        openings = tuple(to_frame(outline, self.frame) * stretch for outline in self.openings)
        return layered_level(self.layers, smoothed, openings, self.canvas)


def prepare(
    portrait: Portrait,
    landmarks: Landmarks | None,
    picture: NDArray[np.uint8],
    frame: Frame,
    settings: Settings,
    plans: list[LevelPlan],
    segmenter: Segmenter | None,
) -> Targets:
    """Segment, and smooth for a recipe that wants it; the canvas has the mean colour of `picture`.

    `picture` u8 [H, W, 3] is the portrait at the working size. Without layers everything is fore if there is a person,
    so that it can be posed, and back if there is none.
    """
    image = picture.astype(np.float32) / np.float32(255)
    canvas = np.rint(picture.reshape(-1, 3).mean(axis=0)).astype(np.float32) / np.float32(255)
    smoothed = RECIPES[settings.recipe].smooth
    stack = tuple(level.image for level in smooth.stack(image, len(plans))) if smoothed else (image,) * len(plans)
    points = None if landmarks is None else np.array(landmarks.points, np.float64)
    placed = None if points is None else to_frame(points, frame)
    masks = segment(picture, placed, _scaled_alpha(portrait, frame), segmenter)
    nothing, bare = empty_population(settings.segments), empty_layer(settings.segments)
    if not settings.layers or not masks.has_person:
        return Targets(stack, canvas, (), None, FORE if masks.has_person else BACK, frame, nothing, bare)
    outlines = () if points is None else tuple(outline for _, outline, _ in core.opening_outlines(points))
    placed_outlines = tuple(to_frame(outline, frame) for outline in outlines)
    layers = layer_images(image, _with_fringe(masks.fore), placed, _iris_discs(landmarks, frame), placed_outlines)
    if points is None or landmarks is None:
        return Targets(stack, canvas, outlines, layers, FORE, frame, nothing, bare)
    hidden = first_paths(portrait, points, frame, plans[0].frame, settings.paths, settings.segments)
    tops = covers(landmarks, portrait.rgb, settings.paths, settings.segments)
    first = with_lids(hidden, tops.fore, frame, plans[0].frame)
    return Targets(stack, canvas, outlines, layers, FORE, frame, first, tops.local)


def _scaled_alpha(portrait: Portrait, frame: Frame) -> NDArray[np.uint8] | None:
    if portrait.alpha is None:
        return None
    size = (frame.width, frame.height)
    return np.asarray(Image.fromarray(portrait.alpha).resize(size, Image.Resampling.LANCZOS))


def _iris_discs(landmarks: Landmarks | None, frame: Frame) -> tuple[IrisDisc, ...]:
    """Irises in working px, image-left first."""
    if landmarks is None or landmarks.irises is None:
        return ()
    centres = [to_frame(np.array(iris.centre), frame) for iris in landmarks.irises]
    return tuple(
        IrisDisc((float(x), float(y)), iris.radius * frame.scale)
        for (x, y), iris in zip(centres, landmarks.irises, strict=True)
    )


def _with_fringe(mask: NDArray[np.float32]) -> NDArray[np.float32]:
    """Grow the person's mask [H, W] over the fringe of hair and blended edge pixels around it.

    Left to the back layer, the fringe stays behind as a ghost of the outline when the head moves.
    """
    radius = max(1, round(FRINGE * max(mask.shape)))
    y, x = np.mgrid[-radius : radius + 1, -radius : radius + 1]
    return np.asarray(grey_dilation(mask, footprint=np.hypot(x, y) <= radius + 0.5), np.float32)
