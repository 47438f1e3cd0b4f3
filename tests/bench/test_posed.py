"""The figures of posed portraits on the vectors' face: they see what they are there to see."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from vectortalker.animate.drawing import Points
from vectortalker.animate.rigged import RiggedScene, frame_points, rig_scene
from vectortalker.bench.posed_figures import Sitting
from vectortalker.bench.posed_parts import IrisLook, PaintedParts
from vectortalker.bench.posed_tears import Tears, resting_places
from vectortalker.bench.posed_views import IRISES, TEETH
from vectortalker.bench.unsplit import distances_from_map
from vectortalker.schema import Landmarks, LocalPath, Part, Pose, Scene, ScenePath, SolidFill

VECTORS = json.loads((Path(__file__).parents[1] / "vectors/rig/face.json").read_text())


@pytest.fixture(scope="module")
def scene() -> Scene:
    """The vectors' scene with a white eyeball under its blue iris."""
    grey = Scene.model_validate(VECTORS["scene"])
    iris = next(path for path in grey.local if path.part == "right_iris")
    ring = np.reshape(iris.points, (-1, 2))
    ball = LocalPath(
        points=(ring.mean(0) + 2 * (ring - ring.mean(0))).ravel().tolist(),
        fill=SolidFill(colour="#ffffff"),
        part="right_eye",
    )
    others = [path for path in grey.local if path is not iris]
    blue = iris.model_copy(update={"fill": SolidFill(colour="#204080")})
    return grey.model_copy(update={"local": [*others, ball, blue]})


@pytest.fixture(scope="module")
def landmarks() -> Landmarks:
    return Landmarks.model_validate(VECTORS["landmarks"])


@pytest.fixture(scope="module")
def rigged(scene: Scene, landmarks: Landmarks) -> RiggedScene:
    return rig_scene(scene, landmarks)


@pytest.fixture(scope="module")
def parts(scene: Scene) -> list[Part | None]:
    nowhere: list[Part | None] = [None] * (len(scene.back) + len(scene.fore))
    return [*nowhere, *(path.part for path in scene.local)]


def stretched(rigged: RiggedScene, parts: list[Part | None], part: Part, by: float) -> Points:
    """The rest frame with one part wider about its middle."""
    points = rigged.rest.copy()
    for path, own in enumerate(parts):
        if own == part:
            span = slice(rigged.drawing.bounds[path], rigged.drawing.bounds[path + 1])
            middle = points[span, 0].mean()
            points[span, 0] = middle + by * (points[span, 0] - middle)
    return points


def test_resting_portrait_has_nothing_wrong(rigged: RiggedScene, scene: Scene, landmarks: Landmarks) -> None:
    figures = Sitting(rigged, scene, landmarks, (256, 256)).figures(Pose(), IRISES)
    assert (figures.holes, figures.tears, figures.strayed, figures.held) == (0, 0, 0, 1)
    assert (figures.iris_shape, figures.iris_size, figures.iris_look) == (0, 0, 0)


def test_stretched_iris_and_teeth_are_measured(rigged: RiggedScene, parts: list[Part | None]) -> None:
    painted = PaintedParts(rigged.drawing, parts)
    rest = painted.blots(rigged.rest, (*IRISES, *TEETH))
    for part in ("right_iris", "mouth_lower"):
        assert rest[part].area > 30
        wide = painted.blots(stretched(rigged, parts, part, 1.1), (part,))[part]
        assert wide.area / rest[part].area == pytest.approx(1.1, abs=0.02)
    wide = painted.blots(stretched(rigged, parts, "right_iris", 1.1), ("right_iris",))["right_iris"]
    assert abs(wide.roundness / rest["right_iris"].roundness - 1) > 0.05


def test_looking_aside_leaves_the_iris_its_look(rigged: RiggedScene, parts: list[Part | None]) -> None:
    look = IrisLook(rigged, parts, VECTORS["landmarks"]["irises"][1]["radius"], 1)
    aside = rigged.rig.vertices(Pose(articulators={"gaze_x": 0.5, "roll": 10})).vertices
    assert look.unlike(frame_points(rigged, aside), aside) < 0.1
    assert look.unlike(stretched(rigged, parts, "right_iris", 0.3), rigged.rig.rest_vertices) > 0.2


def rectangle(left: float, top: float, right: float, bottom: float, opacity: float) -> ScenePath:
    corners = np.array([(left, top), (right, top), (right, bottom), (left, bottom)])
    sides = np.roll(corners, -1, axis=0) - corners
    chain = corners[:, None] + np.array([0, 1 / 3, 2 / 3])[:, None] * sides[:, None]
    return ScenePath(points=chain.ravel().tolist(), fill=SolidFill(colour="#c09070", opacity=opacity))


def two_halves(opacity: float) -> Scene:
    """A fore of four rectangles without gaps: two halves side by side, held together above and below."""
    sides = [rectangle(60, 60, 200, 340, opacity), rectangle(200, 60, 340, 340, opacity)]
    bars = [rectangle(60, 40, 360, 80, opacity), rectangle(60, 320, 360, 360, opacity)]
    end = rectangle(320, 60, 360, 340, opacity)
    return Scene(width=400, height=400, canvas="#ffffff", back=[], fore=[*sides, *bars, end], local=[])


def test_halves_that_part_are_torn(landmarks: Landmarks) -> None:
    """Closed form: the right half, 10 px aside, leaves 10 × 240 px between the bars."""
    rigged = rig_scene(two_halves(1.0), landmarks)
    points = rigged.rest.copy()
    points[slice(*rigged.drawing.bounds[1:3]), 0] += 10
    torn = Tears(rigged, (400, 400)).count(points, rigged.rig.rest_vertices)
    assert torn == pytest.approx(10 * 240, rel=0.05)


def test_what_was_translucent_and_stretches_is_not_torn(landmarks: Landmarks) -> None:
    rigged = rig_scene(two_halves(0.8), landmarks)
    turned = rigged.rig.vertices(Pose(articulators={"yaw": 15, "jaw": 1})).vertices
    assert Tears(rigged, (400, 400)).count(frame_points(rigged, turned), turned) == 0


def test_resting_places_are_where_the_mesh_was(rigged: RiggedScene) -> None:
    """Round trip: a pixel at a posed vertex rests at the vertex."""
    rig = rigged.rig
    posed = rig.vertices(Pose(articulators={"yaw": 12, "roll": 10, "jaw": 0.5})).vertices
    places = resting_places(rig, posed, 1.0, (400, 400))
    for vertex in (0, 8, 16, 27, 30, 33):
        column, row = np.floor(posed[vertex]).astype(int)
        assert np.linalg.norm(places[row, column] + 0.5 - rig.rest_vertices[vertex]) < 2


def test_unsplit_curves_leave_the_map_that_split_ones_follow(scene: Scene, landmarks: Landmarks) -> None:
    split, unsplit = (distances_from_map(rig_scene(scene, landmarks, split=on, smooth=False)) for on in (True, False))
    assert split.max() < 1e-6
    assert unsplit.max() > 0.5
