"""Trains a network that hears visemes and articulators on a corpus.

    python scripts/speech/train.py CORPUS_FOLDER OUT.pt [--width 128] [--epochs 26] [--seed 0] [--start FROM.pt]

Writes the weights, and beside them as OUT.json how they were made; `export.py` makes the model of one or more of them.
After each epoch the weights so far are written, and the whole state as OUT.state: a run that was cut short and is begun
again with the same options goes on from it.
"""

from __future__ import annotations

import numpy as np
import torch
from clips import Clips, hours_of, sources_in
from distortion import at
from network import SpeechNetwork
from torch import Tensor
from torch.nn import functional
from training import BATCH, parser_of, train
from vectortalker.speech.features import N_MELS
from vectortalker.speech.visemes import CHANNELS, VISEMES

CROP = 200  # output frames: 4 s
LIP_WEIGHT = 3.0  # of errors of `press` and `lower_raise`, which make the closures
ARTICULATOR_WEIGHT = 4.0  # of the mean square against the cross-entropy
CLOSURE_WEIGHT = 1.5  # of PP and FF in the cross-entropy: a missed closure is what people see


def batch_of(clips: Clips, generator: np.random.Generator) -> tuple[Tensor, Tensor, Tensor]:
    """Frames [b, 2 · CROP, N_MELS], classes [b, CROP] and articulators [b, CROP, 7] of random pieces."""
    frames = np.zeros((BATCH, 2 * CROP, N_MELS), np.float32)
    classes = np.zeros((BATCH, CROP), np.int64)
    articulators = np.zeros((BATCH, CROP, len(CHANNELS)), np.float32)
    for row, clip in enumerate(clips.drawn(BATCH, generator)):
        frames[row], moments = clips.piece(clip, 2 * CROP, generator)
        places = moments[::2] / 2
        n_frames = int((places <= len(clip.classes) - 1).sum())
        classes[row, :n_frames] = clip.classes[np.rint(places[:n_frames]).astype(int)]
        articulators[row, :n_frames] = at(clip.articulators, places[:n_frames])
    return torch.from_numpy(frames), torch.from_numpy(classes), torch.from_numpy(articulators)


def loss_of(network: SpeechNetwork, frames: Tensor, classes: Tensor, articulators: Tensor) -> Tensor:
    with torch.autocast("cpu", torch.bfloat16):  # half the time on processors that multiply it
        logits, curves = network(frames)
    weights = torch.ones(len(VISEMES))
    weights[[VISEMES.index("PP"), VISEMES.index("FF")]] = CLOSURE_WEIGHT
    crossed = functional.cross_entropy(logits.float().transpose(1, 2), classes, weights, label_smoothing=0.05)
    channels = torch.ones(len(CHANNELS))
    channels[[CHANNELS.index("press"), CHANNELS.index("lower_raise")]] = LIP_WEIGHT
    return crossed + ARTICULATOR_WEIGHT * ((curves.float() - articulators) ** 2 * channels).mean()


def main() -> None:
    options = parser_of(__doc__ or "", width=128, n_epochs=26).parse_args()
    sources = sources_in(options.corpus)
    clips = Clips([clip for source in sources.values() for clip in source])
    hours = {name: round(hours_of(source), 2) for name, source in sources.items()}
    n_steps = clips.n_frames // (CROP * BATCH)
    train(options, SpeechNetwork, lambda network, numbers: loss_of(network, *batch_of(clips, numbers)), n_steps, hours)


if __name__ == "__main__":
    main()
