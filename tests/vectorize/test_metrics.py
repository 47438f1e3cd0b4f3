"""Scores against scikit-image, closed forms and resvg's own pixels."""

from __future__ import annotations

import numpy as np
import pytest
from skimage.metrics import structural_similarity
from vectortalker import metrics


@pytest.mark.parametrize("shape", [(40, 60, 3), (11, 17, 3)])
def test_ssim_equals_scikit_image(shape: tuple[int, int, int]) -> None:
    generator = np.random.default_rng(0)
    a = generator.integers(0, 256, shape).astype(np.uint8)
    b = np.clip(a + generator.normal(0, 20, shape), 0, 255).astype(np.uint8)
    expected = structural_similarity(
        a / 255,
        b / 255,
        channel_axis=2,
        data_range=1.0,
        gaussian_weights=True,
        sigma=1.5,
        use_sample_covariance=False,
    )
    assert metrics.ssim(a, b) == pytest.approx(expected, abs=1e-12)


def test_ssim_of_a_picture_smaller_than_its_window_is_one_with_itself() -> None:
    picture = np.random.default_rng(1).integers(0, 256, (5, 40, 3)).astype(np.uint8)
    assert metrics.ssim(picture, picture) == pytest.approx(1)


def test_psnr_of_one_level_of_256_is_48_13_db() -> None:
    grey = np.full((4, 4, 3), 100, np.uint8)
    assert metrics.psnr(metrics.mse(grey, grey + 1)) == pytest.approx(20 * np.log10(255))


def test_render_has_the_size_asked_for_although_the_sides_do_not_scale_to_whole_pixels() -> None:
    svg = (
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 512 600" width="437" height="512">'
        '<rect x="-5" y="-5" width="522" height="610" fill="#102030"/></svg>'
    )
    picture = metrics.render(svg, 437, 512)
    assert picture.shape == (512, 437, 3)
    assert (picture == [16, 32, 48]).all()
