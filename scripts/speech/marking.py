"""Finds the phones' times in speech whose words are known, by the network of the package.

Embedded training, as recognisers do where nobody has marked the phones: such speech is only ever trained on, never
scored.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np
from pronunciation import pronounced
from synthesisers import Utterance
from vectortalker.errors import VectorTalkerError
from vectortalker.speech.alignment import align
from vectortalker.speech.audio import RATE
from vectortalker.speech.features import log_mels, normalised
from vectortalker.speech.network import hear
from vectortalker.speech.vocal_tract import fitted


def marked(speaker: str, accent: str, texts: list[str], sounds: Iterable[np.ndarray]) -> Iterator[Utterance]:
    """`texts` as `speaker` says them in `sounds`, [n] each at RATE; sounds that say something else are left out."""
    for text, samples, words in zip(texts, sounds, pronounced(texts, accent), strict=True):
        heard = hear(fitted(normalised(log_mels([samples]))))
        try:
            blocks = align(heard.log_posteriors, heard.edges, words)
        except VectorTalkerError:
            continue
        yield Utterance(speaker, accent, text, RATE, samples, blocks)
