"""Turns phones in IPA into visemes (Oculus names), and visemes into targets of the mouth's articulators."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

VISEMES = ("sil", "PP", "FF", "TH", "DD", "kk", "CH", "SS", "nn", "RR", "aa", "E", "I", "O", "U")
SILENCE = VISEMES.index("sil")
CHANNELS = ("jaw", "width", "round", "upper_raise", "lower_raise", "press", "tongue_tip")

# Own choice, opened up from photographs of speakers; jaw is 1 at the widest vowel of normal speech.
_TARGETS = {
    "sil": (0.00, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    "PP": (0.05, 0.0, 0.1, 0.0, 0.0, 1.0, 0.0),
    "FF": (0.10, 0.1, 0.0, 0.3, 1.0, 0.0, 0.0),
    "TH": (0.25, 0.1, 0.0, 0.2, 0.0, 0.0, 1.0),
    "DD": (0.25, 0.1, 0.0, 0.2, 0.0, 0.0, 0.8),
    "kk": (0.25, 0.1, 0.0, 0.2, 0.0, 0.0, 0.0),
    "CH": (0.20, -0.2, 0.6, 0.4, 0.3, 0.0, 0.3),
    "SS": (0.15, 0.3, 0.0, 0.3, 0.3, 0.0, 0.5),
    "nn": (0.30, 0.1, 0.0, 0.2, 0.0, 0.0, 0.9),
    "RR": (0.35, -0.1, 0.4, 0.2, 0.1, 0.0, 0.3),
    "aa": (1.00, 0.1, 0.0, 0.3, 0.3, 0.0, 0.0),
    "E": (0.70, 0.4, 0.0, 0.3, 0.2, 0.0, 0.0),
    "I": (0.40, 0.7, 0.0, 0.3, 0.2, 0.0, 0.2),
    "O": (0.70, -0.4, 0.7, 0.1, 0.1, 0.0, 0.0),
    "U": (0.30, -0.7, 1.0, 0.1, 0.1, 0.0, 0.0),
}
TARGETS: NDArray[np.float64] = np.array([_TARGETS[name] for name in VISEMES])  # [15, 7]

_LETTERS = {
    "PP": "pbmɓʙ",
    "FF": "fvɱʋɸβ",
    "TH": "θð",
    "DD": "tdʈɖɗɾɽ",
    "kk": "kgɡŋhɦxɣχħʕçʝqɢɴʁʀʔcɟɰ",
    "CH": "ʃʒɕʑʂʐɧ",
    "SS": "szɬɮ",
    "nn": "nlɲɳɫʎɭʟɺ",
    "RR": "rɹɻɚɝɜ",
    "aa": "aɑʌæɐɶ",
    "E": "eɛəɘɤɞ",
    "I": "iɪɨɯjᵻ",
    "O": "oɔɒøœɵ",
    "U": "uʊyʏʉwɥʍ",
}
_VISEME_OF = {letter: name for name, letters in _LETTERS.items() for letter in letters}
_STOPS, _SIBILANTS = "td", "ʃʒɕʑʂʐ"
FIRST_SHARE = 0.6  # of a diphthong's or affricate's time goes to its first half


@dataclass(frozen=True)
class Block:
    """A viseme held over a time, seconds. `weight` scales how far the jaw opens (1: as in the table)."""

    start: float
    duration: float
    viseme: str
    weight: float = 1.0

    @property
    def end(self) -> float:
        return self.start + self.duration


def visemes_of(phone: str) -> list[str]:
    """Visemes of one phone in IPA, two for a diphthong or an affricate of two places; none for a bare diacritic.

    Stress, length, tone and secondary articulation do not show on the lips and are skipped.
    """
    letters = [letter for letter in unicodedata.normalize("NFD", phone) if letter in _VISEME_OF]
    names: list[str] = []
    for letter, following in zip(letters, [*letters[1:], ""], strict=False):
        is_affricate_stop = letter in _STOPS and following and following in _SIBILANTS
        name = "CH" if is_affricate_stop else _VISEME_OF[letter]
        if not names or names[-1] != name:
            names.append(name)
    return names


def blocks_of_phones(phones: Iterable[tuple[float, float, str]]) -> list[Block]:
    """Blocks of timed phones (start, end, IPA; empty IPA: a pause); equal neighbours become one.

    A phone that is only a diacritic, or not known, prolongs the one before it.
    """
    blocks: list[Block] = []
    for start, end, phone in phones:
        held = blocks[-1].viseme if phone and blocks else "sil"
        names = visemes_of(phone) or [held]
        cuts = [start, *(start + (end - start) * share for share in _shares(len(names))), end]
        for name, begin, finish in zip(names, cuts, cuts[1:], strict=False):
            if finish <= begin:
                continue
            if blocks and blocks[-1].viseme == name:
                blocks[-1] = Block(blocks[-1].start, finish - blocks[-1].start, name)
            else:
                blocks.append(Block(begin, finish - begin, name))
    return blocks


def cut(blocks: list[Block], start: float, end: float) -> list[Block]:
    """What of the blocks lies between two times, seconds."""
    spans = [(max(block.start, start), min(block.end, end), block) for block in blocks]
    return [replace(block, start=first, duration=last - first) for first, last, block in spans if last > first]


def classes_at(blocks: list[Block], times: NDArray[np.float64]) -> NDArray[np.int64]:
    """Viseme number at each time; silence where there is no block."""
    if not blocks:
        return np.full(len(times), SILENCE)
    starts = np.array([block.start for block in blocks])
    ends = np.array([block.end for block in blocks])
    numbers = np.array([VISEMES.index(block.viseme) for block in blocks])
    index = np.searchsorted(starts, times, side="right") - 1
    inside = (index >= 0) & (times < ends[index])
    return np.where(inside, numbers[index], SILENCE)


def _shares(n_parts: int) -> list[float]:
    """Inner cuts of a phone of `n_parts` visemes."""
    return [FIRST_SHARE] if n_parts == 2 else [part / n_parts for part in range(1, n_parts)]
