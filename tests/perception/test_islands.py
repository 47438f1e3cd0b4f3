"""Skin and islands in it, at the picture's edge and beyond."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from vectortalker.landmarks.islands import SIDE, cheeks, island, square_at
from vectortalker.oklab import to_oklab
from vectortalker.rig import fit_pins

FACE = fit_pins([(150, 160), (250, 160), (200, 220), (165, 270), (235, 270)])
Y, X = np.mgrid[:SIDE, :SIDE]


@pytest.mark.parametrize("shift", [(-900, 0), (900, 0), (0, -900), (0, 900)])
def test_cheeks_beyond_the_picture_have_no_colour(shift: tuple[int, int]) -> None:
    assert FACE is not None
    assert cheeks(np.zeros((400, 400, 3), np.uint8), np.array(FACE.points) + shift).shape == (0, 3)


@given(column=st.integers(0, SIDE - 1), row=st.integers(0, SIDE - 1), turn=st.floats(-3, 3))
@settings(max_examples=30, deadline=None)
def test_square_names_the_place_that_it_reads(column: int, row: int, turn: float) -> None:
    """Round trip: in a picture whose colours slope, a pixel has the colour of the place it is said to lie at."""
    assert FACE is not None
    rows, columns = np.mgrid[:400, :400]
    picture = np.stack([columns // 2, rows // 2, np.full((400, 400), 90)], axis=2).astype(np.uint8)
    rotation = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    square = square_at(picture, (np.array(FACE.points) - 200) @ rotation, np.array([200.0, 200.0]), 0.9)
    x, y = square.to_portrait(np.array([column, row], float))
    there = to_oklab(np.array([[x / 2, y / 2, 90]]) / 255)[0]
    assert np.linalg.norm(square.lab[row, column] - there) < 0.01


def test_island_is_the_part_nearest_to_the_middle_without_its_strokes_and_holes() -> None:
    disc = np.hypot(X - 80, Y - 80) < 20
    picture = disc & ~(np.hypot(X - 80, Y - 80) < 8) | (np.hypot(X - 30, Y - 80) < 20) | (abs(Y - 80) < 2)
    found = island(picture)
    assert found is not None
    assert found[80, 80] and not found[80, 30]
    assert abs(int(found.sum()) - int(disc.sum())) < 0.1 * disc.sum()


def test_what_touches_the_edge_is_no_island() -> None:
    assert island(np.abs(X - 80) < 20) is None
    assert island(np.zeros((SIDE, SIDE), bool)) is None
