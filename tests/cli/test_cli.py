"""The command line: what is written, what is said, and with which exit code."""

from __future__ import annotations

import json
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from vectortalker.cli import main
from vectortalker.project import unpack
from vectortalker.schema import Faces, Metrics

TINY = ["--paths", "16", "--levels", "1", "--final-iterations", "2", "--working-size", "64"]


@pytest.fixture
def portrait(tmp_path: Path) -> Path:
    """No face, so that nothing depends on the detector."""
    y, x = np.mgrid[0:60, 0:40]
    path = tmp_path / "waves.png"
    Image.fromarray(np.stack([x * 6, y * 4, 128 + 0 * x], axis=-1).astype(np.uint8)).save(path)
    return path


def refusal(arguments: list[str | Path], capsys: pytest.CaptureFixture[str]) -> str:
    """Runs a command that must fail as the user's fault; its only line."""
    assert _exit_code(arguments) == 2
    shown = capsys.readouterr()
    assert shown.out == "" and shown.err.count("\n") == 1, shown.err
    return shown.err


def _exit_code(arguments: list[str | Path]) -> int:
    try:
        return main([str(argument) for argument in arguments])
    except SystemExit as end:
        return int(end.code or 0)


def test_vectorize_writes_svg_project_and_metrics(portrait: Path, tmp_path: Path) -> None:
    svg, project, metrics = tmp_path / "out.svg", tmp_path / "out.vtalk", tmp_path / "out.json"
    assert (
        main(["vectorize", str(portrait), "-o", str(svg), "--project", str(project), "--metrics", str(metrics), *TINY])
        == 0
    )
    root = ElementTree.parse(svg).getroot()
    assert root.get("viewBox") == "0 0 40 60"
    assert [group.get("id") for group in root if group.tag.endswith("}g")] == ["back", "fore", "local"]
    scores = Metrics.model_validate_json(metrics.read_text())
    assert len(list(root.iter("{http://www.w3.org/2000/svg}path"))) >= scores.paths > 0
    file = unpack(project.read_bytes(), "out.vtalk")
    assert file.project.landmarks is None and file.source is not None
    assert (file.project.scene.width, file.project.scene.height) == (40, 60)


def test_vectorize_same_seed_gives_the_same_bytes(portrait: Path, tmp_path: Path) -> None:
    first, second = tmp_path / "1.svg", tmp_path / "2.svg"
    for path in (first, second):
        assert main(["vectorize", str(portrait), "-o", str(path), *TINY, "--seed", "5"]) == 0
    assert first.read_bytes() == second.read_bytes()


@pytest.mark.parametrize(("recipe", "gradients"), [("best", True), ("paper", False), ("diffvg", False)])
def test_vectorize_by_every_recipe(recipe: str, gradients: bool, portrait: Path, tmp_path: Path) -> None:
    svg, metrics = tmp_path / "out.svg", tmp_path / "out.json"
    assert main(["vectorize", str(portrait), "-o", str(svg), "--metrics", str(metrics), *TINY, "--recipe", recipe]) == 0
    assert Metrics.model_validate_json(metrics.read_text()).paths == 16
    assert ("linearGradient" in svg.read_text()) is gradients


def test_vectorize_failure_leaves_nothing_behind(
    portrait: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "out"
    out.mkdir()
    message = refusal(
        ["vectorize", portrait, "-o", out / "a.svg", "--metrics", tmp_path / "gone" / "m.json", *TINY], capsys
    )
    assert "m.json cannot be written" in message
    assert list(out.iterdir()) == []


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--paths", "3"], "--paths 3"),
        (["--paths", "many"], "--paths"),
        (["--working-size", "9000"], "2048"),
        (["--preset", "best"], "draft"),
        (["--colour"], "--colour"),
    ],
)
def test_vectorize_option_at_fault_is_named(
    portrait: Path, arguments: list[str], words: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert words in refusal(["vectorize", portrait, "-o", portrait.with_suffix(".svg"), *arguments], capsys)


@pytest.mark.parametrize(
    ("content", "words"),
    [(None, "does not exist"), (b"", "0 bytes"), (b"text", "not a picture"), (b"<svg/>", "SVG")],
)
def test_portrait_that_is_none_is_refused(
    tmp_path: Path, content: bytes | None, words: str, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "portrait.png"
    if content is not None:
        path.write_bytes(content)
    assert words in refusal(["landmarks", path, "-o", tmp_path / "out.json"], capsys)
    assert not (tmp_path / "out.json").exists()


def test_folder_is_no_portrait(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert "directory" in refusal(["landmarks", tmp_path, "-o", tmp_path / "out.json"], capsys)


def test_landmarks_of_no_face_are_an_answer(portrait: Path, tmp_path: Path) -> None:
    out = tmp_path / "faces.json"
    assert main(["landmarks", str(portrait), "-o", str(out)]) == 0
    assert Faces.model_validate_json(out.read_text()) == Faces(width=40, height=60, faces=[])


def test_animate_without_a_face_asks_for_one(
    portrait: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    project, track = tmp_path / "p.vtalk", tmp_path / "track.json"
    assert main(["vectorize", str(portrait), "-o", str(tmp_path / "p.svg"), "--project", str(project), *TINY]) == 0
    track.write_text(json.dumps({"schema_version": 1, "duration": 0.2, "fps": 10, "articulators": {"jaw": [0, 1]}}))
    capsys.readouterr()
    assert "no face" in refusal(["animate", project, "--track", track, "-o", tmp_path / "out.svg"], capsys)
    assert "known" in refusal(["animate", project, "--track", track, "-o", tmp_path / "out.doc"], capsys)
    assert "p.svg" in refusal(["animate", tmp_path / "p.svg", "--track", track, "-o", tmp_path / "out.svg"], capsys)


def test_batch_names_the_refused_and_does_the_rest(
    portrait: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "note.txt").write_text("hello")
    out = tmp_path / "out"
    assert main(["batch", str(tmp_path), "-o", str(out), *TINY]) == 2
    assert "note.txt is not a picture" in capsys.readouterr().err
    assert sorted(path.name for path in out.iterdir()) == ["waves.png.svg", "waves.png.vtalk"]


def test_help_loads_nothing_heavy() -> None:
    code = (
        "import sys\nfrom vectortalker.cli import main\n"
        "try:\n    main(['--help'])\nexcept SystemExit:\n"
        "    sys.exit(' '.join({'torch', 'onnxruntime', 'fastapi', 'huey', 'numpy'} & set(sys.modules)) or 0)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert "vectorize" in done.stdout
