"""The attention mesh's three custom operators (namespace v2 of MediaPipe's TFLite operations) become standard ones.

* `Landmarks2TransformMatrix`: the box around some landmarks, turned by the line between two of them, as a map from the
  edges of an output grid (0..16) to the edges of a feature map (0..48);
* `TransformTensorBilinear`: samples the feature map there; samples outside it are zero, not its border;
* `TransformLandmarks`: maps points back.

A transform is held as its three used rows [3, 2] (x column, y column, shift) instead of a 4x4 matrix.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from onnx import GraphProto, NodeProto, TensorProto, helper, numpy_helper

N_MESH = 468
FEATURE_SIDE = 48


class Rewriter:
    """Adds nodes and constants to a graph under fresh names."""

    def __init__(self, graph: GraphProto) -> None:
        self.graph = graph
        self.nodes: list[NodeProto] = []
        self.count = 0

    def fresh(self, kind: str) -> str:
        self.count += 1
        return f"{kind}_rewritten_{self.count}"

    def constant(self, value: ArrayLike, dtype: type = np.float32) -> str:
        name = self.fresh("constant")
        self.graph.initializer.append(numpy_helper.from_array(np.asarray(value, dtype), name))
        return name

    def indices(self, *values: int) -> str:
        return self.constant(values, np.int64)

    def add(self, kind: str, *inputs: str, output: str | None = None, **attributes: Any) -> str:
        name = output or self.fresh(kind.lower())
        self.nodes.append(helper.make_node(kind, list(inputs), [name], **attributes))
        return name


def replace_attention_ops(graph: GraphProto) -> None:
    """Rewrites the graph in place."""
    rewriter = Rewriter(graph)
    handlers = {
        "TFL_Landmarks2TransformMatrix": _matrix_from_landmarks,
        "TFL_TransformTensorBilinear": _sample_features,
        "TFL_TransformLandmarks": _transform_landmarks,
    }
    for node in list(graph.node):
        handler = handlers.get(node.op_type)
        if handler is None:
            rewriter.nodes.append(node)
        else:
            attributes = {entry.name: helper.get_attribute_value(entry) for entry in node.attribute}
            handler(rewriter, node, attributes)
    _shorten_matrix_constants(rewriter)
    del graph.node[:]
    graph.node.extend(rewriter.nodes)
    used = {name for node in graph.node for name in node.input}
    kept = [tensor for tensor in graph.initializer if tensor.name in used]
    del graph.initializer[:]
    graph.initializer.extend(kept)
    del graph.value_info[:]  # shapes of the replaced operators


def _matrix_from_landmarks(r: Rewriter, node: NodeProto, attributes: dict[str, Any]) -> None:
    if attributes["target_rotation_radians"] != 0:
        raise ValueError("only a target rotation of 0 is converted")
    width, height = attributes["output_width"], attributes["output_height"]
    points = r.add("Reshape", node.input[0], r.indices(N_MESH, 3))
    xy = r.add("Slice", points, r.indices(0), r.indices(2), r.indices(1))
    right = r.add("Gather", xy, r.indices(attributes["right_rotation_idx"]))
    left = r.add("Gather", xy, r.indices(attributes["left_rotation_idx"]))
    line = r.add("Sub", right, left)
    u = r.add("Div", line, r.add("ReduceL2", line, axes=[1], keepdims=1))
    v = r.add("MatMul", u, r.constant([[0, 1], [-1, 0]]))
    basis = r.add("Concat", u, v, axis=0)
    subset = r.add("Gather", xy, r.constant(attributes["subset_idxs"], np.int64))
    turned = r.add("MatMul", subset, r.add("Transpose", basis, perm=[1, 0]))
    low = r.add("ReduceMin", turned, axes=[0], keepdims=1)
    high = r.add("ReduceMax", turned, axes=[0], keepdims=1)
    middle = r.add("MatMul", r.add("Mul", r.add("Add", low, high), r.constant(0.5)), basis)
    per_cell = r.constant([[attributes["scale_x"] / width, attributes["scale_y"] / height]])
    scale = r.add("Mul", r.add("Sub", high, low), per_cell)
    x_row = r.add("Mul", u, r.add("Slice", scale, r.indices(0), r.indices(1), r.indices(1)))
    y_row = r.add("Mul", v, r.add("Slice", scale, r.indices(1), r.indices(2), r.indices(1)))
    half_x = r.add("Mul", x_row, r.constant(width / 2))
    half_y = r.add("Mul", y_row, r.constant(height / 2))
    shift = r.add("Sub", middle, r.add("Add", half_x, half_y))
    r.add("Concat", x_row, y_row, shift, output=node.output[0], axis=0)


def _sample_features(r: Rewriter, node: NodeProto, attributes: dict[str, Any]) -> None:
    width, height = attributes["output_width"], attributes["output_height"]
    x, y = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
    centres = r.constant(np.stack([x.ravel(), y.ravel(), np.ones(width * height)], axis=1))
    edges = r.add("MatMul", centres, node.input[1])
    unit = r.add("Sub", r.add("Mul", edges, r.constant(2 / FEATURE_SIDE)), r.constant(1))
    grid = r.add("Reshape", unit, r.indices(1, height, width, 2))
    channels_first = r.add("Transpose", node.input[0], perm=[0, 3, 1, 2])
    sampled = r.add("GridSample", channels_first, grid, mode="bilinear", padding_mode="border", align_corners=0)
    pixels = r.add("Sub", edges, r.constant(0.5))
    clipped = r.add("Clip", pixels, r.constant(0), r.constant(FEATURE_SIDE - 1))
    inside = r.add("Cast", r.add("Equal", pixels, clipped), to=TensorProto.FLOAT)
    both = r.add("ReduceMin", inside, axes=[1], keepdims=1)
    mask = r.add("Reshape", both, r.indices(1, 1, height, width))
    r.add("Transpose", r.add("Mul", sampled, mask), output=node.output[0], perm=[0, 2, 3, 1])


def _transform_landmarks(r: Rewriter, node: NodeProto, _: dict[str, Any]) -> None:
    linear = r.add("Slice", node.input[1], r.indices(0), r.indices(2), r.indices(0))
    shift = r.add("Slice", node.input[1], r.indices(2), r.indices(3), r.indices(0))
    r.add("Add", r.add("MatMul", node.input[0], linear), shift, output=node.output[0])


def _shorten_matrix_constants(r: Rewriter) -> None:
    """Constants that multiply the 4x4 matrices are cut to the rows in use: columns 0, 1 and 3, of x and y."""
    constants = {tensor.name: numpy_helper.to_array(tensor) for tensor in r.graph.initializer}
    for node in r.nodes:
        if node.op_type == "Mul" and node.output[0].startswith("multiply_by_constant_"):
            for index, name in enumerate(node.input):
                if name in constants and constants[name].size == 16:
                    matrix = constants[name].reshape(4, 4)
                    node.input[index] = r.constant(matrix[:2, [0, 1, 3]].T)
