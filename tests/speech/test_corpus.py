"""The training corpus' truth: what the scripts correct in a synthesiser's own account of its phones."""

from __future__ import annotations

import shutil
import sys
from pathlib import Path

import numpy as np
import pytest
from vectortalker.speech.visemes import Block

SCRIPTS = Path(__file__).parents[2] / "scripts" / "speech"
RATE = 1000


@pytest.fixture
def synthesisers(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.syspath_prepend(str(SCRIPTS))
    yield __import__("synthesisers")
    sys.modules.pop("synthesisers")


def voiced(gap: tuple[int, int]) -> np.ndarray:
    """A second of ±0.5, silent within `gap` (milliseconds)."""
    samples = np.where(np.arange(RATE) % 2, 0.5, -0.5)
    samples[slice(*gap)] = 0.0
    return samples


def test_silent_closure_belongs_to_the_stop(synthesisers) -> None:
    phones = [(0.0, 0.5, "a"), (0.5, 0.6, "p"), (0.6, 1.0, "a")]
    corrected = synthesisers.with_closures(phones, voiced((440, 500)), RATE)
    assert [start for start, _, _ in corrected] == pytest.approx([0.0, 0.44, 0.6], abs=0.002)
    assert [end for _, end, _ in corrected] == pytest.approx([0.44, 0.6, 1.0], abs=0.002)


def test_pause_is_not_a_closure(synthesisers) -> None:
    phones = [(0.0, 0.4, "a"), (0.4, 0.5, ""), (0.5, 1.0, "p")]
    assert synthesisers.with_closures(phones, voiced((400, 500)), RATE) == phones


def test_voiced_sounds_stay_where_they_are(synthesisers) -> None:
    phones = [(0.0, 0.5, "a"), (0.5, 1.0, "m")]
    assert synthesisers.with_closures(phones, voiced((0, 0)), RATE) == phones


def test_spoilt_blocks_are_sped_up_and_lie_between_two_pauses(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(SCRIPTS))
    corpus = __import__("corpus")
    spoken = [Block(0.0, 0.2, "sil"), Block(0.2, 0.4, "aa"), Block(0.6, 0.2, "PP"), Block(0.8, 0.1, "sil")]
    moved = corpus._moved(spoken, speed=2.0, lead=0.5, duration=1.5)
    assert [block.viseme for block in moved] == ["sil", "aa", "PP", "sil"]
    assert [block.start for block in moved] == pytest.approx([0.0, 0.6, 0.8, 0.9])
    assert moved[-1].end == pytest.approx(1.5)


def test_quotations_are_whole_sentences_without_authors_and_figures(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.syspath_prepend(str(SCRIPTS))
    texts = __import__("texts")
    (tmp_path / "wise").write_text(
        "A city is a large community\nwhere people are lonesome together.\n\t\t-- Herbert Prochnow\n%\n"
        "It took 25 years to become an overnight success. Nothing is so firmly believed as what we least know.\n%\n"
        "Ask IBM what they think of it all, they will answer.\n%\nToo short.\n"
    )
    monkeypatch.setattr(texts, "QUOTATIONS", tmp_path)
    monkeypatch.setitem(texts.COLLECTIONS, "xx", ("wise",))
    assert texts._quotations("xx") == [
        "A city is a large community where people are lonesome together.",
        "Nothing is so firmly believed as what we least know.",
    ]


def test_american_words_are_visemes_of_festivals_phones(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(SCRIPTS))
    pronunciation = __import__("pronunciation")
    assert pronunciation._visemes("p ih t er") == ["PP", "I", "DD", "RR"]
    assert pronunciation._visemes("s aa z z") == ["SS", "aa", "SS"]


@pytest.mark.skipif(shutil.which("espeak-ng") is None, reason="needs espeak-ng")
def test_speech_too_short_for_its_words_is_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(SCRIPTS))
    marking = __import__("marking")
    tone = 0.3 * np.sin(np.arange(32_000) / 5).astype(np.float32)
    both = marking.marked("nobody", "de", ["Guten Morgen, lieber Peter.", "Ja."], [tone[:3200], tone])
    assert [utterance.text for utterance in both] == ["Ja."]
