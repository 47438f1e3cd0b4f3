"""Turns lines of text into the visemes of their words, as the speakers of an accent say them."""

from __future__ import annotations

import subprocess
import tempfile

from phone_sets import RADIO, ipa
from vectortalker.speech.transcript import words_of
from vectortalker.speech.visemes import visemes_of

AMERICAN = "en-us"
_DUMP = """(define (sounds word) (mapcar (lambda (syllable) (mapcar (lambda (phone) (format t "%s " (item.name phone)))
  (item.daughters syllable))) (item.daughters (item.relation word 'SylStructure))) (format t "|"))
(define (pronounce utt) (Initialize utt) (Text utt) (Token_POS utt) (Token utt) (POS utt) (Phrasify utt) (Word utt)
  (Pauses utt) (Intonation utt) (PostLex utt) (mapcar sounds (utt.relation.items utt 'Word)) (format t "|\\n"))
(voice_kal_diphone)
"""


def pronounced(texts: list[str], accent: str) -> list[list[list[str]]]:
    """Visemes of the words of each text. American by Festival's lexicon, others by espeak-ng's rules for `accent`."""
    if accent == AMERICAN:
        return _american(texts)
    return [words_of(text, accent) for text in texts]


def _american(texts: list[str]) -> list[list[list[str]]]:
    with tempfile.NamedTemporaryFile("w", suffix=".scm", encoding="ascii", errors="replace") as script:
        script.write(_DUMP)
        for text in texts:
            spoken = text.replace('"', " ").replace("\\", " ")
            script.write(f'(pronounce (Utterance Text "{spoken}"))\n')
        script.flush()
        told = subprocess.run(["festival", "-b", script.name], check=True, capture_output=True, text=True).stdout
    return [[_visemes(word) for word in row.split("|") if word.strip()] for row in told.splitlines() if "|" in row]


def _visemes(phones: str) -> list[str]:
    """Visemes of phones separated by spaces, equal neighbours once."""
    names: list[str] = []
    for phone in phones.split():
        names += [name for name in visemes_of(ipa(phone, RADIO)) if not names or names[-1] != name]
    return names
