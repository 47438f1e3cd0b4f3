"""Where new paths start and what they look like: properties and closed forms."""

from __future__ import annotations

import numpy as np
import pytest
import vectortalker_core as core
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.ndimage import gaussian_filter, label, uniform_filter
from skimage.measure import find_contours
from vectortalker.vectorize.interior_starts import resegment
from vectortalker.vectorize.peaks import SPACING, coherent_energy, error_samples, greedy_maxima
from vectortalker.vectorize.starts import affine_fill, circle, contour_start, through_samples


def covered(points: np.ndarray, side: int) -> np.ndarray:
    """Coverage [side, side] of one path."""
    white = np.ones((1, 3, 4), np.float32)
    image = core.rasterize(
        points[None],
        white,
        np.array([[0, 0, 1, 0]], np.float32),
        np.zeros(1, bool),
        np.full(1, -1, np.int32),
        np.zeros((0, side, side), np.float32),
        np.zeros(3, np.float32),
        side,
        side,
    )
    return image[..., 0]


@settings(deadline=None)
@given(st.integers(0, 10_000), st.floats(1, 12), st.integers(1, 60))
def test_greedy_maxima_descend_and_keep_their_distance(seed: int, radius: float, count: int) -> None:
    energies = np.random.default_rng(seed).random((2, 30, 40)).astype(np.float32)
    centres, sheets = greedy_maxima(energies, radius, count)
    values = energies[sheets, centres[:, 1], centres[:, 0]]
    assert np.all(np.diff(values) <= 0)
    reach = max(1, round(SPACING * radius))
    for sheet in (0, 1):
        own = centres[sheets == sheet].astype(float)
        gaps = np.linalg.norm(own[:, None] - own[None], axis=2) + 1e9 * np.eye(len(own))
        assert gaps.min(initial=1e9) > reach


def test_greedy_maxima_stop_where_no_energy_is_left() -> None:
    energies = np.zeros((1, 20, 20), np.float32)
    energies[0, 3, 4] = 1
    centres, sheets = greedy_maxima(energies, 2.0, 5)
    assert centres.tolist() == [[4, 3]]
    assert sheets.tolist() == [0]


def test_coherent_energy_prefers_a_faint_patch_to_strong_texture() -> None:
    residual = np.zeros((40, 80, 3), np.float32)
    residual[:, :40] = np.where(np.indices((40, 40)).sum(axis=0) % 2, 0.5, -0.5)[..., None]
    residual[15:25, 55:65] = 0.1
    energy = coherent_energy(residual, np.ones((40, 80), np.float32), 4.0)
    assert energy[:, 45:].max() > 10 * energy[10:30, 5:35].max()


@pytest.mark.parametrize(
    "owned", [(slice(0, 0), slice(0, 0)), (slice(3, 9), slice(60, 80)), (slice(0, 40), slice(20, 21))]
)
def test_coherent_energy_of_a_part_is_that_of_the_whole_picture(owned: tuple[slice, slice]) -> None:
    residual = np.random.default_rng(0).normal(size=(40, 80, 3)).astype(np.float32)
    weight = np.zeros((40, 80), np.float32)
    weight[owned] = 1
    whole = core.coherent_energy(residual, weight, 4)  # a radius of 5 px averages over 4 on each side
    np.testing.assert_allclose(coherent_energy(residual, weight, 5.0), whole, atol=1e-12)


def test_error_samples_fall_only_where_there_is_error() -> None:
    energies = np.zeros((2, 10, 10), np.float32)
    energies[1, 2:4, 5:7] = 1
    centres, sheets = error_samples(energies, 200, np.random.default_rng(0))
    assert set(sheets.tolist()) == {1}
    assert {tuple(c) for c in centres.tolist()} == {(5, 2), (6, 2), (5, 3), (6, 3)}


@pytest.mark.parametrize("segments", [3, 8, 32])
def test_circle_covers_its_area(segments: int) -> None:
    points = circle((20, 20), 15, segments)
    assert points.shape == (3 * segments, 2)
    assert covered(points, 40).sum() == pytest.approx(np.pi * 15**2, rel=6e-3)  # chords lie inside the curve


def test_cubics_through_samples_pass_them_at_thirds() -> None:
    angle = np.linspace(0, 2 * np.pi, 241)
    outline = np.stack([30 * np.cos(angle), 20 * np.sin(angle)], axis=1)
    points = through_samples(outline, 4).reshape(4, 3, 2).astype(float)
    ends = np.roll(points[:, 0], -1, axis=0)
    for t in (1 / 3, 2 / 3):
        basis = ((1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3)
        on_curve = sum(b * p for b, p in zip(basis, (points[:, 0], points[:, 1], points[:, 2], ends), strict=True))
        assert np.allclose((on_curve[:, 0] / 30) ** 2 + (on_curve[:, 1] / 20) ** 2, 1, atol=2e-3)


def test_contour_start_takes_the_outline_and_colour_of_its_component() -> None:
    y, x = np.mgrid[:80, :80]
    bean = (((x - 40) / 22.0) ** 2 + ((y - 40) / 9.0) ** 2 < 1) & ~((np.abs(x - 40) < 6) & (y < 36))
    target = np.where(bean[..., None], [0.9, 0.2, 0.1], 0.5).astype(np.float32)
    residual = (target - 0.5).astype(np.float32)
    start = contour_start(target, residual, np.ones(residual.shape[:2], np.bool_), (40, 42), 12, 8)
    found = covered(start.points, 80) > 0.5
    assert (found & bean).sum() / (found | bean).sum() > 0.75  # the notch is blurred
    assert np.allclose(start.stops[:, :3].mean(axis=0), [0.9, 0.2, 0.1], atol=0.08)


@pytest.mark.parametrize("reach", [0, 3, 50])
def test_coherent_energy_is_that_of_box_means(reach: int) -> None:
    generator = np.random.default_rng(0)
    residual = generator.normal(size=(20, 31, 3)).astype(np.float32)
    weight = generator.random((20, 31), np.float32)
    mean = uniform_filter(residual * weight[..., None], size=2 * reach + 1, axes=(0, 1), mode="constant")
    expected = (mean**2).sum(axis=2)
    assert np.allclose(core.coherent_energy(residual, weight, reach), expected, atol=1e-6 * expected.max())


def test_contour_is_that_of_marching_squares() -> None:
    field = gaussian_filter(np.random.default_rng(0).normal(size=(60, 50)), 2).astype(np.float32)
    y, x = (int(i) for i in np.unravel_index(np.argmax(field), field.shape))
    level = 0.02
    labels, _ = label(field > level)
    found = core.contour(field, x, y, level)
    assert found is not None
    inside, outline = found
    assert (inside == (labels == labels[y, x])).all()
    lowered = np.where(inside, field, np.minimum(field, level - 1e-3))
    longest = max(find_contours(np.pad(lowered, 1, constant_values=-1), level), key=len)[:, ::-1] - 1
    ours = {tuple(point) for point in np.round(outline.astype(float), 3).tolist()}
    theirs = {tuple(point) for point in np.round(longest, 3).tolist()}
    border = {point for point in ours if not (0 <= point[0] <= 49 and 0 <= point[1] <= 59)}
    assert len(ours ^ theirs) <= 2 * len(border)  # rounding may differ beyond the border only


@pytest.mark.parametrize("level", [2.0, float("nan")])
def test_contour_of_a_pixel_that_is_not_above_the_level_is_none(level: float) -> None:
    assert core.contour(np.ones((4, 4), np.float32), 1, 1, level) is None


def test_affine_fill_reproduces_linear_colours() -> None:
    y, x = np.mgrid[:20, :30]
    ramp = (0.2 + 0.02 * x)[..., None] * np.ones(3)
    stops, axis = affine_fill(ramp.astype(np.float32), np.ones((20, 30), bool), (100, 50))
    start, end = axis[:2].astype(float), axis[2:].astype(float)
    at = np.stack([x + 100.5, y + 50.5], axis=-1)
    share = np.clip((at - start) @ (end - start) / ((end - start) @ (end - start)), 0, 1)
    painted = stops[0, :3] + share[..., None] * (stops[-1, :3] - stops[0, :3])
    assert np.abs(painted - ramp).max() < 2e-3


def test_resegmented_circle_stays_a_circle() -> None:
    points = resegment(circle((50, 40), 20, 8).astype(np.float64), 5)
    assert points.shape == (15, 2)
    assert np.allclose(np.linalg.norm(points[::3] - [50, 40], axis=1), 20, atol=0.05)
