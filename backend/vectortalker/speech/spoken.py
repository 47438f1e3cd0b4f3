"""Turns text into a recording, spoken by espeak-ng."""

from __future__ import annotations

import tempfile
from pathlib import Path

from vectortalker.speech.espeak import espeak
from vectortalker.speech.transcript import words_of


def speak(text: str, language: str, variant: str, words_per_minute: int, pitch: int) -> bytes:
    """A WAV file of 22,050 Hz, mono; `pitch` is within 0 and 99.

    Raises `unsupported` and `bad_option` as `espeak` and `words_of` do.
    """
    words_of(text, language)  # a text without sounds is refused, rather than spoken as a click
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "spoken.wav"  # a file, for the header that espeak-ng streams does not tell the length
        espeak(text, language, ["-s", str(words_per_minute), "-p", str(pitch), "-w", str(path)], variant)
        return path.read_bytes()
