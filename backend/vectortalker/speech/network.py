"""Turns normalised log-mel frames into viseme posteriors, articulators and edges of sounds, by the committed network.

The network is stacks of dilated convolutions over time (`scripts/speech/network.py`), 50 outputs a second. One needs
1.7 s of the past and 440 ms of the future at most, so a long clip is run in chunks that overlap by that much, with the
same answer.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
import onnxruntime
from numpy.typing import NDArray

from vectortalker.speech.features import Frames
from vectortalker.speech.visemes import CHANNELS, VISEMES

MODEL = Path(__file__).parent / "model" / "speech.onnx"
N_THREADS = 2
STRIDE = 2  # 10 ms frames in, 20 ms frames out
PAST, FUTURE = 88, 24  # output frames that an output depends on, rounded up from the network's 84 and 22
CHUNK = 1500  # output frames: 30 s


@dataclass(frozen=True)
class Heard:
    """What the network makes of n frames of 20 ms."""

    log_posteriors: NDArray[np.float32]  # [n, 15], of VISEMES
    articulators: NDArray[np.float32]  # [n, 7], CHANNELS
    edges: NDArray[np.float32]  # [n], log probability that a sound ends between a frame and the next


def hear(frames: Frames, progress: Callable[[float], None] = lambda done: None) -> Heard:
    """Frames [m, N_MELS] at 100 Hz, normalised, to ⌊m / 2⌋ outputs. `progress` is told the done share."""
    n_out = len(frames) // STRIDE
    logits = np.empty((n_out, len(VISEMES)), np.float32)
    articulators = np.empty((n_out, len(CHANNELS)), np.float32)
    edges = np.empty(n_out, np.float32)
    for start in range(0, n_out, CHUNK):
        end = min(n_out, start + CHUNK)
        first, last = max(0, start - PAST), min(n_out, end + FUTURE)
        inputs = frames[None, STRIDE * first : STRIDE * last].astype(np.float32)
        outputs = [np.asarray(output) for output in _session().run(None, {"frames": inputs})]
        kept = (output[0, start - first : end - first] for output in outputs)
        logits[start:end], articulators[start:end], edges[start:end] = kept
        progress(end / n_out)
    peaks = logits.max(axis=1, keepdims=True, initial=0)
    totals = peaks + np.log(np.exp(logits - peaks).sum(axis=1, keepdims=True))
    return Heard(logits - totals, articulators, -np.logaddexp(0, -edges))


@cache
def _session() -> onnxruntime.InferenceSession:
    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = N_THREADS
    return onnxruntime.InferenceSession(MODEL.read_bytes(), options, providers=["CPUExecutionProvider"])
