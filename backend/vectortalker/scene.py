"""A scene as flat arrays, one set a layer, and its exact translation to and from the wire model."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from vectortalker import schema

Real = TypeVar("Real", bound=np.floating)

PARTS: tuple[schema.Part, ...] = (
    "left_eye",
    "right_eye",
    "left_iris",
    "right_iris",
    "mouth_cavity",
    "mouth_lower",
    "tongue",
    "mouth_upper",
)
NO_PART = -1
OPENINGS = ("left_eye", "right_eye", "mouth")
OPENING_OF_PART = np.array([0, 1, 0, 1, 2, 2, 2, 2])  # index into OPENINGS, by part number

COORDINATE_STEP = 0.01  # portrait px: written coordinates are multiples of it
COLOUR_STEP = 1 / 255
STOPS = 3  # of every fill in arrays, evenly spaced along the axis
OPACITY_STEP = 0.001  # what three written decimals resolve


@dataclass(frozen=True)
class Layer:
    """Paths of one layer in painter's order.

    `points` f32 [n, 3S, 2]: anchor, handle, handle per segment. `stops` f32 [n, 3, 4]: sRGB, opacity in [0, 1] at the
    start, middle and end of the axis; a solid path uses stop 0. `axis` f32 [n, 4]: gradient start x, y, end x, y.
    `gradient` bool [n]. `part` i64 [n]: index into `PARTS`, or `NO_PART` outside the local layer.
    """

    points: NDArray[np.float32]
    stops: NDArray[np.float32]
    axis: NDArray[np.float32]
    gradient: NDArray[np.bool_]
    part: NDArray[np.int64]

    def __len__(self) -> int:
        return len(self.points)

    def __getitem__(self, index: NDArray[np.int64] | NDArray[np.bool_] | slice) -> Layer:
        return Layer(self.points[index], self.stops[index], self.axis[index], self.gradient[index], self.part[index])


@dataclass(frozen=True)
class LayeredScene:
    """Three layers over a canvas colour f32 [3], in the pixels of a frame of `width` × `height`."""

    width: float
    height: float
    canvas: NDArray[np.float32]
    back: Layer
    fore: Layer
    local: Layer

    @property
    def layers(self) -> tuple[Layer, Layer, Layer]:
        return self.back, self.fore, self.local


def empty_layer(segments: int) -> Layer:
    """No paths, of `segments` cubics each."""
    return Layer(
        np.zeros((0, 3 * segments, 2), np.float32),
        np.zeros((0, STOPS, 4), np.float32),
        np.zeros((0, 4), np.float32),
        np.zeros(0, np.bool_),
        np.zeros(0, np.int64),
    )


def order_local(layer: Layer) -> Layer:
    """Local paths grouped by opening, in painter's order within each; openings do not overlap, so the picture stays."""
    return layer[np.argsort(OPENING_OF_PART[layer.part], kind="stable")]


def quantise(layer: Layer) -> Layer:
    """Coordinates and colours as they are written: 0.01 px, 8 bits a colour channel, 0.001 of opacity."""
    points = _round_to(layer.points, COORDINATE_STEP)
    axis = _round_to(layer.axis, COORDINATE_STEP)
    stops = np.clip(layer.stops, 0, 1)
    rounded = np.concatenate([_round_to(stops[..., :3], COLOUR_STEP), _round_to(stops[..., 3:], OPACITY_STEP)], axis=-1)
    return Layer(points, rounded, axis, layer.gradient, layer.part)


def _round_to(values: NDArray[np.float32], step: float) -> NDArray[np.float32]:
    return (np.rint(values.astype(np.float64) / step) * step).astype(np.float32)


# ---------------------------------------------------------------- wire


def to_wire(scene: LayeredScene) -> schema.Scene:
    """Round and translate to `schema.Scene`; local paths come out grouped by opening."""
    local = order_local(scene.local)
    return schema.Scene(
        width=scene.width,
        height=scene.height,
        canvas=_hex(scene.canvas),
        back=[schema.ScenePath(**fields) for fields in _path_fields(scene.back)],
        fore=[schema.ScenePath(**fields) for fields in _path_fields(scene.fore)],
        local=[
            schema.LocalPath(**fields, part=PARTS[part])
            for fields, part in zip(_path_fields(local), local.part, strict=True)
        ],
    )


def from_wire(scene: schema.Scene) -> LayeredScene:
    """Arrays of a wire scene whose paths all have the same number of segments.

    Raises `ValueError` when they differ.
    """
    segments = _common_segments(scene)
    return LayeredScene(
        scene.width,
        scene.height,
        _rgb(scene.canvas),
        _layer(scene.back, segments),
        _layer(scene.fore, segments),
        _layer(scene.local, segments),
    )


def _path_fields(layer: Layer) -> list[dict]:
    written = quantise(layer)
    points = np.round(written.points.astype(np.float64), 2).reshape(len(layer), 2 * layer.points.shape[1]).tolist()
    axes = np.round(written.axis.astype(np.float64), 2).tolist()
    opacity = np.round(written.stops[..., 3].astype(np.float64), 3).tolist()
    return [
        {"points": points[i], "fill": _fill(written.stops[i], opacity[i], axes[i], bool(layer.gradient[i]))}
        for i in range(len(layer))
    ]


def _fill(stops: NDArray[np.float32], opacity: list[float], axis: list[float], gradient: bool) -> schema.Fill:
    if not gradient:
        return schema.SolidFill(colour=_hex(stops[0, :3]), opacity=opacity[0])
    shades = [schema.Stop(colour=_hex(stop[:3]), opacity=opacity[k]) for k, stop in enumerate(stops)]
    return schema.LinearFill(start=(axis[0], axis[1]), end=(axis[2], axis[3]), stops=shades)


def _hex(rgb: NDArray[np.float32]) -> str:
    red, green, blue = np.rint(np.clip(rgb, 0, 1) * 255).astype(int)
    return f"#{red:02x}{green:02x}{blue:02x}"


def _rgb(colour: str) -> NDArray[np.float32]:
    return np.array([int(colour[i : i + 2], 16) for i in (1, 3, 5)], np.float32) / np.float32(255)


def _common_segments(scene: schema.Scene) -> int:
    lengths = {len(path.points) for path in [*scene.back, *scene.fore, *scene.local]}
    if len(lengths) > 1:
        raise ValueError(f"paths have {sorted(n // 6 for n in lengths)} segments; arrays need one number for all")
    return lengths.pop() // 6 if lengths else 8


def _layer(paths: list[schema.ScenePath] | list[schema.LocalPath], segments: int) -> Layer:
    layer = empty_layer(segments)
    if not paths:
        return layer
    return Layer(
        np.array([path.points for path in paths], np.float32).reshape(-1, 3 * segments, 2),
        np.array([_stops(path.fill) for path in paths], np.float32),
        np.array([_axis(path.fill) for path in paths], np.float32),
        np.array([path.fill.kind == "linear" for path in paths]),
        np.array([PARTS.index(p.part) if isinstance(p, schema.LocalPath) else NO_PART for p in paths], np.int64),
    )


def _stops(fill: schema.Fill) -> NDArray[np.float32]:
    stops = [fill] * STOPS if fill.kind == "solid" else fill.stops
    rows = np.array([[*_rgb(stop.colour).tolist(), stop.opacity] for stop in stops], np.float32)
    return with_middle(rows)


def with_middle(stops: NDArray[Real]) -> NDArray[Real]:
    """Stops [..., 3, 4] that paint as the two or three of `stops` do: between two comes their mean."""
    if stops.shape[-2] == STOPS:
        return stops
    return np.insert(stops, 1, stops.mean(axis=-2), axis=-2)


def _axis(fill: schema.Fill) -> tuple[float, float, float, float]:
    return (0.0, 0.0, 1.0, 0.0) if fill.kind == "solid" else (*fill.start, *fill.end)
