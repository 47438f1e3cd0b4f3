"""Small valid documents that the tests spoil."""

from __future__ import annotations

from vectortalker.schema import Landmarks, LinearFill, LocalPath, Project, Scene, ScenePath, SolidFill, Stop, Track

BOX = [0.0, 0, 1, 0, 2, 0, 3, 0, 3, 1, 3, 2]


def scene() -> Scene:
    solid = SolidFill(colour="#102030", opacity=0.5)
    linear = LinearFill(start=(0, 0), end=(3, 2), stops=[Stop(colour="#ffffff"), Stop(colour="#000000", opacity=0)])
    return Scene(
        width=100,
        height=80,
        canvas="#aabbcc",
        back=[ScenePath(points=BOX, fill=solid)],
        fore=[ScenePath(points=[3.0 * value for value in BOX], fill=linear)],
        local=[LocalPath(points=BOX, fill=solid, part="tongue")],
    )


def project() -> Project:
    landmarks = Landmarks(points=[(i, 2.0 * i) for i in range(68)])
    track = Track(duration=0.2, fps=10, articulators={"jaw": [0, 1]})
    return Project(name="Ada", scene=scene(), landmarks=landmarks, tracks=[track], settings={"gain": 0.7, "loop": True})
