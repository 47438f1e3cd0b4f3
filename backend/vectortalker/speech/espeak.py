"""Runs espeak-ng on a text as a process of its own: it is under the GPL and optional, so nothing here links it."""

from __future__ import annotations

import re
import shutil
import subprocess

from vectortalker.errors import VectorTalkerError

MAX_CHARACTERS = 20_000  # ten minutes of the fastest speech
SECONDS_LIMIT = 60
_LANGUAGE = re.compile(r"[A-Za-z]{2,3}(-[A-Za-z0-9]{2,8})*")
_VARIANT = re.compile(r"[A-Za-z0-9]{0,20}")


def espeak(text: str, language: str, arguments: list[str], variant: str = "") -> bytes:
    """What espeak-ng prints when it reads `text` with the voice of `language`, or its `variant` such as f3.

    Raises `unsupported` when espeak-ng is not installed, `bad_option` for an unknown language or variant, or for more
    than MAX_CHARACTERS.
    """
    program = shutil.which("espeak-ng")
    if program is None:
        raise VectorTalkerError(
            "unsupported",
            "espeak-ng is not installed, and reading a text needs it: install it, or use a recording without a text.",
        )
    if len(text) > MAX_CHARACTERS:
        raise VectorTalkerError("bad_option", f"The text has {len(text)} characters; the limit is {MAX_CHARACTERS}.")
    if not _LANGUAGE.fullmatch(language):
        raise VectorTalkerError("bad_option", f"{language!r:.40} is not a language code such as en, de or pt-br.")
    if not _VARIANT.fullmatch(variant):
        raise VectorTalkerError("bad_option", f"{variant!r:.40} is not a voice variant such as f3 or m1.")
    voice = f"{language}+{variant}" if variant else language
    command = [program, *arguments, "-v", voice, "--stdin"]
    try:
        told = subprocess.run(command, input=text.encode(), capture_output=True, timeout=SECONDS_LIMIT, check=False)
    except subprocess.TimeoutExpired as error:
        raise VectorTalkerError("internal", f"espeak-ng took over {SECONDS_LIMIT} s: give a shorter text.") from error
    if told.returncode != 0:
        raise VectorTalkerError("bad_option", f"espeak-ng knows no voice {voice}: see `espeak-ng --voices`.")
    return told.stdout
