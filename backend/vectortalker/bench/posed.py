"""Portraits become a table of what goes wrong when they are posed, and sheets of the poses to be looked at."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from PIL import Image

from vectortalker.animate.frames import frame_size
from vectortalker.animate.rigged import frame_points, rig_scene
from vectortalker.bench.portraits import Sitter
from vectortalker.bench.posed_figures import PoseFigures, Sitting
from vectortalker.bench.posed_views import VIEWS, Camera, sheet
from vectortalker.bench.tables import markdown
from vectortalker.outputs import whole_file, write_whole
from vectortalker.project import ProjectFile, pack, unpack
from vectortalker.schema import Landmarks, Pose, Preset, Project, VectorizeOptions
from vectortalker.vectorize import vectorize

SIDE = 512  # px at which the counts are made
COLUMNS = (
    *("portrait", "holes", "tears", "strayed", "eye"),
    *("iris shape", "iris size", "iris look", "teeth size", "held back"),
)
NO_FACE = "no face found: five pins"


def posed_table(people: Sequence[Sitter], preset: Preset, folder: Path) -> str:
    """A line of figures per portrait; project, figures and sheet go to `folder`, and those that are there are kept.

    Without its figures a project is posed and counted again, in seconds; without the project it is traced as well.
    """
    folder.mkdir(parents=True, exist_ok=True)
    lines = [list(COLUMNS)]
    for sitter in people:
        name = Path(sitter.portrait.name).stem
        if sitter.landmarks is None:
            lines.append([name, NO_FACE, *[""] * (len(COLUMNS) - 2)])
            continue
        kept = folder / f"{name}.json"
        if not kept.exists():
            project = traced(sitter, preset, folder / f"{name}.vtalk")
            figures, pictures = _posed(project, sitter.landmarks)
            with whole_file(folder / f"{name}.png") as part:
                sheet(pictures).save(part)
            write_whole(kept, json.dumps(_cells(figures), ensure_ascii=False).encode())
        lines.append([name, *json.loads(kept.read_text(encoding="utf-8"))])
    return f"### Portraits posed, {preset} preset, {SIDE} px\n\n{markdown(lines)}\n"


def traced(sitter: Sitter, preset: Preset, file: Path) -> Project:
    """The portrait's project, from `file` if it is there, else traced and kept there."""
    if file.exists():
        return unpack(file.read_bytes(), file.name).project
    run = vectorize(sitter.portrait, sitter.landmarks, VectorizeOptions(preset=preset))
    while True:
        try:
            next(run)
        except StopIteration as end:
            project = Project(name=file.stem, scene=end.value.scene, landmarks=sitter.landmarks)
            write_whole(file, pack(ProjectFile(project)))
            return project


def _posed(
    project: Project, landmarks: Landmarks
) -> tuple[dict[str, PoseFigures], list[list[tuple[str, Image.Image]]]]:
    """Figures of every pose, and captioned pictures view by view."""
    rigged = rig_scene(project.scene, landmarks)
    sitting = Sitting(rigged, project.scene, landmarks, frame_size(rigged.drawing, SIDE, even=False))
    figures: dict[str, PoseFigures] = {}
    pictures: list[list[tuple[str, Image.Image]]] = []
    for view in VIEWS:
        camera = Camera(rigged, view, np.array(landmarks.points))
        pictures.append([])
        for name, articulators in view.poses.items():
            pose = Pose(articulators=articulators)
            figures[name] = sitting.figures(pose, view.parts)
            points = frame_points(rigged, rigged.rig.vertices(pose).vertices)
            pictures[-1].append((name, camera.picture(points)))
    return figures, pictures


def _cells(figures: dict[str, PoseFigures]) -> list[str]:
    """The worst of all poses, and of the poses that a figure is about: an iris nears and shrinks as the head turns."""
    eyes, mouth, _ = ([figures[pose] for pose in view.poses] for view in VIEWS)
    every = list(figures.values())
    held = ", ".join(f"{pose} {f.held:.0%}" for pose, f in figures.items() if f.held < 1) or "–"
    return [
        str(max(f.holes for f in every)),
        str(max(f.tears for f in every)),
        str(max(f.strayed for f in every)),
        str(figures["full blink"].eyes),
        f"{max(f.iris_shape for f in every):.1%}",
        f"{max(f.iris_size for f in eyes):.1%}",
        f"{max(f.iris_look for f in eyes):.1%}",
        f"{max(f.teeth_size for f in mouth):.1%}",
        held,
    ]
