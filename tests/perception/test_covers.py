"""Lids and the floor of a smile: hidden at rest, in the portrait's colours, and there when the pose needs them."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
import vectortalker_core as core
from vectortalker.decode import Portrait
from vectortalker.interior import smile_floor
from vectortalker.landmarks import detect
from vectortalker.landmarks.wire import to_wire
from vectortalker.lids import lids
from vectortalker.oklab import to_srgb
from vectortalker.rig import build_rig, fit_pins
from vectortalker.schema import Landmarks, Pose, Scene, ScenePath, SolidFill
from vectortalker.vectorize.covers import covers

Sample = Callable[[str], Portrait]
SEGMENTS = 8


def face_of(portrait: Portrait) -> Landmarks:
    return to_wire(detect(portrait.rgb), portrait.width, portrait.height).faces[0].landmarks


def coverage(chain: np.ndarray, portrait: Portrait) -> np.ndarray:
    return core.coverage(np.ascontiguousarray(chain, np.float32), portrait.width, portrait.height)


@pytest.mark.parametrize("name", ["eileen.png", "toon-head.png"])
def test_lids_lie_within_the_eyes_and_stay_when_these_close(sample: Sample, name: str) -> None:
    portrait = sample(name)
    face = face_of(portrait)
    made = covers(face, portrait.rgb, 500, SEGMENTS).fore
    assert len(made) == 4, "skin and a lash line for each eye"
    openings = [coverage(o, portrait) for _, o, _ in core.opening_outlines(np.array(face.points))]
    fill = SolidFill(colour="#000000")
    fore = [ScenePath(points=chain.ravel().astype(float).tolist(), fill=fill) for chain in made.points]
    scene = Scene(width=portrait.width, height=portrait.height, canvas="#ffffff", back=[], fore=fore, local=[])
    rig = build_rig(scene, face)
    shut = rig.vertices(Pose(articulators={"blink_left": 1, "blink_right": 1}))
    assert shut.scale == 1
    moved = rig.moved_points(shut.vertices)
    assert list(moved) == [1, 3], "lash lines come down, lids stay"
    for eye, opening in enumerate(openings[:2]):
        skin, lash = (coverage(made.points[2 * eye + k], portrait) for k in (0, 1))
        for cover in (skin, lash):
            assert (cover * (1 - opening)).sum() < 0.02 * cover.sum(), "what is seen at rest is the eyeball"
        assert skin.sum() > 0.75 * opening.sum(), "what is seen when shut is the lid"
        meeting = rig.openings(shut.vertices)[eye]
        span = np.ptp(meeting, axis=0).max()
        low, high = (moved[2 * eye + 1][:, 1].max(), meeting[:, 1].max())
        assert abs(low - high) < 0.2 * span, "the lash line ends where the lids meet"


def test_lids_have_the_skins_and_the_lines_colours(sample: Sample) -> None:
    portrait = sample("eileen.png")
    skin, line, *_ = lids(face_of(portrait), portrait.rgb)
    assert np.abs(to_srgb(skin.lab) - np.array([252, 238, 224]) / 255).max() < 0.05
    assert to_srgb(line.lab).max() < 0.3


def test_lids_come_up_softly_from_their_upper_edge(sample: Sample) -> None:
    portrait = sample("eileen.png")
    made = covers(face_of(portrait), portrait.rgb, 500, SEGMENTS).fore
    assert made.gradient.tolist() == [True, False, True, False]
    assert (made.stops[0, 0, 3], made.stops[0, -1, 3]) == (0, 1)
    assert made.axis[0, 1] < made.axis[0, 3], "downwards"


@pytest.mark.parametrize("name", ["astronaut.jpg", "mona-lisa.jpg"])
def test_shaded_skin_closes_by_itself(sample: Sample, name: str) -> None:
    portrait = sample(name)
    assert lids(face_of(portrait), portrait.rgb) == []


def test_eyes_beyond_the_picture_get_no_lids() -> None:
    """A flat face whose brows and eyes are cut off by the upper edge."""
    face = fit_pins([(150, -30), (250, -30), (200, 40), (165, 85), (235, 85)])
    assert face is not None
    flat = np.full((200, 400, 3), (240, 200, 170), np.uint8)
    assert lids(face, flat) == []
    assert len(lids(face.model_copy(update={"points": [(x, y + 80) for x, y in face.points]}), flat)) == 4


def test_floor_lies_below_what_a_smile_shows(sample: Sample) -> None:
    portrait = sample("astronaut.jpg")
    points = np.array(face_of(portrait).points)
    (patch,) = smile_floor(points, portrait.rgb)
    assert patch.lab[0] < 0.31
    (floor,) = covers(face_of(portrait), portrait.rgb, 500, SEGMENTS).local.points
    _, mouth, _ = core.opening_outlines(points)[2]
    seen = coverage(floor, portrait) * coverage(mouth, portrait)
    assert seen.sum() < 0.01 * coverage(mouth, portrait).sum()


def test_closed_mouth_has_no_floor(sample: Sample) -> None:
    portrait = sample("mona-lisa.jpg")
    assert smile_floor(np.array(face_of(portrait).points), portrait.rgb) == []


def test_sketch_of_few_paths_spares_none_for_covers(sample: Sample) -> None:
    portrait = sample("eileen.png")
    assert len(covers(face_of(portrait), portrait.rgb, 40, SEGMENTS)) == 0
