"""A MediaPipe wheel becomes three plain ONNX models: face detector, face mesh with attention, selfie segmentation.

Usage: convert_mediapipe.py WHEEL FOLDER      needs: tensorflow-cpu tf2onnx onnx
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

import onnx
from attention_ops import replace_attention_ops
from selfie_ops import replace_transposed_convolution

OPSET = 16  # the first with GridSample
MODELS = {
    "face_detection_short_range": ("mediapipe/modules/face_detection", None),
    "face_landmark_with_attention": ("mediapipe/modules/face_landmark", replace_attention_ops),
    "selfie_segmentation": ("mediapipe/modules/selfie_segmentation", replace_transposed_convolution),
}


def main(wheel: Path, folder: Path) -> None:
    with tempfile.TemporaryDirectory() as scratch, zipfile.ZipFile(wheel) as archive:
        for name, (package, replace_ops) in MODELS.items():
            tflite = Path(archive.extract(f"{package}/{name}.tflite", scratch))
            converted = tflite.with_suffix(".onnx")
            command = [sys.executable, "-m", "tf2onnx.convert", "--opset", str(OPSET)]
            subprocess.run([*command, "--tflite", str(tflite), "--output", str(converted)], check=True)
            model = onnx.load(converted)
            if replace_ops is not None:
                replace_ops(model.graph)
            onnx.checker.check_model(model)
            onnx.save(model, folder / f"{name}.onnx")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(Path(sys.argv[1]), Path(sys.argv[2]))
