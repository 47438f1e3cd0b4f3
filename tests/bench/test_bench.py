"""The benchmark's own parts on a tiny portrait: figures, tables and sheets."""

from __future__ import annotations

import numpy as np
import pytest
from vectortalker.bench.__main__ import main
from vectortalker.bench.ledger import keep, kept
from vectortalker.bench.measure import Run, run_recipe, run_tracer
from vectortalker.bench.portraits import Sitter, portrait_files
from vectortalker.bench.sheets import CAPTION, CELL, contact_sheet
from vectortalker.bench.tables import means, side_by_side
from vectortalker.bench.tracers import available, n_segments
from vectortalker.decode import Portrait
from vectortalker.schema import VectorizeOptions

OPTIONS = VectorizeOptions(paths=8, levels=1, final_iterations=10, working_size=64, layers=False)


@pytest.fixture(scope="module")
def sitter() -> Sitter:
    y, x = np.mgrid[:48, :64]
    picture = np.where(((x - 32) ** 2 + (y - 24) ** 2 < 300)[..., None], [220, 160, 120], [40, 60, 90])
    return Sitter(Portrait(picture.astype(np.uint8), None, "disc.png", ()), None)


@pytest.fixture(scope="module")
def runs(sitter: Sitter) -> list[Run]:
    return [run_recipe("best", sitter, OPTIONS, None), run_tracer("vtracer", sitter, 64, None)]


def test_rows_state_what_was_measured(runs: list[Run]) -> None:
    best, tracer = (run.row for run in runs)
    assert best.metrics.paths == 8 and best.metrics.iterations == 10
    assert best.lpips is None and best.eyes_and_mouth_psnr is None
    assert tracer.metrics.paths >= 2 and tracer.metrics.psnr > 20
    assert runs[0].picture.shape == runs[0].target.shape == (48, 64, 3)


@pytest.mark.skipif("potrace, 24 colours" not in available(), reason="the program potrace is not installed")
def test_potrace_stacks_colours_without_gaps(sitter: Sitter) -> None:
    run = run_tracer("potrace, few paths", sitter, 64, None)
    assert run.row.metrics.psnr > 25 and run.row.metrics.paths >= 2
    assert run.row.metrics.segments == n_segments(run.svg) > run.row.metrics.paths


def test_segments_are_counted_by_their_numbers() -> None:
    assert (
        n_segments('<path d="M0 0 c1 2 3 4 5 6 7 8 9 10 11 12 l1 1 2 2z"/><path d="M0,0 C1,2 3,4 5,6 L7,8 Z "/>') == 6
    )


def test_means_table_has_a_line_per_way_and_marks_what_is_absent(runs: list[Run]) -> None:
    lines = means("Title", [run.row for run in runs]).splitlines()
    assert lines[0] == "### Title"
    assert [line.split("|")[1].strip() for line in lines[2:] if line] == ["way", "-" * 9, "best", "vtracer"]
    assert "–" in lines[4]


def test_side_by_side_has_a_column_per_way(runs: list[Run]) -> None:
    table = side_by_side("PSNR", [run.row for run in runs])
    assert "best" in table and "vtracer" in table and "disc.png" in table


def test_contact_sheet_shows_the_portrait_and_every_way(runs: list[Run]) -> None:
    assert contact_sheet([runs]).size == (3 * CELL, CELL + CAPTION)


def test_quick_portraits_are_spread_over_the_folder(tmp_path) -> None:
    for index in range(20):
        (tmp_path / f"{index:02}.png").touch()
    (tmp_path / "notes.txt").touch()
    names = [path.stem for path in portrait_files(tmp_path, quick=True, names=None)]
    assert names == ["00", "03", "06", "09", "12", "15"]
    assert [path.stem for path in portrait_files(tmp_path, quick=False, names="07,1")][:2] == ["01", "07"]


def test_kept_runs_come_back_as_they_were(runs: list[Run], tmp_path) -> None:
    assert kept(tmp_path, "disc.png", "best") is None
    for run in runs:
        keep(tmp_path, run)
        again = kept(tmp_path, "disc.png", run.row.way)
        assert again is not None
        assert again.row == run.row and again.svg == run.svg
        assert (again.picture == run.picture).all() and (again.target == run.target).all()


def test_unknown_ways_are_refused(tmp_path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "a.png").touch()
    assert main(["--portraits", str(tmp_path), "--ways", "best;worst", "--out", str(tmp_path / "out")]) == 2
    assert "worst" in capsys.readouterr().err
