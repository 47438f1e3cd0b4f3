"""The model file that is made of trained networks, smaller than they are."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import onnxruntime
import pytest
import torch
from onnx import ModelProto, TensorProto, helper, numpy_helper

SCRIPTS = Path(__file__).parents[2] / "scripts" / "speech"
TRAINING_MODULES = ("export", "network")


@pytest.fixture
def export(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.syspath_prepend(str(SCRIPTS))
    yield __import__("export")
    for name in TRAINING_MODULES:
        sys.modules.pop(name)


def product_with(weights: np.ndarray) -> ModelProto:
    """A model that multiplies its rows `x` by a stored matrix [n, m]."""
    n_in, n_out = weights.shape
    graph = helper.make_graph(
        [helper.make_node("MatMul", ["x", "weights"], ["y"])],
        "product",
        [helper.make_tensor_value_info("x", TensorProto.FLOAT, [1, n_in])],
        [helper.make_tensor_value_info("y", TensorProto.FLOAT, [1, n_out])],
        [numpy_helper.from_array(weights, "weights")],
    )
    return helper.make_model(graph, opset_imports=[helper.make_opsetid("", 17)], ir_version=8)


def answer(model: ModelProto, inputs: np.ndarray, name: str) -> np.ndarray:
    session = onnxruntime.InferenceSession(model.SerializeToString(), providers=["CPUExecutionProvider"])
    return np.asarray(session.run(None, {name: inputs})[0])


def test_packed_weights_take_half_the_bytes_and_answer_alike(export) -> None:
    generator = np.random.default_rng(1)
    model = product_with(generator.normal(size=(64, 32)).astype(np.float32))
    inputs = generator.normal(size=(1, 64)).astype(np.float32)
    before, n_bytes = answer(model, inputs, "x"), model.ByteSize()
    export.pack(model.graph)
    assert model.ByteSize() < 0.55 * n_bytes
    assert answer(model, inputs, "x") == pytest.approx(before, abs=0.02)


def test_edges_are_those_between_output_frames(export) -> None:
    edges = export.EdgeNetwork(8).eval()
    frames = torch.randn(1, 40, export.N_MELS)
    listener = export.Listener(export.SpeechNetwork(8).eval(), edges)
    assert torch.equal(listener(frames)[2], edges(frames)[:, 1::2])
