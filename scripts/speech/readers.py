"""Voices made of recordings by programs that do not tell the times of their phones: RHVoice's and SVOX Pico's.

RHVoice's `slt`, and in all likelihood its Scot `alan`, are flite's held-out `slt` and `awb` and so are not here.
"""

from __future__ import annotations

import subprocess
import tempfile
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path

import numpy as np
from marking import marked
from pronunciation import AMERICAN
from synthesisers import Utterance
from vectortalker.speech.audio import mono_chunks

RHVOICE = {"bdl": ("en", AMERICAN), "clb": ("en", AMERICAN)}  # language of the lines, accent
PICO = {
    "en-US": ("en", AMERICAN), "en-GB": ("en", "en-gb"), "de-DE": ("de", "de"), "es-ES": ("es", "es"),
    "fr-FR": ("fr", "fr"),
}  # fmt: skip
READERS = RHVOICE | PICO
N_PROCESSES = 2


def read(voice: str, texts: list[str]) -> Iterator[Utterance]:
    """`texts` read by one of READERS, phones' times found by the network."""
    with ThreadPoolExecutor(N_PROCESSES) as pool:
        yield from marked(f"reader {voice}", READERS[voice][1], texts, pool.map(partial(_spoken, voice), texts))


def _spoken(voice: str, text: str) -> np.ndarray:
    with tempfile.NamedTemporaryFile(suffix=".wav") as file:
        if voice in RHVOICE:
            subprocess.run(["RHVoice-test", "-p", voice, "-o", file.name], input=text.encode(), check=True)
        else:
            subprocess.run(["pico2wave", "-l", voice, "-w", file.name, "--", text], check=True)
        return np.concatenate(list(mono_chunks(Path(file.name))))
