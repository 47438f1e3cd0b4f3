"""Turns text into the visemes of its words, by the pronunciation rules of espeak-ng, run as a process of its own."""

from __future__ import annotations

import re
import shutil
import subprocess

from vectortalker.errors import VectorTalkerError
from vectortalker.speech.visemes import visemes_of

MAX_CHARACTERS = 20_000  # ten minutes of the fastest speech
SECONDS_LIMIT = 60
_LANGUAGE = re.compile(r"[A-Za-z]{2,3}(-[A-Za-z0-9]{2,8})*")
_SWITCH = re.compile(r"\([a-z-]+\)")  # espeak-ng marks words it reads in another language


def words_of(text: str, language: str) -> list[list[str]]:
    """Visemes of each word of `text`; numbers and abbreviations are read out.

    Raises `unsupported` when espeak-ng is not installed, `bad_option` for an unknown language or a text without sounds.
    """
    program = shutil.which("espeak-ng")
    if program is None:
        raise VectorTalkerError(
            "unsupported",
            "espeak-ng is not installed, and a transcript needs it: install it, or leave the transcript out.",
        )
    if len(text) > MAX_CHARACTERS:
        raise VectorTalkerError(
            "bad_option", f"The transcript has {len(text)} characters; the limit is {MAX_CHARACTERS}."
        )
    if not _LANGUAGE.fullmatch(language):
        raise VectorTalkerError("bad_option", f"{language!r} is not a language code such as en, de or pt-br.")
    command = [program, "-q", "--ipa", "--sep=_", "-v", language, "--stdin"]
    try:
        told = subprocess.run(command, input=text.encode(), capture_output=True, timeout=SECONDS_LIMIT, check=False)
    except subprocess.TimeoutExpired as error:
        raise VectorTalkerError("internal", f"espeak-ng took over {SECONDS_LIMIT} s.") from error
    if told.returncode != 0:
        raise VectorTalkerError("bad_option", f"espeak-ng knows no language {language}: see `espeak-ng --voices`.")
    words = [_word(word) for word in _SWITCH.sub(" ", told.stdout.decode()).split()]
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
