"""Traces portraits, poses them, counts what goes wrong and lays the poses out on sheets to be looked at one by one.

Usage: rig_sheets.py OUT [--names part,part] [--preset draft|standard]; prints a table. Traced portraits are kept in
OUT/projects, sheets are OUT/NAME.png.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from dataclasses import astuple
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw
from rig_figures import PoseFigures, Sitting
from vectortalker.animate.frames import frame_size
from vectortalker.animate.rigged import frame_points, rig_scene
from vectortalker.bench.portraits import Sitter, portrait_files, portrait_folder, sitters
from vectortalker.project import ProjectFile, pack, unpack
from vectortalker.schema import Landmarks, Pose, Project, VectorizeOptions
from vectortalker.vectorize import vectorize

POSES: dict[str, dict[str, float]] = {
    "rest": {},
    "closed": {"neutral": 1},
    "wide open": {"jaw": 1},
    "round": {"jaw": 0.3, "round": 1},
    "smile": {"smile": 1},
    "half blink": {"blink_left": 0.5, "blink_right": 0.5},
    "full blink": {"blink_left": 1, "blink_right": 1},
    "gaze left": {"gaze_x": -1},
    "gaze right": {"gaze_x": 1},
    "gaze up": {"gaze_y": -1},
    "gaze down": {"gaze_y": 1},
    "roll -15": {"roll": -15},
    "roll 15": {"roll": 15},
    "yaw -15": {"yaw": -15},
    "yaw 15": {"yaw": 15},
    "pitch -10": {"pitch": -10},
    "pitch 10": {"pitch": 10},
}
SIDE = 512  # px at which the counts are made
COLUMNS, CELL = 6, 280
HEAD = 0.45  # of the face's size, shown around it


def project_of(sitter: Sitter, preset: str, folder: Path) -> Project:
    """The traced portrait, from `folder` if it has been traced before."""
    file = folder / f"{Path(sitter.portrait.name).stem}.vtalk"
    if file.exists():
        return unpack(file.read_bytes(), file.name).project
    run = vectorize(sitter.portrait, sitter.landmarks, VectorizeOptions.model_validate({"preset": preset}), threads=1)
    while True:
        try:
            next(run)
        except StopIteration as end:
            scene = end.value.scene
            break
    project = Project(name=file.stem, scene=scene, landmarks=sitter.landmarks)
    file.write_bytes(pack(ProjectFile(project)))
    return project


def posed(project: Project, landmarks: Landmarks) -> Iterator[tuple[str, PoseFigures, Image.Image]]:
    """Every pose with its figures and its picture of the head."""
    rigged = rig_scene(project.scene, landmarks)
    sitting = Sitting(rigged, project.scene, frame_size(rigged.drawing, SIDE, even=False))
    points = np.array(landmarks.points)
    low, high = points.min(axis=0), points.max(axis=0)
    margin = HEAD * (high - low).max()
    scale = CELL / (high - low + 2 * margin).max()
    large = rigged.drawing.width * scale, rigged.drawing.height * scale
    box = [round(float(v) * scale) for v in (*(low - margin), *(high + margin))]
    for name, articulators in POSES.items():
        pose = Pose(articulators=articulators)
        frame = frame_points(rigged, rigged.rig.vertices(pose).vertices)
        whole = sitting.picture(frame, (max(1, round(large[0])), max(1, round(large[1]))))
        yield name, sitting.figures(pose), Image.fromarray(whole).convert("RGB").crop(tuple(box))


def sheet(cells: list[tuple[str, Image.Image]]) -> Image.Image:
    rows = -(-len(cells) // COLUMNS)
    paper = Image.new("RGB", (COLUMNS * CELL, rows * (CELL + 16)), "white")
    pen = ImageDraw.Draw(paper)
    for index, (name, picture) in enumerate(cells):
        x, y = index % COLUMNS * CELL, index // COLUMNS * (CELL + 16)
        pen.text((x + 4, y + 2), name, fill="black")
        paper.paste(picture, (x, y + 16))
    return paper


def row(name: str, figures: dict[str, PoseFigures]) -> str:
    """One line of the table: the worst of all poses, and of the poses that a figure is about."""
    worst = dict(zip(PoseFigures.__dataclass_fields__, zip(*map(astuple, figures.values()), strict=True), strict=True))
    eyes = figures["full blink"].eyes
    held = ", ".join(f"{pose} {f.held:.0%}" for pose, f in figures.items() if f.held < 1) or "–"
    return (
        f"| {name} | {max(worst['holes'])} | {max(worst['tears'])} | {max(worst['strayed'])} | {eyes} "
        f"| {max(worst['iris']):.1%} | {figures['wide open'].teeth:.1%} | {held} |"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("out", type=Path)
    parser.add_argument("--names")
    parser.add_argument("--preset", default="draft")
    options = parser.parse_args()
    (options.out / "projects").mkdir(parents=True, exist_ok=True)
    print(
        "| portrait | holes px | tears px | strayed px | eye px at full blink | iris shape | teeth size | held back |"
    )
    print("|---|---|---|---|---|---|---|---|", flush=True)
    for sitter in sitters(portrait_files(portrait_folder(), quick=False, names=options.names)):
        name = Path(sitter.portrait.name).stem
        if sitter.landmarks is None:
            print(f"| {name} | no face found: five pins |||||||")
            continue
        project = project_of(sitter, options.preset, options.out / "projects")
        taken = list(posed(project, sitter.landmarks))
        sheet([(pose, picture) for pose, _, picture in taken]).save(options.out / f"{name}.png")
        print(row(name, {pose: figures for pose, figures, _ in taken}), flush=True)


if __name__ == "__main__":
    main()
