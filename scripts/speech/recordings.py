"""Recordings of people whose words are known: the voice prompts of asterisk-core-sounds.

Debian's packages asterisk-core-sounds-{en,es,fr,ru} and -g722: four speakers, studio recordings, CC BY-SA and CC BY.
"""

from __future__ import annotations

import gzip
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from marking import marked
from pronunciation import AMERICAN
from synthesisers import Utterance
from vectortalker.speech.audio import mono_chunks

SOUNDS = Path("/usr/share/asterisk/sounds")
TEXTS = "/usr/share/doc/asterisk-core-sounds-{0}/core-sounds-{0}.txt.gz"
SPEAKERS = {  # language of the texts: folder of the sounds, accent
    "en": ("en_US_f_Allison", AMERICAN),
    "es": ("es_MX_f_Allison", "es-419"),
    "fr": ("fr_CA_f_June", "fr"),
    "ru": ("ru_RU_f_IvrvoiceRU", "ru"),
}
LEAST_SECONDS = 0.5  # some files are empty
BYTES_PER_SECOND = 8000  # of G.722


def recordings(language: str) -> Iterator[Utterance]:
    """Prompts that their texts fit. Raises FileNotFoundError without the packages."""
    folder, accent = SPEAKERS[language]
    lines = gzip.decompress(Path(TEXTS.format(language)).read_bytes()).decode().splitlines()
    named = [line.split(":", 1) for line in lines if ":" in line and not line.startswith(";") and "[" not in line]
    texts = {SOUNDS / folder / f"{name.strip()}.g722": text.strip() for name, text in named}
    kept = {path: text for path, text in texts.items() if any(map(str.isalpha, text)) and _is_spoken(path)}
    sounds = (np.concatenate(list(mono_chunks(path))) for path in kept)
    yield from marked(f"recording {folder}", accent, list(kept.values()), sounds)


def _is_spoken(path: Path) -> bool:
    return path.exists() and path.stat().st_size >= LEAST_SECONDS * BYTES_PER_SECOND
