"""The exact chain against the original runtime's mesh, landmarks against annotations, and pictures without a face."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image
from vectortalker.decode import Portrait, decode
from vectortalker.landmarks import detect, to_wire
from vectortalker.landmarks.detector import find_faces
from vectortalker.landmarks.faces import DETECTION_SIDE
from vectortalker.landmarks.ibug import SOURCES, outer_eye_distance
from vectortalker.landmarks.mesh import fit_mesh
from vectortalker.landmarks.window import Window

Sample = Callable[[str], Portrait]

# What the annotators of the drawings mean by a brow or a bearded chin differs from iBUG's definition by this much.
MAX_ERROR = {
    "render3d-ict-a": 0.02,
    "cartoon-roy": 0.05,
    "painting-vangogh-felt-hat": 0.07,
    "sketch-marker-boy": 0.09,
}


def test_mapping_names_a_source_for_each_of_68_points() -> None:
    assert len(SOURCES) == 68
    assert all(0 <= share < 1 and max(a, b) < 468 for a, b, share in SOURCES)


@pytest.mark.parametrize(
    "name",
    [
        "astronaut.jpg",
        "mona-lisa.jpg",
        "ada-lovelace.jpg",
        "toon-head.png",
        "eileen.png",
    ],
)
def test_sample_has_one_face_in_plausible_order(sample: Sample, name: str) -> None:
    portrait = sample(name)
    (face,) = detect(portrait.rgb)
    points = face.points
    assert points[8, 1] > points[57, 1] > points[33, 1] > points[27, 1] > points[19, 1]  # chin below lips below nose …
    assert points[0, 0] < points[36, 0] < points[45, 0] < points[16, 0]
    assert (points > 0).all() and (points < (portrait.width, portrait.height)).all()


def test_wire_form_holds_the_face(sample: Sample) -> None:
    portrait = sample("astronaut.jpg")
    faces = detect(portrait.rgb)
    wire = to_wire(faces, portrait.width, portrait.height)
    assert wire.faces[0].landmarks.points[30] == tuple(faces[0].points[30])
    assert not wire.faces[0].fit_advised


def test_drawing_advises_a_fit_by_hand(sample: Sample) -> None:
    assert detect(sample("lucy.png").rgb)[0].fit_advised


@pytest.mark.parametrize("turns", [1, 2, 3])
def test_turned_picture_turns_its_landmarks(sample: Sample, turns: int) -> None:
    picture = sample("astronaut.jpg").rgb
    upright = detect(picture)[0].points / picture.shape[0]
    turned = detect(np.ascontiguousarray(np.rot90(picture, turns)))[0].points / picture.shape[0]
    for _ in range(turns):  # np.rot90 takes (x, y) to (y, 1 − x); this takes it back
        turned = np.stack([1 - turned[:, 1], turned[:, 0]], axis=1)
    assert np.linalg.norm(turned - upright, axis=1).mean() < 0.05 * outer_eye_distance(upright)


@pytest.mark.parametrize("value", [0, 128, 255])
def test_blank_picture_has_no_face(value: int) -> None:
    assert detect(np.full((120, 90, 3), value, np.uint8)) == []


def test_noise_has_no_face() -> None:
    assert detect(np.random.default_rng(1).integers(0, 255, (200, 300, 3), np.uint8)) == []


def test_pictures_without_a_face_give_none(shared_data: Path) -> None:
    for file in (shared_data / "hard").glob("noface-*"):
        assert detect(decode(file.read_bytes(), file.name).rgb) == [], file.name


def test_mesh_equals_the_original_runtimes(shared_data: Path) -> None:
    """Within .1 % of the outer-eye distance, every point, on all portraits that the original finds a face in."""
    n_compared = 0
    for file in sorted((shared_data / "reference").glob("*.mesh478.json")):
        reference = json.loads(file.read_text())
        if reference["faces"]:
            want = np.array(reference["faces"][0])[:, :2]
            got = _nearest_mesh(shared_data / "portraits" / reference["image"], want)
            error = np.linalg.norm(got - want, axis=1).max() / np.linalg.norm(want[33] - want[263])
            assert error < 1e-3, (file.name, error)
            n_compared += 1
    assert n_compared >= 19


def _nearest_mesh(file: Path, want: NDArray[np.float64]) -> NDArray[np.float64]:
    picture = Image.fromarray(decode(file.read_bytes(), file.name).rgb)
    scale = min(1, DETECTION_SIDE / max(picture.size))
    size = (round(picture.width * scale), round(picture.height * scale))
    small = np.asarray(picture if scale == 1 else picture.resize(size, Image.Resampling.LANCZOS))
    stretch = np.array(picture.size) / size
    boxes = find_faces(small, Window.square_around(small))
    meshes = [fit_mesh(small, box.roi).points[:, :2] * stretch for box in boxes]
    return min(meshes, key=lambda mesh: float(np.abs(mesh - want).mean()))


def test_landmarks_agree_with_annotations(shared_data: Path) -> None:
    for stem, limit in MAX_ERROR.items():
        rows = (shared_data / "portraits" / "landmarks" / f"{stem}.pts").read_text().split("{")[1].split("}")[0]
        want = np.array([row.split() for row in rows.strip().splitlines()], float)
        (file,) = (shared_data / "portraits").glob(f"{stem}.*")
        got = detect(decode(file.read_bytes(), file.name).rgb)[0].points
        error = np.linalg.norm(got - want, axis=1).mean() / outer_eye_distance(want)
        assert error < limit, (stem, error)


def test_fits_beyond_five_per_cent_are_doubted(shared_data: Path) -> None:
    for stem, doubted in (("painting-vangogh-felt-hat", True), ("sketch-marker-boy", True), ("cartoon-roy", False)):
        (file,) = (shared_data / "portraits").glob(f"{stem}.*")
        assert detect(decode(file.read_bytes(), file.name).rgb)[0].fit_advised == doubted, stem
