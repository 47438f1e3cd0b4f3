"""Turns a language into lines to speak: its sentences, numbers, and invented words that sound like its own."""

from __future__ import annotations

import json
import random
import re
from collections import defaultdict
from functools import cache
from pathlib import Path

SENTENCES = Path(__file__).with_name("sentences.json")
SENTENCE_SHARE, NUMBER_SHARE = 0.45, 0.15  # the rest are invented words, whose phones come in orders no sentence has
DICTIONARIES = Path("/usr/share/dict")  # Debian's lists of words
WORD_LISTS = {
    "en": "american-english", "de": "ngerman", "fr": "french", "es": "spanish", "nl": "dutch", "pl": "polish",
    "pt": "portuguese", "ca": "catalan",
}  # fmt: skip
QUOTATIONS = Path("/usr/share/games/fortunes")  # Debian's collections of quotations
COLLECTIONS = {
    "en": ("people", "literature", "science", "wisdom", "love", "politics", "miscellaneous", "sports", "education"),
    "de": ("de/zitate", "de/sprichworte", "de/sprueche"),
    "es": ("es/proverbios.fortunes", "es/famosos.fortunes", "es/sabiduria.fortunes"),
}
QUOTATION_LENGTH = (25, 110)  # letters
QUOTATION_SHARE = 0.5
DICTIONARY_LENGTH = 14  # letters
DICTIONARY_SHARE = 0.6  # of a line's words; the rest are common ones, of sentences
_PLAIN = re.compile(r"[¿¡]?\w(?:[^\W\d_A-Z]|(?<=\W)[A-Z]|[ ,;:'-])*[.!?]")  # capitals only at words' heads
ORDER = 2  # letters of context from which an invented word goes on
WORD_LENGTH = (2, 11)  # letters


def line(language: str, random_source: random.Random) -> str:
    """A line of about 3 to 6 seconds in `language`, a key of `sentences.json`."""
    sentences = _sentences()[language]
    kind = random_source.random()
    if kind < SENTENCE_SHARE or language == "cmn":  # Pinyin has no words to invent
        return random_source.choice(sentences)
    if kind < SENTENCE_SHARE + NUMBER_SHARE:
        return ", ".join(str(random_source.randrange(10**n)) for n in (2, 3, 4))
    words = [_invented(language, random_source) for _ in range(random_source.randint(6, 10))]
    return " ".join(words).capitalize() + "."


def varied_line(language: str, random_source: random.Random) -> str:
    """A sentence somebody has written, or words as a dictionary has them, or, where there are neither, as `line`."""
    if language in COLLECTIONS and random_source.random() < QUOTATION_SHARE:
        return random_source.choice(_quotations(language))
    if language not in WORD_LISTS or random_source.random() < SENTENCE_SHARE:
        return line(language, random_source)
    rare, common = _dictionary(language), " ".join(_sentences()[language]).split()
    words = [
        random_source.choice(rare if random_source.random() < DICTIONARY_SHARE else common).strip(",.?!")
        for _ in range(random_source.randint(6, 9))
    ]
    return " ".join(words).capitalize() + "."


def held_sentence(language: str, random_source: random.Random) -> str:
    """A sentence that no voice is trained on, of words that all voices read alike."""
    return random_source.choice(_sentences()[f"{language} held"])


@cache
def _sentences() -> dict[str, list[str]]:
    return json.loads(SENTENCES.read_text(encoding="utf-8"))


@cache
def _dictionary(language: str) -> list[str]:
    """Words without abbreviations. Raises FileNotFoundError without Debian's list."""
    words = (DICTIONARIES / WORD_LISTS[language]).read_text(encoding="utf-8").split()
    return [word for word in words if word.isalpha() and word[1:].islower() and len(word) <= DICTIONARY_LENGTH]


@cache
def _quotations(language: str) -> list[str]:
    """Sentences without figures, abbreviations and brackets. Raises FileNotFoundError without Debian's collections."""
    text = "\n%\n".join((QUOTATIONS / name).read_text(encoding="utf-8") for name in COLLECTIONS[language])
    spoken = re.sub(r"^\s*--.*$", "%", text, flags=re.MULTILINE)  # names of authors
    sentences = re.findall(r"(?:^|(?<=[.!?%])\s)([A-ZÄÖÜÁÉÍÓÚ¿¡][^.!?%]*[.!?])", spoken)
    joined = [" ".join(sentence.split()) for sentence in sentences]
    least, most = QUOTATION_LENGTH
    return [one for one in joined if least <= len(one) <= most and _PLAIN.fullmatch(one)]


def _invented(language: str, random_source: random.Random) -> str:
    table = _followers(language)
    while True:
        word = ""
        while not word.endswith(" ") and len(word) <= WORD_LENGTH[1]:
            word += random_source.choice(table[(" " * ORDER + word)[-ORDER:]])
        if WORD_LENGTH[0] <= len(word.strip()) and word.endswith(" "):
            return word.strip()


@cache
def _followers(language: str) -> dict[str, list[str]]:
    """Letters that follow each pair of letters in the language's sentences, as often as they do."""
    table = defaultdict(list)
    for sentence in _sentences()[language]:
        letters = "".join(letter if letter.isalpha() or letter == "'" else " " for letter in sentence.lower())
        for word in letters.split():
            padded = " " * ORDER + word + " "
            for index in range(ORDER, len(padded)):
                table[padded[index - ORDER : index]].append(padded[index])
    return dict(table)
