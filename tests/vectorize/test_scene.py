"""Scenes in arrays against their wire model and their SVG text: round trips, closed forms and one golden."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from vectortalker import schema
from vectortalker.scene import (
    NO_PART,
    OPENING_OF_PART,
    PARTS,
    Layer,
    LayeredScene,
    from_wire,
    order_local,
    to_wire,
    with_middle,
)
from vectortalker.svg import number, path_data, to_svg

SVG = "{http://www.w3.org/2000/svg}"


def random_layer(generator: np.random.Generator, n: int, segments: int = 4, local: bool = False) -> Layer:
    part = generator.integers(0, len(PARTS), n) if local else np.full(n, NO_PART)
    return Layer(
        generator.uniform(-20, 120, (n, 3 * segments, 2)).astype(np.float32),
        generator.uniform(0, 1, (n, 3, 4)).astype(np.float32),
        generator.uniform(0, 100, (n, 4)).astype(np.float32),
        generator.integers(0, 2, n).astype(bool),
        part.astype(np.int64),
    )


def random_scene(seed: int, n: int = 5) -> LayeredScene:
    generator = np.random.default_rng(seed)
    layers = [random_layer(generator, n, local=local) for local in (False, False, True)]
    return LayeredScene(100, 80, generator.uniform(0, 1, 3).astype(np.float32), *layers)


@settings(deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_wire_round_trip_is_exact_after_the_first_rounding(seed: int) -> None:
    once = to_wire(random_scene(seed))
    assert to_wire(from_wire(once)) == once


@settings(deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_rounding_moves_no_value_by_more_than_half_a_step(seed: int) -> None:
    scene = random_scene(seed)
    written = from_wire(to_wire(scene))
    assert np.abs(written.back.points - scene.back.points).max() <= 0.005 + 1e-5
    solid = ~scene.fore.gradient
    assert np.abs(written.fore.stops[solid, 0, :3] - scene.fore.stops[solid, 0, :3]).max(initial=0) <= 0.5 / 255 + 1e-6
    assert np.abs(written.fore.stops[solid, 0, 3] - scene.fore.stops[solid, 0, 3]).max(initial=0) <= 0.0005 + 1e-6


def test_local_order_groups_openings_and_keeps_painters_order_within() -> None:
    layer = random_layer(np.random.default_rng(3), 40, local=True)
    ordered = order_local(layer)
    openings = OPENING_OF_PART[ordered.part]
    assert np.all(np.diff(openings) >= 0)
    for opening in range(3):
        expected = layer.points[OPENING_OF_PART[layer.part] == opening]
        assert np.array_equal(ordered.points[openings == opening], expected)


def test_from_wire_refuses_mixed_segment_counts() -> None:
    scene = to_wire(random_scene(0))
    longer = schema.ScenePath(points=[0.0] * 30, fill=schema.SolidFill(colour="#000000"))
    with pytest.raises(ValueError, match=r"\[4, 5\] segments"):
        from_wire(scene.model_copy(update={"fore": [*scene.fore, longer]}))


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (12.5, "12.5"),
        (-3.0, "-3"),
        (0.066, "0.07"),
        (-0.001, "0"),
        (100.0, "100"),
        (1e-9, "0"),
    ],
)
def test_number_is_the_shortest_decimal(value: float, text: str) -> None:
    assert number(value) == text


def test_path_data_closes_the_chain_at_its_first_anchor() -> None:
    assert path_data([0, 0, 1, 0, 2, 0, 3, 1, 2, 2, 1, 2]) == "M0 0C1 0 2 0 3 1 2 2 1 2 0 0Z"


def svg_root(scene: LayeredScene) -> ET.Element:
    triangle = np.array([[0, 0], [10, 0], [20, 0], [30, 10], [20, 20], [10, 20]], np.float64)
    return ET.fromstring(to_svg(to_wire(scene), [triangle, triangle, triangle[:0]], "A & <B>", (50, 40)))


def test_svg_has_the_three_groups_in_painters_order_and_one_path_each() -> None:
    root = svg_root(random_scene(1))
    groups = [child for child in root if child.tag == f"{SVG}g"]
    assert [group.get("id") for group in groups] == ["back", "fore", "local"]
    assert [len(list(group.iter(f"{SVG}path"))) for group in groups] == [5, 5, 5]
    assert root.get("viewBox") == "0 0 100 80"
    assert root.findtext(f"{SVG}title") == "A & <B>"


def test_svg_references_resolve_and_local_paths_are_clipped_by_their_opening() -> None:
    root = svg_root(random_scene(2))
    ids = {element.get("id") for element in root.iter() if element.get("id")}
    used = set(re.findall(r"url\(#([^)]+)\)", ET.tostring(root, encoding="unicode")))
    assert used <= ids
    local = next(group for group in root if group.get("id") == "local")
    for group in local:
        for path in group:
            part = PARTS.index(path.get("data-part"))  # type: ignore[arg-type]  # the test above would fail on None
            opening = ("left_eye", "right_eye", "mouth")[OPENING_OF_PART[part]]
            assert group.get("clip-path") == f"url(#opening-{opening})"


def test_old_gradients_of_two_stops_paint_as_before_with_their_mean_between() -> None:
    two = np.array([[0.2, 0.4, 0.6, 1.0], [0.4, 0.4, 0.0, 0.5]], np.float32)
    np.testing.assert_allclose(with_middle(two), [two[0], [0.3, 0.4, 0.3, 0.75], two[1]], rtol=1e-6)
    ends = [schema.Stop(colour="#000000"), schema.Stop(colour="#ffffff")]
    old = schema.ScenePath(points=[0.0] * 12, fill=schema.LinearFill(start=(0, 0), end=(4, 0), stops=ends))
    scene = from_wire(schema.Scene(width=4, height=4, canvas="#000000", back=[old], fore=[], local=[]))
    np.testing.assert_allclose(scene.back.stops[0, :, 0], [0, 0.5, 1])


def test_svg_spaces_three_stops_evenly() -> None:
    stops = [schema.Stop(colour=colour) for colour in ("#000000", "#ff0000", "#ffffff")]
    path = schema.ScenePath(points=[0.0] * 12, fill=schema.LinearFill(start=(0, 0), end=(4, 0), stops=stops))
    scene = schema.Scene(width=4, height=4, canvas="#000000", back=[path], fore=[], local=[])
    assert re.findall(r'offset="(.*?)" stop-color="(.*?)"', to_svg(scene, [], "Three", (4, 4))) == [
        ("0", "#000000"),
        ("0.5", "#ff0000"),
        ("1", "#ffffff"),
    ]


def test_svg_of_one_solid_and_one_gradient_path_is_the_golden() -> None:
    square = [0.0, 0.0, 10.0, 0.0, 20.0, 0.0, 30.0, 10.0, 20.0, 20.0, 10.0, 20.0]
    stops = [schema.Stop(colour="#000000"), schema.Stop(colour="#ffffff", opacity=0.25)]
    scene = schema.Scene(
        width=40,
        height=20,
        canvas="#808080",
        back=[schema.ScenePath(points=square, fill=schema.SolidFill(colour="#112233", opacity=0.5))],
        fore=[
            schema.ScenePath(
                points=square,
                fill=schema.LinearFill(start=(0, 0), end=(40, 0), stops=stops),
            )
        ],
        local=[],
    )
    d = "M0 0C10 0 20 0 30 10 20 20 10 20 0 0Z"
    assert to_svg(scene, [], "Golden", (40, 20)) == (
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 40 20" width="40" height="20">\n'
        "<title>Golden</title>\n"
        "<desc>Layered vector portrait of 2 paths: back, fore, local. Made with VectorTalker.</desc>\n"
        "<defs>\n"
        '<linearGradient id="g1" gradientUnits="userSpaceOnUse" x1="0" y1="0" x2="40" y2="0">'
        '<stop offset="0" stop-color="#000000"/><stop offset="1" stop-color="#ffffff" stop-opacity="0.25"/>'
        "</linearGradient>\n"
        "</defs>\n"
        '<rect x="-2" y="-1" width="44" height="22" fill="#808080"/>\n'
        f'<g id="back">\n<path fill="#112233" fill-opacity="0.5" d="{d}"/>\n</g>\n'
        f'<g id="fore">\n<path fill="url(#g1)" d="{d}"/>\n</g>\n'
        '<g id="local">\n</g>\n'
        "</svg>\n"
    )
