"""`vectorize` on a tiny generated portrait: quality floor, determinism, cancelling, resuming, finishing early."""

from __future__ import annotations

from collections.abc import Generator

import numpy as np
import pytest
from vectortalker import metrics
from vectortalker.bench.portraits import REPOSITORY, sitters
from vectortalker.decode import Portrait, canonical
from vectortalker.errors import VectorTalkerError
from vectortalker.schema import VectorizeOptions
from vectortalker.vectorize import Checkpoint, Progress, Result, vectorize

SIDE = 96


@pytest.fixture(scope="module")
def portrait() -> Portrait:
    """A face-like drawing: shaded skin, dark hair, two eyes and a mouth over a plain ground."""
    y, x = np.mgrid[: SIDE - 16, :SIDE].astype(float)
    picture = np.full((SIDE - 16, SIDE, 3), 0.8)
    picture[((x - 48) / 34) ** 2 + ((y - 40) / 38) ** 2 < 1] = [0.25, 0.15, 0.1]
    skin = ((x - 48) / 26) ** 2 + ((y - 46) / 32) ** 2 < 1
    picture[skin] = (np.array([0.9, 0.7, 0.6]) * (0.75 + 0.25 * x[..., None] / SIDE))[skin]
    for centre in (37, 59):
        picture[((x - centre) / 6) ** 2 + ((y - 40) / 3) ** 2 < 1] = 0.95
        picture[(x - centre) ** 2 + (y - 40) ** 2 < 6] = 0.1
    picture[((x - 48) / 10) ** 2 + ((y - 62) / 3) ** 2 < 1] = [0.7, 0.2, 0.2]
    return Portrait((picture * 255).round().astype(np.uint8), None, "drawing", ())


def options(**changes: object) -> VectorizeOptions:
    base = dict(paths=40, levels=3, iterations=40, final_iterations=120, working_size=SIDE, layers=False)
    return VectorizeOptions.model_validate({**base, **changes})


def run(steps: Generator[Progress, None, Result]) -> tuple[list[Progress], Result]:
    reports = []
    while True:
        try:
            reports.append(next(steps))
        except StopIteration as end:
            return reports, end.value


@pytest.fixture(scope="module")
def finished(portrait: Portrait) -> tuple[list[Progress], Result]:
    return run(vectorize(portrait, None, options()))


def test_best_passes_its_quality_floor(finished: tuple[list[Progress], Result], portrait: Portrait) -> None:
    _, result = finished
    target = canonical(portrait, SIDE)
    painted = metrics.render(result.svg, target.shape[1], target.shape[0])
    assert metrics.psnr(metrics.mse(painted, target)) > 31.5
    assert result.metrics.psnr == pytest.approx(metrics.psnr(metrics.mse(painted, target)))


@pytest.mark.parametrize("recipe", ["paper", "diffvg"])
def test_baselines_pass_theirs(recipe: str, portrait: Portrait) -> None:
    _, result = run(vectorize(portrait, None, options(recipe=recipe)))
    assert result.metrics.paths == 40
    assert result.metrics.psnr > 26
    assert all(path.fill.kind == "solid" for path in result.scene.fore)


def test_paths_are_exactly_as_many_as_asked_for(finished: tuple[list[Progress], Result]) -> None:
    reports, result = finished
    assert result.metrics.paths == 40
    assert reports[-1].n_paths == 40
    assert result.metrics.segments == 40 * 8


def test_progress_grows_and_every_level_shows_a_scene(finished: tuple[list[Progress], Result]) -> None:
    reports, _ = finished
    fractions = [report.fraction for report in reports]
    assert fractions == sorted(fractions)
    assert {report.level for report in reports if report.scene is not None} == {1, 2, 3}


def test_scene_of_a_report_is_that_of_its_time(portrait: Portrait) -> None:
    """It is made when it is first asked for: at once in one run, after all iterations in the other."""
    asked = [report.scene for report in vectorize(portrait, None, options())]
    kept, _ = run(vectorize(portrait, None, options()))
    assert asked == [report.scene for report in kept]


def test_result_does_not_depend_on_the_number_of_threads(portrait: Portrait) -> None:
    one, many = (run(vectorize(portrait, None, options(), threads=threads))[1].svg for threads in (1, 3))
    assert one == many


def test_layers_do_not_depend_on_it_either() -> None:
    """Single layers are looked at beside the whole, by threads of their own."""
    (sitter,) = sitters([REPOSITORY / "public/samples/mona-lisa.jpg"])
    tiny = options(paths=24, levels=2, iterations=10, final_iterations=10, layers=True)
    runs = (vectorize(sitter.portrait, sitter.landmarks, tiny, threads=threads) for threads in (1, 3))
    one, many = (run(steps)[1].svg for steps in runs)
    assert one == many


def test_seed_changes_a_sampled_start(portrait: Portrait) -> None:
    first, second = (run(vectorize(portrait, None, options(recipe="paper", seed=seed)))[1].svg for seed in (0, 1))
    assert first != second


def test_resuming_from_a_level_gives_the_same_svg(finished: tuple[list[Progress], Result], portrait: Portrait) -> None:
    reports, result = finished
    saved = [report.checkpoint for report in reports if isinstance(report.checkpoint, Checkpoint)]
    assert [checkpoint.level for checkpoint in saved] == [1, 2, 3]
    _, resumed = run(vectorize(portrait, None, options(), resume=saved[1]))
    assert resumed.svg == result.svg


def test_resuming_with_other_options_is_refused(finished: tuple[list[Progress], Result], portrait: Portrait) -> None:
    saved = next(report.checkpoint for report in finished[0] if report.checkpoint)
    with pytest.raises(VectorTalkerError, match="start afresh"):
        run(vectorize(portrait, None, options(seed=7), resume=saved))


def test_finishing_early_keeps_what_there_is(portrait: Portrait) -> None:
    _, result = run(vectorize(portrait, None, options(), finish_early=lambda: True))
    assert 0 < result.metrics.iterations < 40
    assert result.metrics.paths == round(40 / 3)


def test_closing_the_generator_stops_it(portrait: Portrait) -> None:
    steps = vectorize(portrait, None, options())
    next(steps)
    next(steps)
    steps.close()
    with pytest.raises(StopIteration):
        next(steps)


@pytest.mark.parametrize("fills", ["solid", "gradient"])
def test_opaque_scenes_have_no_opacity(fills: str, portrait: Portrait) -> None:
    _, result = run(vectorize(portrait, None, options(fills=fills, opacity="opaque", iterations=5, final_iterations=5)))
    assert "opacity" not in result.svg
    assert ("linearGradient" in result.svg) == (fills == "gradient")
