"""A track at a time becomes a pose."""

from __future__ import annotations

from vectortalker.schema import OffsetXy, Pose, Track


def sample(track: Track, time: float) -> Pose:
    """Linear between frames, as the warp is in the landmarks; before the first and after the last frame, that frame.

    Frame i is at i / fps seconds. Landmarks are offsets from a neutral face, so they come with the channel `neutral`.
    """
    position = max(0.0, time * track.fps)
    index, share = int(position), position % 1
    articulators = {
        name: _mixed(values[min(index, len(values) - 1)], values[min(index + 1, len(values) - 1)], share)
        for name, values in (track.articulators or {}).items()
    }
    if track.landmarks is None:
        return Pose(articulators=articulators)
    last = len(track.landmarks) - 1
    before, after = track.landmarks[min(index, last)], track.landmarks[min(index + 1, last)]
    offsets: list[OffsetXy] = [
        (_mixed(x0, x1, share), _mixed(y0, y1, share)) for (x0, y0), (x1, y1) in zip(before, after, strict=True)
    ]
    return Pose(articulators={"neutral": 1.0} | articulators, offsets=offsets)


def _mixed(before: float, after: float, share: float) -> float:
    return before + share * (after - before)
