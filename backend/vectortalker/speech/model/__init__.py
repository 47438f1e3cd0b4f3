"""The trained network `speech.onnx` and its card `speech.json`: seed, scripts, data and held-out figures."""
