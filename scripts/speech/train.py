"""Trains the network on a corpus and writes it as ONNX, with its card.

python scripts/speech/train.py CORPUS_FOLDER [--seed 0] [--epochs 20] [--start speech.pt] [--threads 1] [--out FOLDER]

The weights are also kept in the corpus folder as `speech.pt`, to go on from.
"""

from __future__ import annotations

import argparse
import json
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import torch
from network import FUTURE, PAST, SpeechNetwork
from torch import Tensor
from torch.nn import functional
from vectortalker.speech.features import N_MELS, normalised
from vectortalker.speech.visemes import CHANNELS, VISEMES

CROP = 200  # output frames: 4 s
BATCH = 32
PEAK_RATE = 3e-3
LIP_WEIGHT = 3.0  # of errors of `press` and `lower_raise`, which make the closures
ARTICULATOR_WEIGHT = 4.0  # of the mean square against the cross-entropy
CLOSURE_WEIGHT = 1.5  # of PP and FF in the cross-entropy: a missed closure is what people see
OPSET = 17
MODEL_FOLDER = Path("backend/vectortalker/speech/model")


TEMPO, WARP = (0.82, 1.2), (0.88, 1.12)  # of time, and of the mel axis
NOISE_SHARE = 0.6  # of clips
NOISE_BELOW = (1.5, 10.0)  # nats of power (6 to 43 dB) from the clip's loudest moments down to the noise
COLOUR = 0.5  # nats, deviation of the knots of a smooth response


@dataclass(frozen=True)
class Clip:
    frames: np.ndarray  # [2n, N_MELS], as recorded
    classes: np.ndarray  # [n]
    articulators: np.ndarray  # [n, 7]
    is_noise: bool  # nobody speaks


def load(path: Path) -> list[Clip]:
    archive = np.load(path)
    cuts = np.cumsum(archive["lengths"])[:-1]
    parts = zip(
        np.split(archive["frames"], 2 * cuts),
        np.split(archive["classes"], cuts),
        np.split(archive["articulators"], cuts),
        archive["voice"] == "none",
        strict=True,
    )
    return [Clip(*part) for part in parts]


def batch_of(clips: list[Clip], noises: list[Clip], generator: np.random.Generator) -> tuple[Tensor, Tensor, Tensor]:
    """Random crops, distorted. Beyond a clip's end: its last frame, silent as all ends are."""
    frames = np.zeros((len(clips), 2 * CROP, N_MELS), np.float32)
    classes = np.zeros((len(clips), CROP), np.int64)
    articulators = np.zeros((len(clips), CROP, len(CHANNELS)), np.float32)
    for row, clip in enumerate(clips):
        tempo = generator.uniform(*TEMPO)
        start = int(generator.integers(max(1, len(clip.classes) - round(CROP * tempo) + 1)))
        piece = _at(clip.frames, 2 * start + np.arange(2 * CROP) * tempo)
        if generator.random() < NOISE_SHARE:
            piece = _noisy(piece, noises[int(generator.integers(len(noises)))], generator)
        frames[row] = _distorted(normalised(piece), generator)
        places = start + np.arange(CROP) * tempo
        n_frames = int((places <= len(clip.classes) - 1).sum())
        classes[row, :n_frames] = clip.classes[np.rint(places[:n_frames]).astype(int)]
        articulators[row, :n_frames] = _at(clip.articulators, places[:n_frames])
    return torch.from_numpy(frames), torch.from_numpy(classes), torch.from_numpy(articulators)


def _at(rows: np.ndarray, places: np.ndarray) -> np.ndarray:
    """Rows at fractional places, linear between them, the last one beyond the end."""
    places = np.minimum(places, len(rows) - 1)
    below = places.astype(int)
    share = (places - below).astype(np.float32)[:, None]
    return rows[below] * (1 - share) + rows[np.minimum(below + 1, len(rows) - 1)] * share


def _noisy(frames: np.ndarray, noise: Clip, generator: np.random.Generator) -> np.ndarray:
    """Powers add up, which log powers cannot show of the phases between them."""
    start = int(generator.integers(len(noise.frames)))
    added = np.take(noise.frames, start + np.arange(len(frames)), axis=0, mode="wrap").astype(np.float32)
    level = np.quantile(frames.mean(axis=1), 0.95) - generator.uniform(*NOISE_BELOW)
    return np.logaddexp(frames, added - added.mean() + level)


def _distorted(clip: np.ndarray, generator: np.random.Generator) -> np.ndarray:
    """Formants shifted by a warp of the mel axis, a smooth colour, a masked band and a masked moment."""
    bands = np.arange(N_MELS)
    warped = np.ascontiguousarray(_at(clip.T, bands * generator.uniform(*WARP)).T)
    warped += np.interp(bands, np.linspace(0, N_MELS, 5), generator.normal(0, COLOUR, 5)).astype(np.float32)
    if generator.random() < 0.5:
        band = int(generator.integers(N_MELS - 6))
        warped[:, band : band + int(generator.integers(1, 6))] = 0
    if generator.random() < 0.3:
        moment = int(generator.integers(len(clip) - 10))
        warped[moment : moment + int(generator.integers(2, 8))] = 0
    return warped


def loss_of(network: SpeechNetwork, frames: Tensor, classes: Tensor, articulators: Tensor) -> Tensor:
    logits, curves = (output.float() for output in network(frames))
    weights = torch.ones(len(VISEMES))
    weights[[VISEMES.index("PP"), VISEMES.index("FF")]] = CLOSURE_WEIGHT
    crossed = functional.cross_entropy(logits.transpose(1, 2), classes, weights, label_smoothing=0.05)
    channels = torch.ones(len(CHANNELS))
    channels[[CHANNELS.index("press"), CHANNELS.index("lower_raise")]] = LIP_WEIGHT
    return crossed + ARTICULATOR_WEIGHT * ((curves - articulators) ** 2 * channels).mean()


def train(network: SpeechNetwork, clips: list[Clip], seed: int, n_epochs: int, peak_rate: float) -> None:
    generator = np.random.default_rng(seed)
    optimiser = torch.optim.AdamW(network.parameters(), peak_rate, weight_decay=1e-2)
    n_steps = sum(len(clip.classes) for clip in clips) // (CROP * BATCH)
    schedule = torch.optim.lr_scheduler.OneCycleLR(optimiser, peak_rate, total_steps=n_epochs * n_steps, pct_start=0.15)
    noises = [clip for clip in clips if clip.is_noise]
    lengths = np.array([len(clip.classes) for clip in clips], float)
    started = time.monotonic()
    for epoch in range(n_epochs):
        total = 0.0
        for _ in range(n_steps):
            chosen = generator.choice(len(clips), BATCH, p=lengths / lengths.sum())
            batch = batch_of([clips[index] for index in chosen], noises, generator)
            with torch.autocast("cpu", torch.bfloat16):  # half the time on processors that multiply it
                loss = loss_of(network, *batch)
            optimiser.zero_grad()
            loss.backward()
            torch.nn.utils.clip_grad_norm_(network.parameters(), 1.0)
            optimiser.step()
            schedule.step()
            total += loss.item()
        print(
            f"epoch {epoch + 1}/{n_epochs}: loss {total / n_steps:.4f}, {time.monotonic() - started:.0f} s",
            flush=True,
        )
    network.eval()


def export(network: SpeechNetwork, path: Path) -> None:
    torch.onnx.export(
        network,
        (torch.zeros(1, 4 * (PAST + FUTURE), N_MELS),),
        str(path),
        input_names=["frames"],
        output_names=["logits", "articulators"],
        dynamic_axes={
            "frames": {1: "n_in"},
            "logits": {1: "n_out"},
            "articulators": {1: "n_out"},
        },
        opset_version=OPSET,
        dynamo=False,
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("corpus", type=Path)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--epochs", type=int, default=20)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--start", type=Path, help="weights to go on from: speech.pt of an earlier run")
    parser.add_argument("--rate", type=float, default=PEAK_RATE, help="peak learning rate (default: %(default)s)")
    parser.add_argument("--out", type=Path, default=MODEL_FOLDER)
    options = parser.parse_args()
    torch.set_num_threads(options.threads)
    clips = load(options.corpus / "train.npz")
    cpu_before = time.process_time()
    torch.manual_seed(options.seed)
    network = SpeechNetwork()
    if options.start:
        network.load_state_dict(torch.load(options.start, weights_only=True))
    train(network, clips, options.seed, options.epochs, options.rate)
    torch.save(network.state_dict(), options.corpus / "speech.pt")
    path = options.out / "speech.onnx"
    export(network, path)
    card = {
        "script": "scripts/speech/train.py",
        "seed": options.seed,
        "epochs": options.epochs,
        "start": options.start.name if options.start else None,
        "peak_rate": options.rate,
        "parameters": sum(parameter.numel() for parameter in network.parameters()),
        "bytes": path.stat().st_size,
        "cpu_minutes": round((time.process_time() - cpu_before) / 60, 1),
        "past_frames": PAST,
        "future_frames": FUTURE,
        "data": {
            "script": "scripts/speech/corpus.py",
            "hours": round(sum(len(clip.classes) for clip in clips) / 50 / 3600, 2),
            "synthesisers": "espeak-ng 1.51 (12 languages, 51 variants), Festival 2.5 (8 voices of 5 languages)",
        },
    }
    (options.out / "speech.json").write_text(json.dumps(card, indent=2) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
