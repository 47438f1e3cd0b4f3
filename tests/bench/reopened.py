"""What was exported is opened again: frames of a video, and holes in the frames of a project's track.

Usage: reopened.py VIDEO.mp4 PROJECT.vtalk; prints JSON.
"""

from __future__ import annotations

import json
import sys
from itertools import pairwise
from pathlib import Path

import av
import numpy as np
from numpy.typing import NDArray
from vectortalker.animate.frames import FrameRenderer, frame_size
from vectortalker.animate.rigged import frame_points, rig_scene, vertices_at
from vectortalker.project import unpack
from vectortalker.schema import Landmarks, Scene, Track

SEES_THROUGH = 16  # of 255 between magenta and green: about one part in sixteen of the canvas shows
FRAMES_A_SECOND = 5.0
SIDE = 512


def video_figures(file: Path) -> dict[str, float]:
    """Frames, their size, and the mean difference of successive frames in levels of 255."""
    with av.open(str(file)) as container:
        frames = [frame.to_ndarray(format="rgb24").astype(np.int16) for frame in container.decode(video=0)]
    steps = [float(np.abs(later - earlier).mean()) for earlier, later in pairwise(frames)]
    height, width, _ = frames[0].shape
    still = sum(step < 0.01 for step in steps)
    return {"frames": len(frames), "width": width, "height": height, "step": float(np.mean(steps)), "still": still}


def see_through(scene: Scene, landmarks: Landmarks, track: Track) -> dict[str, int]:
    """Pixels through which the canvas shows: at rest, and the most in any frame that are whole at rest."""
    rigged = rig_scene(scene, landmarks)
    size = frame_size(rigged.drawing, SIDE, even=False)
    over = [FrameRenderer(rigged.drawing, size, background=colour) for colour in ("#ff00ff", "#00ff00")]

    def shows(points: NDArray[np.float64]) -> NDArray[np.bool_]:
        magenta, green = (renderer.render(points).astype(np.int16) for renderer in over)
        return np.abs(magenta - green).max(axis=2) > SEES_THROUGH

    at_rest = shows(rigged.rest)
    times = np.arange(0.0, track.duration, 1 / FRAMES_A_SECOND)
    new = [(shows(frame_points(rigged, vertices)) & ~at_rest).sum() for vertices in vertices_at(rigged, track, times)]
    return {"rest": int(at_rest.sum()), "new": int(max(new))}


def main(video: str, project_file: str) -> None:
    project = unpack(Path(project_file).read_bytes(), project_file).project
    assert project.landmarks is not None, project_file
    track = project.tracks[0]
    holes = see_through(project.scene, project.landmarks, track)
    print(json.dumps({"video": video_figures(Path(video)), "holes": holes}))


if __name__ == "__main__":
    main(*sys.argv[1:])
