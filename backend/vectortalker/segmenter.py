"""A segmentation net of the user's own in the place of the small ones: one file, or the two of a SAM.

One file: a net of the U²-Net kind (U²-Net, IS-Net, BiRefNet, MODNet, …). Its single input is an RGB picture
[1, 3, H, W] normalised by ImageNet's mean and deviation; the last two axes of its first output are a mask in 0..1, or
its logits.

Two files: encoder and decoder of SAM, MobileSAM and their kin (Kirillov et al. 2023). The encoder takes the picture
with its longer side scaled to 1024: normalised and padded [1, 3, 1024, 1024], or as it is [H, W, 3] in 0..255. The
decoder has the inputs and outputs of Meta's export; landmarks are the points it is asked about.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from vectortalker.errors import VectorTalkerError
from vectortalker.models.own import OwnModel, open_own

Picture = NDArray[np.uint8]  # [H, W, 3]
Mask = NDArray[np.float32]  # [H, W] in 0..1

DEFAULT_SIDE = 512  # of the input of a net that takes any size
MEAN, DEVIATION = (0.485, 0.456, 0.406), (0.229, 0.224, 0.225)  # ImageNet's
SAM_SIDE = 1024
SAM_MEAN, SAM_DEVIATION = (123.675, 116.28, 103.53), (58.395, 57.12, 57.375)
SAM_MASK_INPUT = (1, 1, 256, 256)
SAM_INPUTS, SAM_OUTPUTS = {"image_embeddings", "point_coords", "point_labels"}, {"low_res_masks", "iou_predictions"}
PROMPTED = (8, 21, 22, 30, 33)  # chin, inner ends of the brows, tip and base of the nose
SURE = 0.8  # predicted overlap with the truth from which a mask counts
MOST_LOGIT = 30.0  # where a sigmoid has long been 1


@dataclass(frozen=True)
class Segmenter:
    """`mask_of(rgb, points)`: the person; `points` [68, 2] in the picture's px, or None. `digest` names the files."""

    mask_of: Callable[[Picture, NDArray[np.float64] | None], Mask]
    digest: str


@cache
def open_segmenter(files: tuple[Path, ...]) -> Segmenter:
    """One net, or encoder and decoder. Raises `bad_option` for files not there, no ONNX, or of another kind."""
    models = [open_own(path) for path in files]
    digest = hashlib.sha256("".join(model.digest for model in models).encode()).hexdigest()
    if len(models) == 1:
        net = _Net(models[0])
        return Segmenter(lambda rgb, points: net.mask_of(rgb), digest)
    if len(models) == 2:
        return Segmenter(_Sam(*models).mask_of, digest)
    raise VectorTalkerError("bad_option", f"{len(files)} segmentation models: name one, or encoder and decoder.")


class _Net:
    def __init__(self, model: OwnModel) -> None:
        if len(model.inputs) != 1 or len(model.inputs[0].shape) != 4:
            raise model.refusal("it does not take one picture [1, 3, H, W]")
        model.element_type(model.inputs[0])
        height, width = (side if isinstance(side, int) else DEFAULT_SIDE for side in model.inputs[0].shape[2:])
        self._model, self._size = model, (width, height)

    def mask_of(self, rgb: Picture) -> Mask:
        small = np.asarray(Image.fromarray(rgb).resize(self._size, Image.Resampling.LANCZOS), np.float32) / 255
        pixels = ((small - MEAN) / DEVIATION).transpose(2, 0, 1)[None].astype(np.float32)
        found = self._model.run({self._model.inputs[0].name: pixels})[0]
        if found.ndim < 2 or found.size != found.shape[-1] * found.shape[-2]:
            raise self._model.refusal(f"it gives {list(found.shape)}, not one mask [H, W]")
        mask = found.reshape(found.shape[-2:])
        is_probability = mask.min() >= 0 and mask.max() <= 1
        return _resized(mask if is_probability else _sigmoid(mask), (rgb.shape[1], rgb.shape[0]))


class _Sam:
    def __init__(self, encoder: OwnModel, decoder: OwnModel) -> None:
        picture = encoder.inputs[0]
        if len(picture.shape) not in (3, 4):
            raise encoder.refusal("it takes no picture, as SAM's encoder does")
        self._asked = {node.name for node in decoder.inputs}
        missing = sorted((SAM_INPUTS - self._asked) | (SAM_OUTPUTS - decoder.output_names))
        if missing:
            raise decoder.refusal(f"it has no {missing[0]}, as SAM's decoder has")
        self._encoder, self._decoder, self._picture = encoder, decoder, picture.name
        self._padded, self._type = len(picture.shape) == 4, encoder.element_type(picture)

    def mask_of(self, rgb: Picture, points: NDArray[np.float64] | None) -> Mask:
        """Empty without landmarks: there is nothing to ask about."""
        if points is None:
            return np.zeros(rgb.shape[:2], np.float32)
        scale = SAM_SIDE / max(rgb.shape[:2])
        width, height = (max(1, round(side * scale)) for side in (rgb.shape[1], rgb.shape[0]))
        embeddings = self._encoder.run({self._picture: self._encoder_input(rgb, (width, height))})[0]
        known = {
            "image_embeddings": embeddings,
            "point_coords": np.vstack([points[list(PROMPTED)] * scale, [[0, 0]]])[None].astype(np.float32),
            "point_labels": np.array([[1] * len(PROMPTED) + [-1]], np.float32),  # −1: no box is given
            "mask_input": np.zeros(SAM_MASK_INPUT, np.float32),
            "has_mask_input": np.zeros(1, np.float32),
            "orig_im_size": np.array(rgb.shape[:2], np.float32),
        }
        asked: dict[str, NDArray[np.generic]] = {name: known[name] for name in known if name in self._asked}
        logits, overlaps = self._decoder.run(asked, ["low_res_masks", "iou_predictions"])
        square = _resized(_person(logits[0], overlaps[0]), (SAM_SIDE, SAM_SIDE))
        return _sigmoid(_resized(square[:height, :width], (rgb.shape[1], rgb.shape[0])))

    def _encoder_input(self, rgb: Picture, size: tuple[int, int]) -> NDArray[np.generic]:
        scaled = np.asarray(Image.fromarray(rgb).resize(size, Image.Resampling.BILINEAR))
        if not self._padded:
            return scaled.astype(self._type)
        padded = np.zeros((1, 3, SAM_SIDE, SAM_SIDE), np.float32)
        padded[0, :, : size[1], : size[0]] = ((scaled - SAM_MEAN) / SAM_DEVIATION).transpose(2, 0, 1)
        return padded.astype(self._type)


def _person(logits: NDArray[np.float32], overlaps: NDArray[np.float32]) -> NDArray[np.float32]:
    """Of masks [n, h, w], of a part, a face and a person, the largest that the model is sure of, else the surest."""
    areas = (logits > 0).sum(axis=(1, 2))
    return logits[np.where(overlaps >= SURE, areas + 1, overlaps).argmax()]


def _sigmoid(logits: NDArray[np.float32]) -> Mask:
    return (1 / (1 + np.exp(-np.clip(logits, -MOST_LOGIT, MOST_LOGIT)))).astype(np.float32)


def _resized(mask: NDArray[np.float32], size: tuple[int, int]) -> NDArray[np.float32]:
    return np.asarray(Image.fromarray(mask.astype(np.float32)).resize(size, Image.Resampling.BILINEAR))
