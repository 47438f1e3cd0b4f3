"""Turns text into the visemes of its words, by the pronunciation rules of espeak-ng."""

from __future__ import annotations

import re

from vectortalker.errors import VectorTalkerError
from vectortalker.speech.espeak import espeak
from vectortalker.speech.visemes import visemes_of

_SWITCH = re.compile(r"\([a-z-]+\)")  # espeak-ng marks words it reads in another language


def words_of(text: str, language: str) -> list[list[str]]:
    """Visemes of each word of `text`; numbers and abbreviations are read out.

    Raises `unsupported` and `bad_option` as `espeak` does, and `bad_option` for a text without sounds.
    """
    told = espeak(text, language, ["-q", "--ipa", "--sep=_"]).decode()
    words = [_word(word) for word in _SWITCH.sub(" ", told).split()]
    words = [word for word in words if word]
    if not words:
        raise VectorTalkerError("bad_option", "The transcript has nothing that can be spoken.")
    return words


def _word(phones: str) -> list[str]:
    """Visemes of phones separated by `_`, equal neighbours once."""
    names: list[str] = []
    for phone in phones.split("_"):
        names += [name for name in visemes_of(phone) if not names or names[-1] != name]
    return names
