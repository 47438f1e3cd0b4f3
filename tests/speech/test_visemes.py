"""Phones become visemes, and visemes mouths, by tables; closures close and neighbours blend."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from vectortalker.speech.coarticulation import (
    CLOSURE_LEAD,
    FPS,
    JAW,
    LOWER,
    PRESS,
    ROUND,
    Blend,
    articulate,
)
from vectortalker.speech.visemes import (
    TARGETS,
    VISEMES,
    Block,
    blocks_of_phones,
    classes_at,
    visemes_of,
)

BLOCKS = st.lists(
    st.tuples(st.sampled_from(VISEMES), st.floats(0.04, 0.4), st.floats(0.5, 1.5)),
    min_size=1,
    max_size=12,
)


def in_a_row(*sounds: tuple[str, float]) -> list[Block]:
    """Blocks of (viseme, seconds), one after the other from 0."""
    ends = np.cumsum([seconds for _, seconds in sounds])
    return [Block(float(end - seconds), seconds, name) for (name, seconds), end in zip(sounds, ends, strict=True)]


def frame_at(seconds: float) -> int:
    return round(seconds * FPS)


@pytest.mark.parametrize(
    ("phone", "names"),
    [
        ("p", ["PP"]),
        ("ˈaɪ", ["aa", "I"]),
        ("oʊ", ["O", "U"]),
        ("tʃ", ["CH"]),
        ("dʒ", ["CH"]),
        ("ts", ["DD", "SS"]),
        ("pf", ["PP", "FF"]),
        ("iː", ["I"]),
        ("ɑ̃", ["aa"]),
        ("tʰ", ["DD"]),
        ("ʲ", []),
        ("", []),
    ],
)
def test_phone_has_the_visemes_of_its_letters(phone: str, names: list[str]) -> None:
    assert visemes_of(phone) == names


def test_diphthong_gives_six_tenths_to_its_first_half() -> None:
    first, second = blocks_of_phones([(1.0, 2.0, "aɪ")])
    assert (first.viseme, second.viseme) == ("aa", "I")
    assert second.start == pytest.approx(1.6)


def test_equal_neighbours_are_one_block_and_diacritics_prolong() -> None:
    blocks = blocks_of_phones([(0.0, 0.1, "t"), (0.1, 0.2, "d"), (0.2, 0.3, "ʲ"), (0.3, 0.4, "")])
    assert [(block.viseme, round(block.duration, 6)) for block in blocks] == [
        ("DD", 0.3),
        ("sil", 0.1),
    ]


def test_time_outside_all_blocks_is_silent() -> None:
    classes = classes_at([Block(0.1, 0.1, "aa")], np.array([0.0, 0.15, 0.25]))
    assert [VISEMES[number] for number in classes] == ["sil", "aa", "sil"]


def test_no_blocks_leave_the_mouth_at_rest() -> None:
    assert not articulate([], 20, Blend()).any()


def test_long_vowel_reaches_its_target() -> None:
    curves = articulate(in_a_row(("sil", 0.5), ("aa", 1.0), ("sil", 0.5)), 100, Blend())
    assert curves[frame_at(1.0)] == pytest.approx(TARGETS[VISEMES.index("aa")], abs=0.05)


def test_mouth_rests_in_a_pause_until_the_sound_is_near() -> None:
    jaw = articulate(in_a_row(("aa", 0.3), ("sil", 1.0), ("aa", 0.3)), 80, Blend())[:, JAW]
    assert jaw[frame_at(0.65) : frame_at(1.1)].max() < 0.1


@pytest.mark.parametrize("consonant", ["DD", "kk", "nn"])
def test_short_consonant_takes_the_colour_of_its_vowels(consonant: str) -> None:
    rounded = articulate(in_a_row(("U", 0.3), (consonant, 0.06), ("U", 0.3)), 33, Blend())
    spread = articulate(in_a_row(("I", 0.3), (consonant, 0.06), ("I", 0.3)), 33, Blend())
    assert rounded[frame_at(0.33), ROUND] > 0.3 > spread[frame_at(0.33), ROUND]


def test_rounding_comes_before_the_rounded_sound() -> None:
    curves = articulate(in_a_row(("sil", 0.3), ("SS", 0.12), ("U", 0.3)), 36, Blend())
    assert curves[frame_at(0.38), ROUND] > 0.4


@pytest.mark.parametrize("seconds", [0.03, 0.06, 0.12])
@pytest.mark.parametrize("vowel", ["aa", "E", "O"])
def test_lips_are_fully_pressed_at_every_p_b_m(vowel: str, seconds: float) -> None:
    curves = articulate(in_a_row((vowel, 0.3), ("PP", seconds), (vowel, 0.3)), 33, Blend())
    assert curves[frame_at(0.3 - CLOSURE_LEAD) : frame_at(0.3) + 1, PRESS].max() == pytest.approx(1, abs=0.02)
    assert curves[frame_at(0.1), PRESS] < 0.05


def test_lips_closed_before_a_pause_do_not_gape_in_it() -> None:
    curves = articulate(in_a_row(("aa", 0.3), ("PP", 0.1), ("sil", 0.5)), 45, Blend())
    parted = (1 - curves[frame_at(0.34) :, PRESS]) * curves[frame_at(0.34) :, JAW]
    assert parted.max() < 0.1


def test_lower_lip_meets_the_teeth_at_f_and_v() -> None:
    curves = articulate(in_a_row(("aa", 0.3), ("FF", 0.1), ("aa", 0.3)), 35, Blend())
    middle = curves[frame_at(0.32)]
    assert middle[LOWER] == pytest.approx(1, abs=0.02)
    assert middle[JAW] == pytest.approx(0.1, abs=0.02)


def test_mouth_opens_faster_than_it_closes() -> None:
    jaw = articulate(in_a_row(("sil", 0.5), ("aa", 0.3), ("sil", 0.7)), 75, Blend())[:, JAW]
    half = jaw.max() / 2
    above = np.flatnonzero(jaw > half)
    assert 0.5 - above[0] / FPS < above[-1] / FPS - 0.8 + 0.1


@given(BLOCKS)
def test_curves_stay_within_their_targets(
    sounds: list[tuple[str, float, float]],
) -> None:
    starts = np.cumsum([0.0, *(duration for _, duration, _ in sounds)])
    blocks = [Block(start, d, name, weight) for start, (name, d, weight) in zip(starts[:-1], sounds, strict=True)]
    curves = articulate(blocks, frame_at(float(starts[-1])) + 1, Blend())
    assert np.isfinite(curves).all()
    assert (curves >= TARGETS.min(axis=0) - 1e-9).all()
    assert (curves <= TARGETS.max(axis=0) + 1e-9).all()
