"""Makes the corpus: log-mel frames with the viseme and the articulators of each, in one archive a part.

    python scripts/speech/corpus.py OUT_FOLDER [--seed 0]

Needs espeak-ng, flite, festival with the voices of `synthesisers.py`, the readers of `readers.py`, the word lists and
quotations of `texts.py`, and the prompts of `recordings.py`. Phones of readers and prompts are found by the network of
the package (`marking.py`).

Parts: `train-…`, and, never trained on: `synthesiser` (flite, a program and speakers of its own), `voices` (espeak-ng
variants, and Festival voices; Finnish, Czech and English by other voices are trained on), `languages` (Italian,
Hungarian and Greek by espeak-ng). `noisy` is `synthesiser` and `voices` spoilt as training speech is. `tuning` has
other lines by training voices: constants of the decoder are set on it.
"""

from __future__ import annotations

import argparse
import random
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np
import texts
from augment import PAUSES, sped, spoilt, without_speech
from readers import READERS, read
from recordings import SPEAKERS, recordings
from scipy import signal
from synthesisers import FESTIVAL_VOICES, EspeakWish, Utterance, espeak, festival, flite
from vectortalker.speech.audio import RATE
from vectortalker.speech.coarticulation import FPS, Blend, articulate
from vectortalker.speech.features import log_mels
from vectortalker.speech.visemes import VISEMES, Block, classes_at

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
TRAIN_FESTIVAL = (
    "kal_diphone", "ked_diphone", "upc_ca_ona_hts", "hy_fi_mv_diphone", "czech_dita", "czech_krb", "czech_ph",
    "hindi_NSK_diphone", "msu_ru_nsh_clunits",
)  # fmt: skip
HELD_FESTIVAL = ("cmu_us_slt_arctic_hts", "lp_diphone", "suo_fi_lj_diphone", "czech_machac")
FLITE_VOICES = ("awb", "rms", "slt")  # kal is Festival's
N_ESPEAK, N_ESPEAK_ENGLISH = 200, 800  # lines a language
N_FESTIVAL, N_FESTIVAL_ENGLISH = 180, 800  # lines a voice
N_READ, N_READ_ENGLISH = 200, 600  # lines a voice
SPOILT_SHARE = 0.5  # of training lines
N_SPEECHLESS = 160
FOUND = ("train-reader-", "train-recordings-")  # archives whose phones' times are found by a network
N_HELD = 5  # lines a voice or language of the held-out parts


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("out", type=Path)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--held-only", action="store_true", help="leave out the training part")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    held = {
        "synthesiser": list(_flite(random.Random(options.seed + 1))),
        "voices": list(_held_voices(random.Random(options.seed + 2))),
        "languages": list(espeak(_wishes(HELD_LANGUAGES, ("", "f2", "m3"), 16, random.Random(options.seed + 3)))),
    }
    generator = np.random.default_rng(options.seed + 1)
    for name, utterances in held.items():
        _save(options.out / f"{name}.npz", (_example(item, item.samples, generator) for item in utterances))
    noisy = held["synthesiser"] + held["voices"]
    _save(options.out / "noisy.npz", (_spoilt_example(item, generator) for item in noisy))
    tuning = _tuning(random.Random(options.seed + 4))
    _save(options.out / "tuning.npz", (_example(item, item.samples, generator) for item in tuning))
    if not options.held_only:
        _save_train(options.out, options.seed)
        _print_lengths([*options.out.glob("train-*.npz")])


def _save_train(out: Path, seed: int) -> None:
    """One archive for each source of speech, seeded by its name; those that an earlier run has made are kept."""
    sources: dict[str, Callable[[random.Random], Iterable[Utterance]]] = {
        "espeak": lambda source: espeak(_train_wishes(source)),
        **{voice: partial(_festival, voice) for voice in TRAIN_FESTIVAL},
        **{f"reader-{voice}": partial(_read, voice) for voice in READERS},
        **{f"recordings-{language}": partial(_recorded, language) for language in SPEAKERS},
        "speechless": lambda source: _speechless(seed),
    }
    for name, speak in sources.items():
        path = out / f"train-{name}.npz"
        if not path.exists():
            source, generator = random.Random(f"{seed} {name}"), np.random.default_rng([seed, *name.encode()])
            _save(path, (_train_example(utterance, source, generator) for utterance in speak(source)))
            print(path.name, flush=True)


def _train_example(utterance: Utterance, source: random.Random, generator: np.random.Generator) -> dict:
    if source.random() < SPOILT_SHARE and utterance.blocks:
        return _spoilt_example(utterance, generator)
    return _example(utterance, utterance.samples, generator)


def _speechless(seed: int) -> Iterator[Utterance]:
    generator = np.random.default_rng(seed)
    for _ in range(N_SPEECHLESS):
        yield Utterance("none", "none", "", RATE, without_speech(4 * RATE, RATE, generator), [])


def _train_wishes(source: random.Random) -> Iterator[EspeakWish]:
    for language, voices in TRAIN_VOICES.items():
        for _ in range(N_ESPEAK_ENGLISH if language == "en" else N_ESPEAK):
            text = texts.varied_line(language, source)
            yield _wish(source.choice(voices), text, source.choice(TRAIN_VARIANTS), source)


def _festival(voice: str, source: random.Random) -> list[Utterance]:
    language = FESTIVAL_VOICES[voice][0]
    n_lines = N_FESTIVAL_ENGLISH if language == "en" else N_FESTIVAL
    return festival(voice, [texts.varied_line(language, source) for _ in range(n_lines)])


def _read(voice: str, source: random.Random) -> Iterator[Utterance]:
    language = READERS[voice][0]
    n_lines = N_READ_ENGLISH if language == "en" else N_READ
    return read(voice, [texts.varied_line(language, source) for _ in range(n_lines)])


def _recorded(language: str, source: random.Random) -> Iterator[Utterance]:
    """The prompts as they are: nothing is drawn."""
    return recordings(language)


def _tuning(source: random.Random) -> Iterator[Utterance]:
    yield from espeak(_wishes(tuple(TRAIN_VOICES), TRAIN_VARIANTS, N_HELD, source))
    for voice in TRAIN_FESTIVAL:
        yield from festival(voice, [texts.line(FESTIVAL_VOICES[voice][0], source) for _ in range(2 * N_HELD)])


def _held_voices(source: random.Random) -> Iterator[Utterance]:
    yield from espeak(_wishes(("en", "de", "es", "ru"), HELD_VARIANTS, 2 * N_HELD, source))
    for voice in HELD_FESTIVAL:
        language = FESTIVAL_VOICES[voice][0]
        yield from festival(voice, [texts.held_sentence(language, source) for _ in range(2 * N_HELD)])


def _flite(source: random.Random) -> Iterator[Utterance]:
    for voice in FLITE_VOICES:
        for _ in range(3 * N_HELD):
            yield flite(voice, texts.held_sentence("en", source))


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
    blocks = _moved(utterance.blocks, speed, lead / utterance.rate, len(padded) / utterance.rate)
    moved = replace(utterance, samples=padded, blocks=blocks)
    return _example(moved, spoilt(padded, utterance.rate, generator), generator)


def _moved(blocks: list[Block], speed: float, lead: float, duration: float) -> list[Block]:
    """Blocks at another speed, `lead` seconds later, silence around them from 0 to `duration`."""
    spoken = [replace(block, start=block.start / speed, duration=block.duration / speed) for block in blocks]
    while spoken and spoken[0].viseme == "sil":
        spoken.pop(0)
    while spoken and spoken[-1].viseme == "sil":
        spoken.pop()
    later = [replace(block, start=block.start + lead) for block in spoken]
    first, last = (later[0].start, later[-1].end) if later else (duration, duration)
    return [Block(0.0, first, "sil"), *later, Block(last, duration - last, "sil")]


def _example(utterance: Utterance, samples: np.ndarray, generator: np.random.Generator) -> dict:
    """Frames at 100 Hz, viseme numbers and articulators at FPS, and the blocks they come from."""
    at_rate = signal.resample_poly(samples, RATE, utterance.rate) if utterance.rate != RATE else samples
    dither = 1e-5 * generator.standard_normal(len(at_rate))
    frames = log_mels([(at_rate + dither).astype(np.float32)])
    blocks = utterance.blocks
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
    if not path.stem.startswith("train-"):
        arrays["samples"] = np.concatenate([item["samples"] for item in items])
        arrays["n_samples"] = np.array([len(item["samples"]) for item in items])
    lengths = np.array([len(item["classes"]) for item in items])
    for key in ("voice", "language", "text"):
        arrays[key] = np.array([item[key] for item in items])
    np.savez(path, lengths=lengths, blocks=_block_table(items), **arrays)


def _print_lengths(paths: list[Path]) -> None:
    """The table of `durations.py`: median (ms) and logarithm's deviation of each viseme, where times are exact."""
    rows = np.concatenate([np.load(path)["blocks"] for path in paths if not path.stem.startswith(FOUND)])
    for number, name in enumerate(VISEMES):
        lengths = rows[rows[:, 3] == number, 2]
        print(f'"{name}": ({1000 * np.median(lengths):.0f}, {np.log(np.maximum(lengths, 0.01)).std():.2f})')


def _block_table(items: list[dict]) -> np.ndarray:
    """Rows (example, start, duration) with the viseme's number: float [n, 4]."""

    def row(index: int, block: Block) -> tuple[float, ...]:
        return index, block.start, block.duration, VISEMES.index(block.viseme)

    rows = [row(index, block) for index, item in enumerate(items) for block in item["blocks"]]
    return np.array(rows, np.float32).reshape(-1, 4)


if __name__ == "__main__":
    main()
