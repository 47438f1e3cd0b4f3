"""Whatever Python passes, the core answers with numbers or with a `ValueError` that names value and limit."""

from typing import Any

import numpy as np
import pytest
import vectortalker_core as core
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from tests.raster.scenes import blobs, noise, placed

REFUSED = {
    "nan": ({"points": np.full((2, 6, 2), np.nan, np.float32)}, "points holds NaN"),
    "far": ({"points": np.full((2, 6, 2), 1e9, np.float32)}, "within ±65536"),
    "controls": ({"points": np.zeros((2, 7, 2), np.float32)}, "7 control points"),
    "coordinates": ({"points": np.zeros((2, 6, 3), np.float32)}, r"\[2, 6, 3\]"),
    "stops": ({"stops": np.zeros((3, 3, 4), np.float32)}, r"\[3, 3, 4\]"),
    "axis": ({"axis": np.full((2, 4), np.inf, np.float32)}, "axis holds inf"),
    "clip": ({"clip": np.array([0, -1], np.int32)}, "mask 0; there are 0"),
    "masks": ({"clips": np.zeros((1, 3, 3), np.float32)}, r"\[1, 3, 3\]"),
    "canvas": ({"canvas": np.zeros(4, np.float32)}, r"\[4\]"),
    "width": ({"width": 0}, "width is 0; the limits are 1 to 4096"),
    "height": ({"height": 9000}, "height is 9000"),
    "subrows": ({"subrows": 3}, "is 3"),
    "order": (
        {"points": np.zeros((2, 2, 6), np.float32).transpose(0, 2, 1)},
        "C-contiguous",
    ),
}


def arguments(**changed: Any) -> dict[str, Any]:
    scene = blobs(0, 2, 16, 16, (3, 6), segments=2)
    return {**scene.arguments(), "width": 16, "height": 16, **changed}


@pytest.mark.parametrize("name", REFUSED)
def test_refusal_names_value_and_limit(name: str) -> None:
    changed, message = REFUSED[name]
    with pytest.raises(ValueError, match=message):
        core.rasterize(**arguments(**changed))


@pytest.mark.parametrize(
    ("checkpoints", "message"),
    [
        ([], "empty"),
        ([(3, *noise(0, 16, 16))], "counts 3 paths"),
        (
            [(2, *noise(0, 16, 16)), (1, *noise(0, 16, 16))],
            "counts 1 paths after one of 2",
        ),
        ([(2, noise(0, 16, 16)[0], noise(0, 9, 9)[1])], r"weight has shape \[9, 9\]"),
        (
            [(2, noise(0, 16, 16)[0] * np.float32(np.nan), noise(0, 16, 16)[1])],
            "target holds NaN",
        ),
        (
            [(2, noise(0, 16, 16)[0], noise(0, 16, 16)[1] * np.float32(np.inf))],
            "weight holds inf",
        ),
    ],
)
def test_checkpoint_refusal_names_value_and_limit(checkpoints: list[Any], message: str) -> None:
    scene = blobs(0, 2, 16, 16, (3, 6), segments=2)
    with pytest.raises(ValueError, match=message):
        core.loss_and_gradients(**scene.arguments(), checkpoints=placed(checkpoints))


def test_no_paths_leave_the_canvas() -> None:
    empty = {
        name: array[:0]
        for name, array in blobs(0, 2, 16, 16, (3, 6)).arguments().items()
        if name not in ("canvas", "clips")
    }
    image = core.rasterize(**{**arguments(), **empty})
    assert (image == arguments()["canvas"]).all()


coordinates = (
    st.floats(-70000, 70000, width=32)
    | st.floats(-2, 20, width=32)
    | st.sampled_from([0.0, 1.0, 8.0, 16.0, -0.0, 1e-38])
)


@settings(max_examples=150, deadline=None)
@given(
    points=arrays(np.float32, (3, 6, 2), elements=coordinates),
    axis=arrays(np.float32, (3, 4), elements=coordinates),
    size=st.tuples(st.integers(1, 40), st.integers(1, 40)),
    subrows=st.sampled_from([1, 2, 4]),
)
def test_wild_scenes_give_finite_numbers(points: Any, axis: Any, size: tuple[int, int], subrows: int) -> None:
    scene = {
        **blobs(0, 3, 16, 16, (3, 6), segments=2).arguments(),
        "points": points,
        "axis": axis,
    }
    target, weight = noise(0, *size)
    try:
        found = core.loss_and_gradients(
            **scene, checkpoints=placed([(3, target, weight)]), subrows=subrows, importance=True
        )
    except ValueError as error:
        assert "within ±65536" in str(error)  # the only limit that these scenes break
        return
    assert all(np.isfinite(array).all() for array in found)
    assert found[1].min() >= -1e-5
    assert found[1].max() <= 1 + 1e-5
