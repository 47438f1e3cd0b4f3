"""Coverage in closed form: areas of polygons in pixels, the nonzero rule, and what must not matter."""

from dataclasses import replace

import numpy as np
import pytest
import vectortalker_core as core

from tests.raster.scenes import blobs, paint, polygon, solid


def covered(*corners: tuple[float, float], width: int = 4, height: int = 4) -> np.ndarray:
    """Coverage [H, W] of a polygon: black paint on white."""
    return 1 - paint(solid(polygon(*corners)), width, height)[..., 0]


def test_half_covered_pixel() -> None:
    assert covered((1, 1), (1.5, 1), (1.5, 2), (1, 2))[1, 1] == pytest.approx(0.5, abs=1e-6)


def test_rectangle_between_grid_lines() -> None:
    got = covered((0.75, 1.5), (2.25, 1.5), (2.25, 3), (0.75, 3))
    columns, rows = np.array([0.25, 1, 0.25, 0]), np.array([0, 0.5, 1, 0])
    np.testing.assert_allclose(got, rows[:, None] * columns, atol=1e-6)


def test_diagonal_halves_the_pixels_it_crosses() -> None:
    got = covered((0, 0), (4, 4), (0, 4))
    np.testing.assert_allclose(got, np.tril(np.ones((4, 4)), -1) + np.eye(4) / 2, atol=1e-6)


def test_orientation_does_not_matter() -> None:
    corners = [(0.3, 0.2), (3.7, 1.1), (2.2, 3.9)]
    np.testing.assert_allclose(covered(*corners), covered(*reversed(corners)), atol=1e-6)


def test_path_around_the_canvas_covers_it_wholly() -> None:
    assert (covered((-9, -9), (50, -9), (50, 50), (-9, 50), width=33, height=21) == 1).all()


def test_path_beside_the_canvas_covers_nothing() -> None:
    for dx, dy in [(-20, 0), (20, 0), (0, -20), (0, 20)]:
        assert (covered((1 + dx, 1 + dy), (3 + dx, 1 + dy), (3 + dx, 3 + dy), (1 + dx, 3 + dy)) == 0).all()


def test_chord_across_the_left_border_is_split_not_bent() -> None:
    got = covered((-2, 0), (2, 2), (-2, 2), width=2, height=2)  # the side x = 2y − 2 enters the canvas at (0, 1)
    np.testing.assert_allclose(got, [[0, 0], [0.75, 0.25]], atol=1e-6)


def test_area_is_kept_when_a_shape_moves_by_fractions() -> None:
    corners = np.array([(3, 3), (17, 5), (14, 18), (4, 11)], float)  # shoelace: half of |Σ x·y' − x'·y|
    following = np.roll(corners, -1, 0)
    area = abs(np.sum(corners[:, 0] * following[:, 1] - following[:, 0] * corners[:, 1])) / 2
    for shift in (0, 0.1, 0.37, 0.99):
        got = covered(*(corners + shift).tolist(), width=40, height=40)
        assert got.sum() == pytest.approx(area, rel=1e-5)


def test_circle_of_cubics_has_the_area_of_its_curve() -> None:
    got = (1 - paint(solid(ring(32, 32, 20)), 64, 64)[..., 0]).sum()
    # Chords within 0.05 px of the arc lie 2/3 of that inside it, 2·(2/3·0.05)/20 of the area; all but those at the
    # anchors, a quarter at most, are moved out.
    assert got == pytest.approx(np.pi * 400, rel=2 * (2 / 3 * 0.05) / 20 / 4)


def ring(x: float, y: float, radius: float) -> np.ndarray:
    turn = np.arange(8) * np.pi / 4
    handle = 4 / 3 * np.tan(np.pi / 16)
    anchor, tangent = (
        np.stack([np.cos(turn), np.sin(turn)], -1),
        np.stack([-np.sin(turn), np.cos(turn)], -1),
    )
    unit = np.stack(
        [anchor, anchor + handle * tangent, np.roll(anchor - handle * tangent, -1, 0)],
        1,
    ).reshape(1, -1, 2)
    return (unit * radius + (x, y)).astype(np.float32)


def test_double_winding_saturates() -> None:
    twice = [(1, 1), (3, 1), (3, 3), (1, 3)] * 2
    np.testing.assert_allclose(covered(*twice), covered(*twice[:4]), atol=1e-6)


def test_subrows_keep_opposite_lobes_from_cancelling() -> None:
    lobes = solid(polygon((0, 0), (2, 0), (0, 1), (2, 1)))  # a bow tie of area 1/2 + 1/2, wound both ways, in one row
    whole, fine = (1 - paint(lobes, 2, 1, subrows=s)[..., 0] for s in (1, 4))
    assert whole.sum() == pytest.approx(0, abs=1e-6)
    assert fine.sum() > 0.9


def test_coverage_of_an_opening_is_that_of_black_paint() -> None:
    points = ring(9.3, 7.1, 5)
    np.testing.assert_allclose(
        core.coverage(points[0], 20, 17),
        1 - paint(solid(points), 20, 17, subrows=4)[..., 0],
        atol=1e-6,
    )


def test_clip_mask_multiplies_opacity() -> None:
    scene = solid(polygon((0, 0), (4, 0), (4, 4), (0, 4)))
    mask = np.linspace(0, 1, 16, dtype=np.float32).reshape(1, 4, 4)
    clipped = type(scene)(**{**scene.arguments(), "clip": np.zeros(1, np.int32), "clips": mask})
    np.testing.assert_allclose(1 - paint(clipped, 4, 4)[..., 0], mask[0], atol=1e-6)


def test_quantised_picture_holds_8_bit_values() -> None:
    got = paint(blobs(1, 20, 40, 30, (5, 12)), 40, 30, quantise=True) * 255
    np.testing.assert_allclose(got, np.rint(got), atol=1e-4)


@pytest.mark.parametrize("size", [(1, 1), (16, 16), (17, 33), (130, 47)])
def test_bits_do_not_depend_on_threads(size: tuple[int, int]) -> None:
    scene = blobs(2, 40, *size, (3, 20))
    one, three = (paint(scene, *size, threads=t) for t in (1, 3))
    assert one.tobytes() == three.tobytes()


def test_stack_holds_the_pictures_of_the_lowest_paths() -> None:
    scene = blobs(2, 70, 40, 50, (3, 20))
    heights = [0, 3, 3, 66, 70]
    stack = core.rasterize_stack(**scene.arguments(), width=40, height=50, heights=heights)
    for height, picture in zip(heights, stack, strict=True):
        lowest = {name: values[:height] for name, values in scene.arguments().items() if len(values) == 70}
        assert picture.tobytes() == paint(replace(scene, **lowest), 40, 50).tobytes()


def test_overlap_measures_folds_and_reversals() -> None:
    twice = polygon(*([(1, 1), (5, 1), (5, 5), (1, 5)] * 2))  # 16 px², all of it wound around twice
    lobes = polygon((1, 1), (9, 9), (9, 1), (1, 9), (1, 1), (1, 1), (1, 1), (1, 1))  # two opposed triangles
    covered_, folded, reversed_ = core.overlap(np.concatenate([twice, lobes]), 16, 16).T
    np.testing.assert_allclose([covered_[0], folded[0], reversed_[0]], [16, 16, 0], atol=1e-6)
    assert folded[1] == 0
    assert reversed_[1] / covered_[1] == pytest.approx(0.5, abs=0.1)
