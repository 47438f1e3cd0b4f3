"""Turns a project and a track into a file, or a folder of frames, by the ending of its name."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from vectortalker.animate import html, images, svg, video
from vectortalker.animate.folder import whole_folder
from vectortalker.animate.frames import FrameRenderer, Rgba, frame_size
from vectortalker.animate.rigged import RiggedScene, frame_points, rig_scene, vertices_at
from vectortalker.animate.sound import as_m4a
from vectortalker.errors import VectorTalkerError
from vectortalker.outputs import whole_file
from vectortalker.schema import Project, Track

Progress = Callable[[float], None]  # told the done share, 0 to 1; may raise to stop the work

MAX_FPS = 60.0
SIZES = range(16, 4097)  # pixels of the longer side
N_PALETTE_FRAMES = 8  # spread over the track; enough to meet every colour
ENDINGS = (".svg", ".html", ".mp4", ".webm", ".gif")


@dataclass(frozen=True)
class Options:
    """`fps` and `size` (longer side, pixels) are those of frames; an animated SVG has neither."""

    fps: float = 25.0
    size: int = 512
    looped: bool = True  # of the animated SVG and of the web page without sound


def animate(
    project: Project,
    track: Track,
    out: Path,
    options: Options,
    progress: Progress,
    audio: Path | None = None,
) -> None:
    """Write `out` whole or not at all; without an ending it is a folder of PNGs. `.html`, `.mp4`, `.webm` take `audio`.

    Raises `bad_option` for an ending, size or rate that is not supported, or sound for a silent format; `bad_landmarks`
    for a project without a face; `bad_audio` for sound that cannot be read.
    """
    _check(out, options, audio)
    if project.landmarks is None:
        raise VectorTalkerError("bad_landmarks", f"{project.name} has no face: fit one in the editor first.")
    rigged = rig_scene(project.scene, project.landmarks)
    progress(0.0)
    if out.suffix == "":
        with whole_folder(out) as folder:
            images.write_pngs(_frames(rigged, track, options.fps, options.size, progress, even=False), folder)
    else:
        with whole_file(out) as draft:
            _write_file(rigged, track, draft, project.name, options, progress, audio)
    progress(1.0)


def _check(out: Path, options: Options, audio: Path | None) -> None:
    if out.suffix not in ("", *ENDINGS):
        known = ", ".join(ENDINGS)
        raise VectorTalkerError("bad_option", f"{out.name} ends in {out.suffix}; known: {known}, or none for a folder.")
    if not 1 <= options.fps <= MAX_FPS:
        raise VectorTalkerError("bad_option", f"{options.fps:g} frames a second; 1 to {MAX_FPS:g} are possible.")
    if options.size not in SIZES:
        raise VectorTalkerError("bad_option", f"Size {options.size}; {SIZES.start} to {SIZES.stop - 1} are possible.")
    if audio is not None and out.suffix not in (".html", ".mp4", ".webm"):
        kind = out.suffix or "a folder of PNGs"
        raise VectorTalkerError(
            "bad_option", f"{kind} holds no sound. Write .html, .mp4 or .webm, or leave the audio out."
        )


def _write_file(
    rigged: RiggedScene,
    track: Track,
    draft: Path,
    title: str,
    options: Options,
    progress: Progress,
    audio: Path | None,
) -> None:
    match draft.suffix:
        case ".svg":
            draft.write_text(svg.animated_svg(rigged, track, title, looped=options.looped), encoding="utf-8")
        case ".html":
            sound = None if audio is None else as_m4a(audio)
            looped = options.looped and sound is None
            text = svg.animated_svg(rigged, track, title, looped=looped)
            draft.write_text(html.page(text, title, sound), encoding="utf-8")
        case ".gif":
            fps = images.gif_fps(options.fps)
            frames = _frames(rigged, track, fps, options.size, progress, even=False)
            images.write_gif(frames, draft, fps, _palette_frames(rigged, track, options.size))
        case ending:
            size = frame_size(rigged.drawing, options.size, even=True)
            frames = _frames(rigged, track, options.fps, options.size, progress, even=True)
            video.write_video(frames, draft, options.fps, size, ending[1:], audio)


def _frames(
    rigged: RiggedScene, track: Track, fps: float, longer_side: int, progress: Progress, *, even: bool
) -> Iterator[Rgba]:
    """Rendered frames of the whole track; frame i is at i / fps seconds."""
    renderer = FrameRenderer(rigged.drawing, frame_size(rigged.drawing, longer_side, even=even))
    n_frames = max(1, round(track.duration * fps))
    for index in range(n_frames):
        (vertices,) = vertices_at(rigged, track, np.array([index / fps]))
        yield renderer.render(frame_points(rigged, vertices))
        progress((index + 1) / n_frames)


def _palette_frames(rigged: RiggedScene, track: Track, longer_side: int) -> list[Rgba]:
    renderer = FrameRenderer(rigged.drawing, frame_size(rigged.drawing, longer_side, even=False))
    times = np.linspace(0, track.duration, N_PALETTE_FRAMES)
    return [renderer.render(frame_points(rigged, vertices)) for vertices in vertices_at(rigged, track, times)]
