"""The network from normalised log-mel frames to visemes and articulators: dilated convolutions over time."""

from __future__ import annotations

from torch import Tensor, nn
from torch.nn import functional
from vectortalker.speech.features import N_MELS
from vectortalker.speech.visemes import CHANNELS, VISEMES

WIDTH = 128
KERNEL = 5
STRIDE = 2  # 10 ms frames in, 20 ms frames out
LAYERS = ((1, 2), (2, 2), (4, 1), (8, 0), (1, 1), (2, 1), (4, 0), (4, 2))  # dilation, taps into the future
FIRST_GAIN = 0.1  # layers begin near the identity (Goyal et al. 2017, section 5.1): they may join a trained stack
FEATURE_SCALE = 1 / 3  # brings log powers near unit variance

STEM_PAST = KERNEL // 2  # 10 ms frames
PAST = sum((KERNEL - 1 - future) * dilation for dilation, future in LAYERS) + 1  # output frames that matter before one
FUTURE = sum(future * dilation for dilation, future in LAYERS) + 1  # and after it


class Layer(nn.Module):
    """Residual dilated convolution that sees `future` taps ahead and the other taps behind."""

    def __init__(self, dilation: int, future: int) -> None:
        super().__init__()
        self.padding = ((KERNEL - 1 - future) * dilation, future * dilation)
        self.convolution = nn.Conv1d(WIDTH, WIDTH, KERNEL, dilation=dilation, bias=False)
        self.norm = nn.BatchNorm1d(WIDTH)
        nn.init.constant_(self.norm.weight, FIRST_GAIN)
        self.dropout = nn.Dropout1d(
            0.1
        )  # of whole channels: dropping single values takes a fifth of the time of a step

    def forward(self, inputs: Tensor) -> Tensor:
        hidden = self.convolution(functional.pad(inputs, self.padding))
        return inputs + self.dropout(functional.relu(self.norm(hidden)))


class SpeechNetwork(nn.Module):
    """Frames [batch, 2n, N_MELS] to logits [batch, n, 15] and articulators [batch, n, 7]."""

    def __init__(self) -> None:
        super().__init__()
        self.stem = nn.Conv1d(N_MELS, WIDTH, KERNEL, stride=STRIDE)
        self.layers = nn.Sequential(*(Layer(*layer) for layer in LAYERS))
        self.visemes = nn.Conv1d(WIDTH, len(VISEMES), 1)
        self.articulators = nn.Conv1d(WIDTH, len(CHANNELS), 1)

    def forward(self, frames: Tensor) -> tuple[Tensor, Tensor]:
        inputs = functional.pad(frames.transpose(1, 2) * FEATURE_SCALE, (STEM_PAST, STEM_PAST))
        hidden = self.layers(functional.relu(self.stem(inputs)))
        return self.visemes(hidden).transpose(1, 2), self.articulators(hidden).transpose(1, 2)
