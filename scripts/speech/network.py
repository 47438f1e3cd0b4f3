"""Networks from normalised log-mel frames to visemes and articulators, and to edges of sounds: dilated convolutions.

Sound is laid out as images one pixel high, channels last: training then takes three quarters of the time on processors
that multiply matrices of bfloat16.
"""

from __future__ import annotations

import torch
from torch import Tensor, nn
from torch.nn import functional
from vectortalker.speech.features import N_MELS
from vectortalker.speech.visemes import CHANNELS, VISEMES

KERNEL = 5
STRIDE = 2  # 10 ms frames in, 20 ms frames out
LAYERS = ((1, 2), (2, 2), (4, 1), (8, 0), (1, 1), (2, 1), (4, 0), (4, 2))  # dilation, taps into the future
DROPOUT = 0.1
EDGE_LAYERS = (1, 2, 4, 1)  # dilations; as far ahead as back
FIRST_GAIN = 0.1  # layers begin near the identity (Goyal et al. 2017, section 5.1): they may join a trained stack
FEATURE_SCALE = 1 / 3  # brings log powers near unit variance

STEM_PAST = KERNEL // 2  # 10 ms frames
PAST = sum((KERNEL - 1 - future) * dilation for dilation, future in LAYERS) + 1  # output frames that matter before one
FUTURE = sum(future * dilation for dilation, future in LAYERS) + 1  # and after it


class Layer(nn.Module):
    """Residual dilated convolution that sees `future` taps ahead and the other taps behind."""

    def __init__(self, width: int, dilation: int, future: int, dropout: float) -> None:
        super().__init__()
        self.padding = ((KERNEL - 1 - future) * dilation, future * dilation)
        self.convolution = nn.Conv2d(width, width, (1, KERNEL), dilation=(1, dilation), bias=False)
        self.norm = nn.BatchNorm2d(width)
        nn.init.constant_(self.norm.weight, FIRST_GAIN)
        self.dropout = nn.Dropout2d(dropout)  # of whole channels: dropping single values takes a fifth of a step's time

    def forward(self, inputs: Tensor) -> Tensor:
        hidden = self.convolution(functional.pad(inputs, self.padding))
        return inputs + self.dropout(functional.relu(self.norm(hidden)))


class SpeechNetwork(nn.Module):
    """Frames [batch, 2n, N_MELS] to logits [batch, n, 15] and articulators [batch, n, 7]."""

    def __init__(self, width: int) -> None:
        super().__init__()
        self.stem = nn.Conv2d(N_MELS, width, (1, KERNEL), stride=(1, STRIDE))
        self.layers = nn.Sequential(*(Layer(width, *layer, DROPOUT) for layer in LAYERS))
        self.visemes = nn.Conv2d(width, len(VISEMES), 1)
        self.articulators = nn.Conv2d(width, len(CHANNELS), 1)
        self.to(memory_format=torch.channels_last)

    def forward(self, frames: Tensor) -> tuple[Tensor, Tensor]:
        hidden = self.layers(functional.relu(self.stem(_image(frames))))
        return _rows(self.visemes(hidden)), _rows(self.articulators(hidden))


class EdgeNetwork(nn.Module):
    """Frames [batch, n, N_MELS] to logits [batch, n]: is this moment, of 10 ms, at the edge of a sound?"""

    def __init__(self, width: int) -> None:
        super().__init__()
        self.stem = nn.Conv2d(N_MELS, width, (1, KERNEL))
        self.layers = nn.Sequential(*(Layer(width, dilation, KERNEL // 2, 0.0) for dilation in EDGE_LAYERS))
        self.edges = nn.Conv2d(width, 1, 1)
        self.to(memory_format=torch.channels_last)

    def forward(self, frames: Tensor) -> Tensor:
        return _rows(self.edges(self.layers(functional.relu(self.stem(_image(frames)))))).squeeze(2)


def _image(frames: Tensor) -> Tensor:
    """Frames [batch, n, N_MELS] as an image [batch, N_MELS, 1, n + 4], padded for the stem."""
    image = (frames.transpose(1, 2) * FEATURE_SCALE).unsqueeze(2)
    return functional.pad(image.contiguous(memory_format=torch.channels_last), (STEM_PAST, STEM_PAST))


def _rows(image: Tensor) -> Tensor:
    """Image [batch, channels, 1, n] as [batch, n, channels]."""
    return image.squeeze(2).transpose(1, 2)
