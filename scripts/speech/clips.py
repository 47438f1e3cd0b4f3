"""Training clips of a corpus, and random pieces of them, distorted anew each time."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from distortion import at, distorted, noisy
from vectortalker.speech.coarticulation import FPS
from vectortalker.speech.features import FRAMES_PER_SECOND, normalised

TEMPO = (0.82, 1.2)
NOISE_SHARE = 0.6  # of pieces


@dataclass(frozen=True)
class Clip:
    frames: np.ndarray  # [2n, N_MELS], as recorded
    classes: np.ndarray  # [n]
    articulators: np.ndarray  # [n, 7]
    edges: np.ndarray  # [k] places among the frames where one viseme ends and another begins
    is_noise: bool  # nobody speaks


def load(path: Path) -> list[Clip]:
    archive = np.load(path)
    cuts = np.cumsum(archive["lengths"])[:-1]
    of, starts = archive["blocks"][:, 0], archive["blocks"][:, 1]
    per_clip = np.split(FRAMES_PER_SECOND * starts, np.searchsorted(of, np.arange(1, len(cuts) + 1)))
    parts = zip(
        np.split(archive["frames"], 2 * cuts),
        np.split(archive["classes"], cuts),
        np.split(archive["articulators"], cuts),
        (places[places > 0] for places in per_clip),
        archive["voice"] == "none",
        strict=True,
    )
    return [Clip(*part) for part in parts]


def sources_in(corpus: Path) -> dict[str, list[Clip]]:
    """Training clips by where they come from."""
    return {path.stem.removeprefix("train-"): load(path) for path in sorted(corpus.glob("train-*.npz"))}


def hours_of(clips: list[Clip]) -> float:
    return sum(len(clip.classes) for clip in clips) / FPS / 3600


class Clips:
    """All clips to train on: some are drawn by their length, and noises laid over them."""

    def __init__(self, clips: list[Clip]) -> None:
        self.clips = clips
        self.noises = [clip for clip in clips if clip.is_noise]
        lengths = np.array([len(clip.classes) for clip in clips], float)
        self.n_frames = int(lengths.sum())  # at FPS
        self._shares = lengths / lengths.sum()

    def drawn(self, n_clips: int, generator: np.random.Generator) -> list[Clip]:
        return [self.clips[index] for index in generator.choice(len(self.clips), n_clips, p=self._shares)]

    def piece(self, clip: Clip, n_frames: int, generator: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
        """Normalised frames [n_frames, N_MELS], distorted, and their places [n_frames] among those of `clip`.

        Beyond a clip's end: its last frame, silent as all ends are.
        """
        tempo = generator.uniform(*TEMPO)
        start = 2 * int(generator.integers(max(1, len(clip.classes) - round(n_frames / 2 * tempo) + 1)))
        places = start + np.arange(n_frames) * tempo
        frames = at(clip.frames, places)
        if generator.random() < NOISE_SHARE:
            frames = noisy(frames, self.noises[int(generator.integers(len(self.noises)))].frames, generator)
        return distorted(normalised(frames), generator), places
