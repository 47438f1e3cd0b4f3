"""Makes the corpus: log-mel frames with the viseme and the articulators of each, in one archive a part.

    python scripts/speech/corpus.py OUT_FOLDER [--seed 0]

Needs espeak-ng, flite and (for the part of the held-out synthesiser) festival with the voices of `synthesisers.py`.

Parts: `train`, and, never trained on: `voices` (espeak-ng variants and the flite voice slt), `languages` (Italian,
Hungarian and Greek by espeak-ng), `festival` (a synthesiser of its own, on recorded voices). All but `train` are clean;
`noisy` is `voices` and `festival` spoilt as training speech is.
"""

from __future__ import annotations

import argparse
import random
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import texts
from augment import PAUSES, sped, spoilt, without_speech
from scipy import signal
from synthesisers import FESTIVAL_VOICES, EspeakWish, Utterance, espeak, festival, flite
from vectortalker.speech.audio import RATE
from vectortalker.speech.coarticulation import FPS, Blend, articulate
from vectortalker.speech.features import log_mels
from vectortalker.speech.visemes import VISEMES, Block, blocks_of_phones, classes_at

TRAIN_VOICES = {
    "en": ("en-us", "en-us", "en", "en-GB-scotland", "en-GB-x-rp", "en-US-nyc"), "de": ("de",), "fr": ("fr",),
    "es": ("es", "es-419"), "nl": ("nl",), "pl": ("pl",), "ru": ("ru",), "tr": ("tr",), "sv": ("sv",),
    "cmn": ("cmn-Latn-pinyin",), "hi": ("hi",), "pt": ("pt", "pt-BR"),
}  # fmt: skip
TRAIN_VARIANTS = (
    "", "m1", "m2", "m3", "m4", "m5", "m6", "m7", "f1", "f2", "f3", "f4", "klatt", "klatt2", "klatt4", "klatt6", "adam",
    "Alex", "Alicia", "Annie", "anika", "antonio", "belinda", "benjamin", "boris", "caleb", "david", "edward",
    "grandma", "Hugo", "iven", "john", "marcelo", "max", "Michael", "miguel", "pablo", "quincy", "rob", "shelby",
    "travis", "zac", "Diogo", "Denis", "Lee", "Marco", "Jacky", "aunty", "paul", "victor", "whisper",
)  # fmt: skip
HELD_VARIANTS = ("m8", "f5", "klatt3", "Andy", "linda", "steph", "Gene", "norbert")
HELD_LANGUAGES = ("it", "hu", "el")
TRAIN_FLITE, HELD_FLITE = ("kal16", "awb", "rms"), "slt"
N_ESPEAK_PER_LANGUAGE, N_FLITE_PER_VOICE, N_FLITE_VERSIONS, N_SPEECHLESS = (
    56,
    110,
    2,
    70,
)
N_ESPEAK_ENGLISH = 120
N_HELD = 5  # lines a voice or language of the held-out parts


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("out", type=Path)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--held-only", action="store_true", help="leave out the training part")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    held = {
        "voices": list(_held_voices(random.Random(options.seed + 1))),
        "languages": list(espeak(_wishes(HELD_LANGUAGES, ("", "f2", "m3"), 16, random.Random(options.seed + 2)))),
        "festival": list(_festival(random.Random(options.seed + 3))),
    }
    generator = np.random.default_rng(options.seed + 1)
    for name, utterances in held.items():
        _save(options.out / f"{name}.npz", (_example(item, item.samples, generator) for item in utterances))
    noisy = held["voices"] + held["festival"]
    _save(options.out / "noisy.npz", (_spoilt_example(item, generator) for item in noisy))
    if not options.held_only:
        _save(options.out / "train.npz", _train(options.seed, np.random.default_rng(options.seed)))


def _train(seed: int, generator: np.random.Generator) -> Iterator[dict]:
    source = random.Random(seed)
    for utterance in espeak(_train_wishes(source)):
        yield _spoilt_example(utterance, generator)
    for voice in TRAIN_FLITE:
        for _ in range(N_FLITE_PER_VOICE):
            utterance = flite(voice, texts.line("en", source))
            for _ in range(N_FLITE_VERSIONS):
                yield _spoilt_example(utterance, generator)
    for _ in range(N_SPEECHLESS):
        samples = without_speech(4 * RATE, RATE, generator)
        yield _example(Utterance("none", "none", "", RATE, samples, []), samples, generator)


def _train_wishes(source: random.Random) -> Iterator[EspeakWish]:
    for language, voices in TRAIN_VOICES.items():
        for _ in range(N_ESPEAK_ENGLISH if language == "en" else N_ESPEAK_PER_LANGUAGE):
            yield _wish(
                source.choice(voices),
                texts.line(language, source),
                source.choice(TRAIN_VARIANTS),
                source,
            )


def _held_voices(source: random.Random) -> Iterator[Utterance]:
    yield from espeak(_wishes(("en", "de", "es", "ru"), HELD_VARIANTS, N_HELD, source))
    for _ in range(3 * N_HELD):
        yield flite(HELD_FLITE, texts.line("en", source))


def _festival(source: random.Random) -> Iterator[Utterance]:
    for voice, (language, _, _) in FESTIVAL_VOICES.items():
        yield from festival(voice, [texts.line(language, source) for _ in range(2 * N_HELD)])


def _wishes(
    languages: tuple[str, ...],
    variants: tuple[str, ...],
    n_lines: int,
    source: random.Random,
) -> Iterator[EspeakWish]:
    for language in languages:
        for _ in range(n_lines):
            yield _wish(
                TRAIN_VOICES.get(language, (language,))[0],
                texts.line(language, source),
                source.choice(variants),
                source,
            )


def _wish(voice: str, text: str, variant: str, source: random.Random) -> EspeakWish:
    return EspeakWish(
        voice,
        variant,
        text,
        source.randint(110, 230),
        source.randint(20, 80),
        source.randint(30, 80),
    )


def _spoilt_example(utterance: Utterance, generator: np.random.Generator) -> dict:
    """Another vocal tract, pauses around, then all that spoils a recording."""
    samples, speed = sped(utterance.samples, generator)
    lead, tail = (round(seconds * utterance.rate) for seconds in generator.uniform(*PAUSES, 2))
    padded = np.concatenate([np.zeros(lead), samples, np.zeros(tail)])
    shift = lead / utterance.rate
    phones = [(start / speed + shift, end / speed + shift, name) for start, end, name in utterance.phones]
    moved = replace(utterance, samples=padded, phones=phones)
    return _example(moved, spoilt(padded, utterance.rate, generator), generator)


def _example(utterance: Utterance, samples: np.ndarray, generator: np.random.Generator) -> dict:
    """Frames at 100 Hz, viseme numbers and articulators at FPS, and the blocks they come from."""
    at_rate = signal.resample_poly(samples, RATE, utterance.rate) if utterance.rate != RATE else samples
    dither = 1e-5 * generator.standard_normal(len(at_rate))
    frames = log_mels([(at_rate + dither).astype(np.float32)])
    blocks = [block for block in blocks_of_phones(utterance.phones) if block.duration > 0]
    n_frames = len(frames) // 2
    return {
        "voice": utterance.voice,
        "language": utterance.language,
        "text": utterance.text,
        "frames": frames[: 2 * n_frames].astype(np.float16),
        "classes": classes_at(blocks, np.arange(n_frames) / FPS).astype(np.int8),
        "articulators": articulate(blocks, n_frames, Blend()).astype(np.float16),
        "blocks": blocks,
        "samples": (np.clip(at_rate, -1, 1) * 32767).astype(np.int16),
    }


def _save(path: Path, examples: Iterator[dict]) -> None:
    """One archive of concatenated arrays; `lengths` are frames at FPS. Samples only of the held-out parts."""
    items = list(examples)
    arrays = {key: np.concatenate([item[key] for item in items]) for key in ("frames", "classes", "articulators")}
    if path.stem != "train":
        arrays["samples"] = np.concatenate([item["samples"] for item in items])
        arrays["n_samples"] = np.array([len(item["samples"]) for item in items])
    lengths = np.array([len(item["classes"]) for item in items])
    for key in ("voice", "language", "text"):
        arrays[key] = np.array([item[key] for item in items])
    np.savez(path, lengths=lengths, blocks=_block_table(items), **arrays)


def _block_table(items: list[dict]) -> np.ndarray:
    """Rows (example, start, duration) with the viseme's number: float [n, 4]."""

    def row(index: int, block: Block) -> tuple[float, ...]:
        return index, block.start, block.duration, VISEMES.index(block.viseme)

    return np.array(
        [row(index, block) for index, item in enumerate(items) for block in item["blocks"]],
        np.float32,
    )


if __name__ == "__main__":
    main()
