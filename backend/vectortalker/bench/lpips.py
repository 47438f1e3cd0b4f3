"""Two pictures become their LPIPS distance (Zhang et al. 2018, v0.1), by a network that is used for evaluation only."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import onnxruntime
from numpy.typing import NDArray

from vectortalker.bench.portraits import shared_folder

BACKBONE = "AlexNet"
MODEL = Path("models") / "lpips_alex.onnx"


class Lpips:
    """LPIPS with the AlexNet backbone; the weights may not be shipped and lie in the development data."""

    def __init__(self, model: Path) -> None:
        self._session = onnxruntime.InferenceSession(model, providers=["CPUExecutionProvider"])

    def distance(self, picture: NDArray[np.uint8], target: NDArray[np.uint8]) -> float:
        """Distance of two u8 [H, W, 3]; 0 for equal pictures."""
        inputs = {"a": _signed(picture), "b": _signed(target)}
        return float(np.asarray(self._session.run(["d"], inputs)[0]).item())


def load_lpips() -> Lpips | None:
    """None where the weights are absent: tables then say so instead of a figure."""
    shared = shared_folder()
    return Lpips(shared / MODEL) if shared and (shared / MODEL).is_file() else None


def _signed(picture: NDArray[np.uint8]) -> NDArray[np.float32]:
    """[1, 3, H, W] in −1…1, as the network was trained."""
    return (picture.astype(np.float32) / np.float32(127.5) - 1).transpose(2, 0, 1)[None]
