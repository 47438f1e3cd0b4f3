"""A model's name becomes an onnxruntime session on the weights of this folder, after their SHA-256 is checked.

`models.json` holds file, checksum, origin and licence of each; `scripts/models/` made the files.
"""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Literal

import numpy as np
import onnxruntime
from numpy.typing import NDArray

FOLDER = Path(__file__).parent
N_THREADS = 2  # the nets are small: more threads cost more than they save

ModelName = Literal["face_detection_short_range", "face_landmark_with_attention", "selfie_segmentation", "u2netp"]


@dataclass(frozen=True)
class ModelCard:
    """One entry of `models.json`."""

    file: str
    sha256: str
    purpose: str
    origin: str
    licence: str


class DamagedModelError(RuntimeError):
    """The committed weights differ from their checksum: the checkout is damaged."""


def cards() -> dict[str, ModelCard]:
    """All committed models by name."""
    entries = json.loads((FOLDER / "models.json").read_text(encoding="utf-8"))
    return {name: ModelCard(**entry) for name, entry in entries.items()}


def run(name: ModelName, image: NDArray[np.float32], outputs: list[str] | None = None) -> list[NDArray[np.float32]]:
    """Outputs of the model, all or the named ones, for its single input."""
    session = _session(name)
    results = session.run(outputs, {session.get_inputs()[0].name: image})
    return [np.asarray(result, np.float32) for result in results]


@cache
def _session(name: ModelName) -> onnxruntime.InferenceSession:
    card = cards()[name]
    weights = (FOLDER / card.file).read_bytes()
    if hashlib.sha256(weights).hexdigest() != card.sha256:
        raise DamagedModelError(
            f"{card.file} does not have the SHA-256 of models.json: check out the repository again."
        )
    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = N_THREADS
    options.add_session_config_entry("session.intra_op.allow_spinning", "0")  # waiting threads leave the core to others
    options.log_severity_level = 3  # errors only: the converted graphs warn about unused initialisers
    return onnxruntime.InferenceSession(weights, options, providers=["CPUExecutionProvider"])
