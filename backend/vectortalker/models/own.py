"""A model of the user's own: opened, run, and refused in one sentence where it is not of the kind that is needed."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import onnxruntime
from numpy.typing import NDArray

from vectortalker.errors import VectorTalkerError

ELEMENT_TYPES = {"tensor(float)": "float32", "tensor(uint8)": "uint8"}
SILENT = 4  # onnxruntime's log level: faults are told by exceptions


@dataclass(frozen=True)
class OwnModel:
    """`digest`: SHA-256 of the file."""

    name: str
    digest: str
    session: onnxruntime.InferenceSession

    @property
    def inputs(self) -> list[onnxruntime.NodeArg]:
        return list(self.session.get_inputs())

    @property
    def output_names(self) -> set[str]:
        return {node.name for node in self.session.get_outputs()}

    def run(
        self, inputs: dict[str, NDArray[np.generic]], outputs: list[str] | None = None
    ) -> list[NDArray[np.float32]]:
        """All outputs, or the named ones. Raises `bad_option` where the model cannot take these inputs."""
        try:
            return [np.asarray(output) for output in self.session.run(outputs, inputs)]
        except Exception as error:  # onnxruntime's own exceptions have no other class in common
            raise self.refusal(f"it cannot be run ({_first_line(error)})") from error

    def element_type(self, node: onnxruntime.NodeArg) -> str:
        """Name of the numpy type of an input. Raises `bad_option` for types other than float32 and uint8."""
        if node.type not in ELEMENT_TYPES:
            known = " or ".join(ELEMENT_TYPES.values())
            raise self.refusal(f"its input {node.name} is {node.type}, and {known} is needed")
        return ELEMENT_TYPES[node.type]

    def refusal(self, why: str) -> VectorTalkerError:
        """`why` is a clause that follows the name of the file."""
        return VectorTalkerError("bad_option", f"{self.name} cannot be used: {why}.")


def open_own(path: Path) -> OwnModel:
    """Raises `bad_option` for a file that is not there or is no ONNX model."""
    if not path.is_file():
        raise VectorTalkerError("bad_option", f"{path} is not there: name the file of an ONNX model.")
    options = onnxruntime.SessionOptions()
    options.add_session_config_entry("session.intra_op.allow_spinning", "0")  # waiting threads leave the core to others
    options.log_severity_level = SILENT
    try:
        session = onnxruntime.InferenceSession(str(path), options, providers=["CPUExecutionProvider"])
    except Exception as error:  # onnxruntime's own exceptions have no other class in common
        raise VectorTalkerError("bad_option", f"{path.name} is no ONNX model ({_first_line(error)}).") from error
    with path.open("rb") as file:
        return OwnModel(path.name, hashlib.file_digest(file, "sha256").hexdigest(), session)


def _first_line(error: Exception) -> str:
    return str(error).strip().splitlines()[0]
