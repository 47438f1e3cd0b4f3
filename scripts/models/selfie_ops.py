"""Selfie segmentation's one custom operator becomes a standard transposed convolution."""

from __future__ import annotations

import numpy as np
from onnx import GraphProto, helper, numpy_helper


def replace_transposed_convolution(graph: GraphProto) -> None:
    """`Convolution2DTransposeBias` (kernel 2, stride 2): weights (out, h, w, in) become (in, out, h, w)."""
    constants = {tensor.name: numpy_helper.to_array(tensor) for tensor in graph.initializer}
    for index, node in enumerate(graph.node):
        if node.op_type != "TFL_Convolution2DTransposeBias":
            continue
        to_channels_last = next(other for other in graph.node if node.input[0] in other.output)
        weights = np.ascontiguousarray(constants[node.input[1]].transpose(3, 0, 1, 2))
        graph.initializer.append(numpy_helper.from_array(weights, "upsample_weights"))
        graph.initializer.append(numpy_helper.from_array(constants[node.input[2]], "upsample_bias"))
        inputs = [to_channels_last.input[0], "upsample_weights", "upsample_bias"]
        convolution = helper.make_node("ConvTranspose", inputs, ["upsampled"], strides=[2, 2], kernel_shape=[2, 2])
        transpose = helper.make_node("Transpose", ["upsampled"], [node.output[0]], perm=[0, 2, 3, 1])
        graph.node.remove(node)
        graph.node.insert(index, convolution)
        graph.node.insert(index + 1, transpose)
        return
