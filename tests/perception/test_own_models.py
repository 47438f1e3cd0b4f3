"""A segmentation net of the user's own: tiny ones of the known kinds, made here, find a bright disc for a person."""

from pathlib import Path

import numpy as np
import onnx
import onnx.parser
import pytest
from PIL import Image
from vectortalker.cli.main import main
from vectortalker.errors import VectorTalkerError
from vectortalker.masks import segment
from vectortalker.segmenter import open_segmenter

HEIGHT, WIDTH = 90, 120
CENTRE, RADIUS = (50.0, 40.0), 30.0
BRIGHT, DARK = 230, 40


def picture() -> tuple[np.ndarray, np.ndarray]:
    """A bright disc on dark noise, so that no plain background gives it away, and the disc itself."""
    y, x = np.mgrid[:HEIGHT, :WIDTH] + 0.5
    disc = np.hypot(x - CENTRE[0], y - CENTRE[1]) < RADIUS
    noise = np.random.default_rng(0).integers(0, 30, (HEIGHT, WIDTH, 1))
    return np.where(disc[..., None], BRIGHT, DARK + noise).repeat(3, axis=2).astype(np.uint8)[..., :3], disc


def landmarks() -> np.ndarray:
    """68 points on a small circle in the middle of the disc."""
    turn = np.linspace(0, 2 * np.pi, 68, endpoint=False)
    return np.column_stack([CENTRE[0] + 8 * np.cos(turn), CENTRE[1] + 8 * np.sin(turn)])


# How much brighter than ImageNet's mean a pixel is, as logits.
NET = """
<ir_version: 8, opset_import: ["" : 17]>
net (float[1, 3, 64, 64] picture) => (float[1, 1, 64, 64] mask) {
    steep = Constant <value_float = 20.0> ()
    mean = ReduceMean <axes = [1]> (picture)
    mask = Mul (mean, steep)
}"""

# A square's brightness at a sixteenth of its side.
ENCODER = """
<ir_version: 8, opset_import: ["" : 17]>
encoder (float[1, 3, 1024, 1024] images) => (float[1, 1, 64, 64] embeddings) {
    mean = ReduceMean <axes = [1]> (images)
    embeddings = AveragePool <kernel_shape = [16, 16], strides = [16, 16]> (mean)
}"""

# Three masks: a part, sure; what is as bright as the place of the first point, sure; everything, unsure.
DECODER = """
<ir_version: 8, opset_import: ["" : 17]>
decoder (float[1, 1, 64, 64] image_embeddings, float[1, n, 2] point_coords, float[1, n] point_labels)
    => (float[1, 3, 256, 256] low_res_masks, float[1, 3] iou_predictions)
<float[4] fourfold = {1, 1, 4, 4}, float cell = {16}, int64 first = {0}, int64[2] row_column = {1, 0},
 float near = {0.4}, float steep = {20}, float narrower = {100}>
{
    bright = Resize <mode = "nearest"> (image_embeddings, , fourfold)
    cells = Div (point_coords, cell)
    points = Cast <to = 7> (cells)
    of_picture = Gather <axis = 0> (points, first)
    point = Gather <axis = 0> (of_picture, first)
    at = Gather <axis = 0> (point, row_column)
    map = Squeeze (image_embeddings)
    under = GatherND (map, at)
    difference = Sub (bright, under)
    distance = Abs (difference)
    likeness = Sub (near, distance)
    alike = Mul (likeness, steep)
    part = Sub (alike, narrower)
    everything = Add (distance, near)
    low_res_masks = Concat <axis = 1> (part, alike, everything)
    iou_predictions = Constant <value = float[1, 3] {0.95, 0.9, 0.3}> ()
}"""


def model(text: str, path: Path) -> Path:
    onnx.save(onnx.parser.parse_model(text), path)
    return path


def net(folder: Path) -> Path:
    return model(NET, folder / "net.onnx")


def sam(folder: Path) -> tuple[Path, Path]:
    return model(ENCODER, folder / "encoder.onnx"), model(DECODER, folder / "decoder.onnx")


def overlap(a: np.ndarray, b: np.ndarray) -> float:
    return float((a & b).sum() / (a | b).sum())


@pytest.mark.parametrize("kind", ["net", "sam"])
def test_masks_of_an_own_model_are_taken(kind: str, tmp_path: Path) -> None:
    files = (net(tmp_path),) if kind == "net" else sam(tmp_path)
    rgb, disc = picture()
    masks = segment(rgb, landmarks(), own=open_segmenter(files))
    assert masks.source == "own"
    assert overlap(masks.fore > 0.5, disc) > 0.9


def test_a_sam_without_landmarks_is_not_asked(tmp_path: Path) -> None:
    rgb, _ = picture()
    assert not open_segmenter(sam(tmp_path)).mask_of(rgb, None).any()


def test_models_of_other_files_have_other_digests(tmp_path: Path) -> None:
    assert open_segmenter((net(tmp_path),)).digest != open_segmenter(sam(tmp_path)).digest


def test_faults_are_one_sentence(tmp_path: Path) -> None:
    text = tmp_path / "text.onnx"
    text.write_text("no model")
    encoder, decoder = sam(tmp_path)
    cases = [
        ((tmp_path / "gone.onnx",), "is not there"),
        ((text,), "is no ONNX model"),
        ((decoder,), "does not take one picture"),
        ((encoder, net(tmp_path)), "has no image_embeddings"),
        ((encoder, decoder, decoder), "name one, or encoder and decoder"),
    ]
    for files, words in cases:
        with pytest.raises(VectorTalkerError, match=words) as fault:
            open_segmenter(files)
        assert fault.value.code == "bad_option"


def test_the_command_line_takes_the_name(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    Image.fromarray(picture()[0]).save(tmp_path / "p.png")
    arguments = [
        "vectorize",
        str(tmp_path / "p.png"),
        "-o",
        str(tmp_path / "p.svg"),
        "--segmentation-model",
        "gone.onnx",
    ]
    assert main(arguments) == 2
    assert "gone.onnx is not there" in capsys.readouterr().err
