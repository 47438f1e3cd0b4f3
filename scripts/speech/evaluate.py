"""Scores speech to track on clips whose phones are known, never trained on, beside pocketsphinx's all-phone recogniser.

    python scripts/speech/evaluate.py CORPUS_FOLDER [--by network transcript pocketsphinx] [--card speech.json]

`transcript` needs espeak-ng, `pocketsphinx` needs pocketsphinx 5. `--card` adds the figures to the network's card.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
from phone_sets import RADIO, ipa
from vectortalker.errors import VectorTalkerError
from vectortalker.speech import Options, as_landmarks, track_from_blocks
from vectortalker.speech.coarticulation import FPS, Blend, articulate
from vectortalker.speech.features import levels, log_mels, normalised
from vectortalker.speech.listening import blocks_heard
from vectortalker.speech.network import Heard, hear
from vectortalker.speech.transcript import words_of
from vectortalker.speech.visemes import SILENCE, VISEMES, Block, blocks_of_phones, classes_at
from vectortalker.speech.vocal_tract import fitted

PARTS = ("synthesiser", "voices", "languages", "noisy", "tuning")
LANGUAGES = {"en": "en-us"}  # flite's and Festival's English voices are American
CLOSED = 0.02  # inner gap in mouth widths
TOLERANCE = 0.04  # seconds around a closure
EDGE = 0.02  # seconds around a boundary of phones in which human labellers differ, too
MAX_LAG = 10  # frames searched either way
PP, FF = VISEMES.index("PP"), VISEMES.index("FF")
SHWA_RIVALS = (VISEMES.index("aa"), VISEMES.index("E"))  # the recogniser has one phone, AH, for both


@dataclass(frozen=True)
class Clip:
    voice: str
    language: str
    text: str
    samples: np.ndarray
    blocks: list[Block]
    n_frames: int


@dataclass(frozen=True)
class Scores:
    n_clips: int
    seconds: float
    frame_accuracy: float
    speech_accuracy: float  # of frames that are not silence
    inner_accuracy: float  # of frames away from boundaries, where no convention of labelling matters
    closure_recall: float
    closure_precision: float
    jaw_correlation: float
    lag_ms: float


def clips_of(path: Path) -> list[Clip]:
    archive = np.load(path)
    samples = np.split(archive["samples"], np.cumsum(archive["n_samples"])[:-1])
    rows = archive["blocks"]
    clips = []
    for index, n_frames in enumerate(archive["lengths"]):
        blocks = [Block(float(t), float(d), VISEMES[int(k)]) for _, t, d, k in rows[rows[:, 0] == index]]
        voice, language, text = (str(archive[key][index]) for key in ("voice", "language", "text"))
        clips.append(Clip(voice, language, text, samples[index].astype(np.float32) / 32768, blocks, int(n_frames)))
    return clips


@dataclass(frozen=True)
class Outcome:
    """What of one clip's n frames is right, and its jaws."""

    is_right: np.ndarray
    is_speech: np.ndarray
    is_inner: np.ndarray  # EDGE away from all boundaries of phones
    closures: tuple[int, int, int, int]
    reference_jaw: np.ndarray
    jaw: np.ndarray


def outcome(clip: Clip, blocks: list[Block], is_lenient: bool) -> Outcome:
    times = np.arange(clip.n_frames) / FPS
    truth, guess = classes_at(clip.blocks, times), classes_at(blocks, times)
    is_right = truth == guess
    if is_lenient:
        is_right |= np.isin(truth, SHWA_RIVALS) & np.isin(guess, SHWA_RIVALS)
    edges = np.array([block.start for block in clip.blocks] or [-1.0])
    track = track_from_blocks(blocks, np.zeros(clip.n_frames), Options(gains={"head": 0}), clip.voice)
    return Outcome(
        is_right=is_right,
        is_speech=truth != SILENCE,
        is_inner=np.abs(times[:, None] - edges).min(axis=1) > EDGE,
        closures=closure_counts(lip_gap(as_landmarks(track).landmarks) < CLOSED, truth),
        reference_jaw=articulate(clip.blocks, clip.n_frames, Blend())[:, 0],
        jaw=np.array((track.articulators or {})["jaw"]),
    )


def score(clips: list[Clip], recognise: Callable[[Clip], list[Block]], is_lenient: bool = False) -> Scores:
    """Pooled over all frames and closures of `clips`. Clips that `recognise` refuses count as silence."""
    outcomes = [outcome(clip, recognise(clip), is_lenient) for clip in clips]
    is_right, is_speech, is_inner, reference_jaw, jaw = (
        np.concatenate([getattr(item, name) for item in outcomes])
        for name in ("is_right", "is_speech", "is_inner", "reference_jaw", "jaw")
    )
    found, wanted, true_runs, runs = (sum(counts) for counts in zip(*(o.closures for o in outcomes), strict=True))
    return Scores(
        n_clips=len(clips),
        seconds=round(len(is_right) / FPS, 1),
        frame_accuracy=round(float(is_right.mean()), 4),
        speech_accuracy=round(float(is_right[is_speech].mean()), 4),
        inner_accuracy=round(float(is_right[is_inner].mean()), 4),
        closure_recall=round(found / max(1, wanted), 4),
        closure_precision=round(true_runs / max(1, runs), 4),
        jaw_correlation=round(float(np.corrcoef(reference_jaw, jaw)[0, 1]), 4),
        lag_ms=round(float(np.median([_lag(item.reference_jaw, item.jaw) for item in outcomes])), 1),
    )


def lip_gap(landmarks: list | None) -> np.ndarray:
    """Inner gap over mouth width [n] of offsets from the canonical face."""
    from vectortalker.tracks.neutral import neutral_landmarks

    points = np.array(landmarks) + neutral_landmarks()
    return np.abs(points[:, 66, 1] - points[:, 62, 1]) / np.linalg.norm(points[:, 54] - points[:, 48], axis=1)


def closure_counts(is_closed: np.ndarray, truth: np.ndarray) -> tuple[int, int, int, int]:
    """Closures of p b m found and wanted; closed runs that are right, and all runs.

    A run is right if within the tolerance of its middle there is a p b m, or f v, or a pause, where lips close too.
    """
    reach = round(TOLERANCE * FPS)
    found = wanted = right = runs = 0
    for first, last in _runs(truth == PP):
        wanted += 1
        found += bool(is_closed[max(0, first - reach) : last + reach].any())
    for first, last in _runs(is_closed):
        middle = (first + last) // 2
        runs += 1
        right += bool(np.isin(truth[max(0, middle - reach) : middle + reach + 1], (PP, FF, SILENCE)).any())
    return found, wanted, right, runs


def _runs(flags: np.ndarray) -> list[tuple[int, int]]:
    """First and one past the last index of each run of true flags."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], flags.astype(int), [0]])))
    return list(zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True))


def _lag(reference: np.ndarray, jaw: np.ndarray) -> float:
    """Milliseconds by which `jaw` is late against `reference`: the argmax of their cross-correlation."""
    shifts = range(-MAX_LAG, MAX_LAG + 1)
    scores = [
        float(np.dot(reference[max(0, -s) : len(reference) - max(0, s)], jaw[max(0, s) : len(jaw) - max(0, -s)]))
        for s in shifts
    ]
    return 1000 / FPS * shifts[int(np.argmax(scores))]


def heard_in(clip: Clip) -> Heard:
    return hear(fitted(normalised(log_mels([clip.samples]))))


def by_network(clip: Clip) -> list[Block]:
    return blocks_heard(heard_in(clip), None)


def by_transcript(clip: Clip) -> list[Block]:
    heard = heard_in(clip)
    try:
        return blocks_heard(heard, words_of(clip.text, LANGUAGES.get(clip.language, clip.language)))
    except VectorTalkerError as error:
        print(f"  {clip.voice}: {error.message}")
        return []


def by_pocketsphinx() -> Callable[[Clip], list[Block]]:
    from pocketsphinx import Decoder, get_model_path

    models = get_model_path()
    decoder = Decoder(
        hmm=f"{models}/en-us/en-us",
        allphone=f"{models}/en-us/en-us-phone.lm.bin",
        lw=2.0,
        beam=1e-20,
        pbeam=1e-20,
        loglevel="ERROR",
    )

    def recognise(clip: Clip) -> list[Block]:
        decoder.start_utt()
        decoder.process_raw((clip.samples * 32767).astype(np.int16).tobytes(), full_utt=True)
        decoder.end_utt()
        segments = list(decoder.seg() or [])
        phones = [(s.start_frame / 100, (s.end_frame + 1) / 100, ipa(s.word.lower(), RADIO)) for s in segments]
        return blocks_of_phones(phones)

    return recognise


def closed_without_speech(samples: np.ndarray) -> float:
    """Share of frames with closed lips."""
    frames = log_mels([samples.astype(np.float32)])
    heard = hear(fitted(normalised(frames)))
    loudness = levels(frames)[::2][: len(heard.articulators)].astype(float)
    track = track_from_blocks(blocks_heard(heard, None), loudness, Options(), "none")
    return float((lip_gap(as_landmarks(track).landmarks) < CLOSED).mean())


def quiet_scores(seed: int) -> dict[str, float]:
    """Silence, and pink noise at three levels, ten seconds each."""
    generator = np.random.default_rng(seed)
    spectrum = np.fft.rfft(generator.standard_normal(160_000)) / np.sqrt(np.maximum(np.arange(80_001), 20))
    pink = np.fft.irfft(spectrum)
    pink /= np.abs(pink).max()
    quiet = {"silence": np.zeros(160_000)} | {f"pink_{level}": level * pink for level in (0.9, 0.1, 0.01)}
    return {name: round(closed_without_speech(samples), 4) for name, samples in quiet.items()}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("corpus", type=Path)
    parser.add_argument("--by", nargs="+", choices=RECOGNISERS, default=["network"])
    parser.add_argument("--parts", nargs="+", choices=PARTS, default=list(PARTS[:-1]))
    parser.add_argument("--card", type=Path)
    options = parser.parse_args()
    figures: dict[str, dict] = {}
    if "network" in options.by:
        figures["closed_without_speech"] = quiet_scores(seed=7)
        print(figures, flush=True)
    for part in options.parts:
        clips = clips_of(options.corpus / f"{part}.npz")
        for maker in sorted({clip.voice.split()[0] for clip in clips}):
            chosen = [clip for clip in clips if clip.voice.split()[0] == maker]
            for name in options.by:
                scores = asdict(score(chosen, RECOGNISERS[name](), is_lenient=name == "pocketsphinx"))
                figures.setdefault(f"{part}/{maker}", {})[name] = scores
                print(f"{part}/{maker} {name}: {json.dumps(scores)}", flush=True)
    if options.card:
        card = json.loads(options.card.read_text(encoding="utf-8"))
        held_out = card.get("held_out", {})
        for key, scores in figures.items():
            held_out[key] = held_out.get(key, {}) | scores
        options.card.write_text(json.dumps(card | {"held_out": held_out}, indent=2) + "\n", encoding="utf-8")


RECOGNISERS: dict[str, Callable[[], Callable[[Clip], list[Block]]]] = {
    "network": lambda: by_network,
    "transcript": lambda: by_transcript,
    "pocketsphinx": by_pocketsphinx,
}

if __name__ == "__main__":
    main()
