"""Trains a network that hears where sounds end and begin, on the speech of a corpus whose phones' times are told.

    python scripts/speech/train_edges.py CORPUS_FOLDER OUT.pt [--width 64] [--epochs 6] [--seed 0]

Writes what `train.py` writes. Speech whose phones' times were found by a network is left out: their edges are only as
good as that network's.
"""

from __future__ import annotations

import numpy as np
import torch
from clips import Clips, hours_of, sources_in
from corpus import FOUND
from network import EdgeNetwork
from torch import Tensor
from torch.nn import functional
from training import BATCH, parser_of, train
from vectortalker.speech.features import N_MELS

CROP = 300  # frames: 3 s
BLUR = 0.7  # frames, 7 ms, deviation of the bell that stands for an edge: less than they can be heard by


def batch_of(clips: Clips, generator: np.random.Generator) -> tuple[Tensor, Tensor]:
    """Frames [b, CROP, N_MELS] of random pieces, and how near to an edge each is [b, CROP], 1 at an edge."""
    frames = np.zeros((BATCH, CROP, N_MELS), np.float32)
    nearness = np.zeros((BATCH, CROP), np.float32)
    for row, clip in enumerate(clips.drawn(BATCH, generator)):
        frames[row], places = clips.piece(clip, CROP, generator)
        if len(clip.edges):
            tempo = places[1] - places[0]
            away = np.abs(places[:, None] - clip.edges).min(axis=1) / tempo
            nearness[row] = np.exp(-0.5 * (away / BLUR) ** 2)
    return torch.from_numpy(frames), torch.from_numpy(nearness)


def loss_of(network: EdgeNetwork, frames: Tensor, nearness: Tensor) -> Tensor:
    with torch.autocast("cpu", torch.bfloat16):
        logits = network(frames)
    return functional.binary_cross_entropy_with_logits(logits.float(), nearness)


def main() -> None:
    options = parser_of(__doc__ or "", width=64, n_epochs=6).parse_args()
    found = tuple(name.removeprefix("train-") for name in FOUND)
    sources = {name: source for name, source in sources_in(options.corpus).items() if not name.startswith(found)}
    clips = Clips([clip for source in sources.values() for clip in source])
    hours = {name: round(hours_of(source), 2) for name, source in sources.items()}
    n_steps = 2 * clips.n_frames // (CROP * BATCH)
    train(options, EdgeNetwork, lambda network, numbers: loss_of(network, *batch_of(clips, numbers)), n_steps, hours)


if __name__ == "__main__":
    main()
