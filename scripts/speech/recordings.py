"""Turns recordings of people whose words are known into utterances whose phone times the network finds by itself.

The voice prompts of Debian's packages asterisk-core-sounds-{en,es,fr,ru} and -g722: four speakers, studio recordings,
CC BY-SA and CC BY. Times come from forced alignment by the network of the package, so these are only ever trained on:
embedded training, as recognisers do where nobody has marked the phones.
"""

from __future__ import annotations

import gzip
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from synthesisers import Utterance
from vectortalker.errors import VectorTalkerError
from vectortalker.speech.alignment import align
from vectortalker.speech.audio import RATE, mono_chunks
from vectortalker.speech.features import log_mels, normalised
from vectortalker.speech.network import hear
from vectortalker.speech.transcript import words_of

SOUNDS = Path("/usr/share/asterisk/sounds")
TEXTS = "/usr/share/doc/asterisk-core-sounds-{0}/core-sounds-{0}.txt.gz"
SPEAKERS = {  # language of the texts: folder of the sounds, espeak-ng's voice that reads the texts
    "en": ("en_US_f_Allison", "en-us"),
    "es": ("es_MX_f_Allison", "es-419"),
    "fr": ("fr_CA_f_June", "fr"),
    "ru": ("ru_RU_f_IvrvoiceRU", "ru"),
}
LEAST_SECONDS = 0.5  # some files are empty
BYTES_PER_SECOND = 8000  # of G.722


def recordings() -> Iterator[Utterance]:
    """Prompts that their texts fit. Raises FileNotFoundError without the packages."""
    for language, (folder, voice) in SPEAKERS.items():
        lines = gzip.decompress(Path(TEXTS.format(language)).read_bytes()).decode().splitlines()
        named = [line.split(":", 1) for line in lines if ":" in line and not line.startswith(";") and "[" not in line]
        for name, text in named:
            path = SOUNDS / folder / f"{name.strip()}.g722"
            utterance = _aligned(path, text.strip(), language, voice) if path.exists() else None
            if utterance is not None:
                yield utterance


def _aligned(path: Path, text: str, language: str, voice: str) -> Utterance | None:
    """None for a clip that is too short, or that says something else than its text."""
    if path.stat().st_size < LEAST_SECONDS * BYTES_PER_SECOND:
        return None
    samples = np.concatenate(list(mono_chunks(path)))
    heard = hear(normalised(log_mels([samples])))
    try:
        blocks = align(heard.log_posteriors, words_of(text, voice))
    except VectorTalkerError:
        return None
    return Utterance(f"recording {path.parent.name}", language, text, RATE, samples, blocks)
