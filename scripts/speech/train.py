"""Trains the network on a corpus and writes it as ONNX, with its card.

python scripts/speech/train.py CORPUS_FOLDER [--seed 0] [--epochs 26] [--start speech.pt] [--threads 1] [--out FOLDER]

The weights are also kept in the corpus folder as `speech.pt`, with the card beside them, to go on from. After each
epoch the whole state is kept there as `state.pt`; a run that was cut short and is begun again with the same options
goes on from it.
"""

from __future__ import annotations

import argparse
import json
import time
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
import torch
from distortion import at, distorted, noisy
from network import FUTURE, PAST, SpeechNetwork
from torch import Tensor
from torch.nn import functional
from vectortalker.speech.coarticulation import FPS
from vectortalker.speech.features import N_MELS, normalised
from vectortalker.speech.visemes import CHANNELS, VISEMES

CROP = 200  # output frames: 4 s
BATCH = 32
PEAK_RATE = 3e-3
LIP_WEIGHT = 3.0  # of errors of `press` and `lower_raise`, which make the closures
ARTICULATOR_WEIGHT = 4.0  # of the mean square against the cross-entropy
CLOSURE_WEIGHT = 1.5  # of PP and FF in the cross-entropy: a missed closure is what people see
OPSET = 17
TEMPO = (0.82, 1.2)
NOISE_SHARE = 0.6  # of crops
MODEL_FOLDER = Path("backend/vectortalker/speech/model")


@dataclass(frozen=True)
class Clip:
    frames: np.ndarray  # [2n, N_MELS], as recorded
    classes: np.ndarray  # [n]
    articulators: np.ndarray  # [n, 7]
    is_noise: bool  # nobody speaks


@dataclass(frozen=True)
class Plan:
    seed: int
    n_epochs: int
    peak_rate: float


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


def hours_of(clips: list[Clip]) -> float:
    return sum(len(clip.classes) for clip in clips) / FPS / 3600


def batch_of(clips: list[Clip], noises: list[Clip], generator: np.random.Generator) -> tuple[Tensor, Tensor, Tensor]:
    """Random crops, distorted. Beyond a clip's end: its last frame, silent as all ends are."""
    frames = np.zeros((len(clips), 2 * CROP, N_MELS), np.float32)
    classes = np.zeros((len(clips), CROP), np.int64)
    articulators = np.zeros((len(clips), CROP, len(CHANNELS)), np.float32)
    for row, clip in enumerate(clips):
        tempo = generator.uniform(*TEMPO)
        start = int(generator.integers(max(1, len(clip.classes) - round(CROP * tempo) + 1)))
        piece = at(clip.frames, 2 * start + np.arange(2 * CROP) * tempo)
        if generator.random() < NOISE_SHARE:
            piece = noisy(piece, noises[int(generator.integers(len(noises)))].frames, generator)
        frames[row] = distorted(normalised(piece), generator)
        places = start + np.arange(CROP) * tempo
        n_frames = int((places <= len(clip.classes) - 1).sum())
        classes[row, :n_frames] = clip.classes[np.rint(places[:n_frames]).astype(int)]
        articulators[row, :n_frames] = at(clip.articulators, places[:n_frames])
    return torch.from_numpy(frames), torch.from_numpy(classes), torch.from_numpy(articulators)


def loss_of(network: SpeechNetwork, frames: Tensor, classes: Tensor, articulators: Tensor) -> Tensor:
    logits, curves = (output.float() for output in network(frames))
    weights = torch.ones(len(VISEMES))
    weights[[VISEMES.index("PP"), VISEMES.index("FF")]] = CLOSURE_WEIGHT
    crossed = functional.cross_entropy(logits.transpose(1, 2), classes, weights, label_smoothing=0.05)
    channels = torch.ones(len(CHANNELS))
    channels[[CHANNELS.index("press"), CHANNELS.index("lower_raise")]] = LIP_WEIGHT
    return crossed + ARTICULATOR_WEIGHT * ((curves - articulators) ** 2 * channels).mean()


def train(network: SpeechNetwork, clips: list[Clip], plan: Plan, state: Path) -> None:
    """Train `network` in place, from `state` where an earlier run of the same plan left one."""
    generator = np.random.default_rng(plan.seed)
    optimiser = torch.optim.AdamW(network.parameters(), plan.peak_rate, weight_decay=1e-2)
    n_steps = sum(len(clip.classes) for clip in clips) // (CROP * BATCH)
    schedule = torch.optim.lr_scheduler.OneCycleLR(
        optimiser, plan.peak_rate, total_steps=plan.n_epochs * n_steps, pct_start=0.15
    )
    parts = (network, optimiser, schedule)
    first = _resumed(state, plan, parts, generator) if state.exists() else 0
    for epoch in range(first, plan.n_epochs):
        loss = _epoch(network, clips, n_steps, (optimiser, schedule), generator)
        kept = [part.state_dict() for part in parts]
        torch.save((plan, epoch + 1, kept, generator.bit_generator.state, torch.get_rng_state()), state)
        print(f"epoch {epoch + 1}/{plan.n_epochs}: loss {loss:.4f}, {time.process_time():.0f} CPU s", flush=True)
    network.eval()


def _resumed(state: Path, plan: Plan, parts: tuple, generator: np.random.Generator) -> int:
    """Put the kept state into the parts and the generators; the number of epochs done. Another plan's is refused."""
    kept_plan, n_done, kept, numbers, torch_numbers = torch.load(state, weights_only=False)
    if kept_plan != plan:
        raise SystemExit(f"{state} is of another run, {kept_plan}: remove it, or give its options.")
    for part, values in zip(parts, kept, strict=True):
        part.load_state_dict(values)
    generator.bit_generator.state = numbers
    torch.set_rng_state(torch_numbers)
    return n_done


def _epoch(
    network: SpeechNetwork, clips: list[Clip], n_steps: int, optimisers: tuple, generator: np.random.Generator
) -> float:
    """Mean loss of `n_steps` batches, clips drawn by their length."""
    optimiser, schedule = optimisers
    noises = [clip for clip in clips if clip.is_noise]
    lengths = np.array([len(clip.classes) for clip in clips], float)
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
    return total / n_steps


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
    parser.add_argument("--epochs", type=int, default=26)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--start", type=Path, help="weights to go on from: speech.pt of an earlier run")
    parser.add_argument("--rate", type=float, default=PEAK_RATE, help="peak learning rate (default: %(default)s)")
    parser.add_argument("--out", type=Path, default=MODEL_FOLDER)
    options = parser.parse_args()
    torch.set_num_threads(options.threads)
    sources = {path.stem.removeprefix("train-"): load(path) for path in sorted(options.corpus.glob("train-*.npz"))}
    clips = [clip for source in sources.values() for clip in source]
    plan = Plan(options.seed, options.epochs, options.rate)
    torch.manual_seed(options.seed)
    network = SpeechNetwork()
    if options.start:
        network.load_state_dict(torch.load(options.start, weights_only=True), strict=False)  # it may have fewer layers
    train(network, clips, plan, options.corpus / "state.pt")
    torch.save(network.state_dict(), options.corpus / "speech.pt")
    path = options.out / "speech.onnx"
    export(network, path)
    card = {
        "script": "scripts/speech/train.py",
        "runs": [*_runs_before(options.start), asdict(plan)],
        "parameters": sum(parameter.numel() for parameter in network.parameters()),
        "bytes": path.stat().st_size,
        "past_frames": PAST,
        "future_frames": FUTURE,
        "data": {
            "script": "scripts/speech/corpus.py",
            "programs": "espeak-ng 1.51, Festival 2.5, RHVoice 1.8.0, SVOX Pico 1.0, asterisk-core-sounds 1.6.1",
            "hours": {name: round(hours_of(source), 2) for name, source in sources.items()},
        },
    }
    for folder in (options.corpus, options.out):
        (folder / "speech.json").write_text(json.dumps(card, indent=2) + "\n", encoding="utf-8")


def _runs_before(start: Path | None) -> list[dict]:
    """Plans of the runs that made the weights of `start`, as the card beside them tells."""
    return json.loads(start.with_suffix(".json").read_text(encoding="utf-8"))["runs"] if start else []


if __name__ == "__main__":
    main()
