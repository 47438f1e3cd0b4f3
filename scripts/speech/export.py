"""Makes the model of the package of two trained networks, and its card.

    python scripts/speech/export.py SPEECH.pt EDGES.pt [--out FOLDER]

Weights are stored in half precision, which onnxruntime turns back once, when it loads them.
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import TypeVar

import numpy as np
import onnx
import torch
from network import FUTURE, PAST, STRIDE, EdgeNetwork, SpeechNetwork
from onnx import TensorProto, helper, numpy_helper
from torch import Tensor, nn
from vectortalker.speech.features import N_MELS

OPSET = 17
MODEL_FOLDER = Path("backend/vectortalker/speech/model")
PROGRAMS = "espeak-ng 1.51, Festival 2.5, RHVoice 1.8.0, SVOX Pico 1.0, asterisk-core-sounds 1.6.1"
LEAST_PACKED = 256  # values of an array that is worth packing
Network = TypeVar("Network", SpeechNetwork, EdgeNetwork)


class Listener(nn.Module):
    """Frames [batch, 2n, N_MELS] to logits [batch, n, 15], articulators [batch, n, 7] and logits of edges [batch, n].

    The moment of an edge is half-way between an output frame and the next.
    """

    def __init__(self, speech: SpeechNetwork, edges: EdgeNetwork) -> None:
        super().__init__()
        self.speech = speech
        self.edges = edges

    def forward(self, frames: Tensor) -> tuple[Tensor, Tensor, Tensor]:
        return *self.speech(frames), self.edges(frames)[:, 1::STRIDE]


def restored(kind: type[Network], path: Path) -> Network:
    """The network whose weights are in `path`, of the width that they tell, ready to be asked."""
    weights = torch.load(path, weights_only=True)
    network = kind(len(weights["stem.weight"]))
    network.load_state_dict(weights)
    return network.eval()


def export(network: nn.Module, path: Path) -> None:
    torch.onnx.export(
        network,
        (torch.zeros(1, 4 * (PAST + FUTURE), N_MELS),),
        str(path),
        input_names=["frames"],
        output_names=["logits", "articulators", "edges"],
        dynamic_axes={
            "frames": {1: "n_in"},
            "logits": {1: "n_out"},
            "articulators": {1: "n_out"},
            "edges": {1: "n_out"},
        },
        opset_version=OPSET,
        dynamo=False,
    )
    model = onnx.load(str(path))
    pack(model.graph)
    onnx.checker.check_model(model)
    onnx.save(model, str(path))


def pack(graph: onnx.GraphProto) -> None:
    """Store large float arrays of `graph` as float16, each with a Cast back to float32 under its old name."""
    for array in graph.initializer:
        values = numpy_helper.to_array(array)
        if values.dtype == np.float32 and values.size >= LEAST_PACKED:
            name = array.name
            array.CopyFrom(numpy_helper.from_array(values.astype(np.float16), f"{name}.half"))
            graph.node.insert(0, helper.make_node("Cast", [array.name], [name], to=TensorProto.FLOAT))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("speech", type=Path)
    parser.add_argument("edges", type=Path)
    parser.add_argument("--out", type=Path, default=MODEL_FOLDER)
    options = parser.parse_args()
    listener = Listener(restored(SpeechNetwork, options.speech), restored(EdgeNetwork, options.edges))
    path = options.out / "speech.onnx"
    export(listener, path)
    card = {
        "script": "scripts/speech/export.py",
        "speech": _made(options.speech),
        "edges": _made(options.edges),
        "parameters": sum(parameter.numel() for parameter in listener.parameters()),
        "bytes": path.stat().st_size,
        "past_frames": PAST,
        "future_frames": FUTURE,
        "data": {"script": "scripts/speech/corpus.py", "programs": PROGRAMS},
    }
    (options.out / "speech.json").write_text(json.dumps(card, indent=2) + "\n", encoding="utf-8")


def _made(weights: Path) -> dict:
    """How `weights` were trained, as the file beside them tells."""
    return json.loads(weights.with_suffix(".json").read_text(encoding="utf-8"))


if __name__ == "__main__":
    main()
