"""Mouth cues of Rhubarb Lip Sync become articulators, and visemes become mouth cues.

A shape is held, then crosses over to the next in time for it.
"""

from __future__ import annotations

import itertools
import json
import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from vectortalker.errors import VectorTalkerError
from vectortalker.schema import Track, VisemeBlock

FPS = 50.0
TWEEN_SECONDS = 0.06  # 40 to 80 ms read well; the next shape is complete when its cue begins
REST = "X"
MAX_SECONDS = 3600.0
CHANNELS = ("jaw", "width", "round", "upper_raise", "lower_raise", "press", "tongue_tip")
SHAPES = {  # the nine shapes as values of CHANNELS
    "A": (0.0, 0.0, 0.1, 0.0, 0.0, 1.0, 0.0),  # P B M
    "B": (0.15, 0.3, 0.0, 0.3, 0.3, 0.0, 0.2),  # most consonants, EE: teeth together
    "C": (0.6, 0.4, 0.0, 0.3, 0.2, 0.0, 0.0),  # EH AE
    "D": (1.0, 0.1, 0.0, 0.3, 0.3, 0.0, 0.0),  # AA
    "E": (0.6, -0.4, 0.6, 0.1, 0.1, 0.0, 0.0),  # AO ER
    "F": (0.3, -0.7, 1.0, 0.1, 0.1, 0.0, 0.0),  # UW OW W
    "G": (0.1, 0.1, 0.0, 0.3, 1.0, 0.0, 0.0),  # F V
    "H": (0.4, 0.1, 0.0, 0.2, 0.0, 0.0, 0.9),  # L
    "X": (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
}
VISEME_OF = {"A": "PP", "B": "SS", "C": "E", "D": "aa", "E": "O", "F": "U", "G": "FF", "H": "nn", "X": "sil"}
_SHAPE_OF = {"PP": "A", "FF": "G", "aa": "D", "E": "C", "O": "E", "RR": "E", "U": "F", "sil": "X"}
CONSONANT = "B"  # all other visemes: teeth together
DECIMALS = 2  # of times, as Rhubarb writes them


@dataclass(frozen=True)
class Cue:
    start: float  # seconds
    shape: str


def is_tsv(text: str) -> bool:
    """Whether the first line is a time, a tab and one letter."""
    fields = text.lstrip().partition("\n")[0].split("\t")
    return len(fields) == 2 and len(fields[1].strip()) == 1


def from_tsv(text: str, name: str) -> Track:
    """`seconds<TAB>shape` a line; the last line tells the end. Raises `bad_track`."""
    cues = []
    for number, line in enumerate(text.splitlines(), 1):
        if line.strip():
            start, tab, shape = line.partition("\t")
            if not tab:
                raise _bad(f"Line {number} of {name} has no tab between time and shape.")
            cues.append(_cue(start, shape.strip(), f"line {number} of {name}"))
    return _track(cues, max((cue.start for cue in cues), default=0.0), name)


def from_json(document: dict[str, Any], name: str) -> Track:
    """`{"mouthCues": [{"start", "end", "value"}]}`. Raises `bad_track`."""
    listed = document["mouthCues"]
    if not isinstance(listed, list) or not all(isinstance(cue, dict) for cue in listed):
        raise _bad(f"mouthCues of {name} is not a list of cues.")
    cues = [_cue(cue.get("start"), cue.get("value"), f"cue {i + 1} of {name}") for i, cue in enumerate(listed)]
    ends = [_seconds(cue.get("end"), f"cue {i + 1} of {name}") for i, cue in enumerate(listed)]
    return _track(cues, max(ends, default=0.0), name)


def cues_of(visemes: Iterable[VisemeBlock], duration: float) -> list[Cue]:
    """Shapes from 0 on, rest where there is no viseme; equal neighbours become one."""
    edges: list[tuple[float, str]] = [(0.0, REST)]
    for block in visemes:
        edges += [(block.t, _SHAPE_OF.get(block.viseme, CONSONANT)), (block.t + block.d, REST)]
    edges = [(round(min(time, duration), DECIMALS), shape) for time, shape in edges]
    lasting = [
        edge for edge, (following, _) in zip(edges, [*edges[1:], (duration, REST)], strict=True) if following > edge[0]
    ]
    starts = [lasting[0], *(after for before, after in itertools.pairwise(lasting) if after[1] != before[1])]
    return [Cue(time, shape) for time, shape in starts]


def to_tsv(cues: list[Cue], duration: float) -> str:
    """What `from_tsv` reads; at least one cue."""
    rows = [*cues, Cue(duration, REST)]
    return "".join(f"{cue.start:.{DECIMALS}f}\t{cue.shape}\n" for cue in rows)


def to_json(cues: list[Cue], duration: float, name: str) -> str:
    """What `from_json` reads; `name` stands for the sound file."""
    ends = [*(cue.start for cue in cues[1:]), round(duration, DECIMALS)]
    listed = [{"start": cue.start, "end": end, "value": cue.shape} for cue, end in zip(cues, ends, strict=True)]
    document = {"metadata": {"soundFile": name, "duration": round(duration, DECIMALS)}, "mouthCues": listed}
    return json.dumps(document, indent=2, ensure_ascii=False) + "\n"


def _cue(start: object, shape: object, place: str) -> Cue:
    if not isinstance(shape, str) or shape not in SHAPES:
        raise _bad(f"The shape {shape!r:.20} in {place} is none of {' '.join(SHAPES)}.")
    return Cue(_seconds(start, place), str(shape))


def _seconds(value: object, place: str) -> float:
    try:
        seconds = float(value)  # type: ignore[arg-type]  # whatever it is, float() decides
    except (TypeError, ValueError, OverflowError) as error:
        raise _bad(f"The time {value!r:.20} in {place} is no number.") from error
    if not (math.isfinite(seconds) and 0 <= seconds <= MAX_SECONDS):
        raise _bad(f"The time {seconds:g} s in {place} is not within 0 and {MAX_SECONDS:.0f} s.")
    return seconds


def _track(cues: list[Cue], end: float, name: str) -> Track:
    n_frames = round(end * FPS)
    if not cues or n_frames < 1:
        raise _bad(f"{name} has no mouth cues.")
    times = np.arange(n_frames) / FPS
    cues = sorted(cues, key=lambda cue: cue.start)
    knots, shapes = _knots(cues)
    values = np.array([SHAPES[shape] for shape in shapes])
    channels = {
        channel: np.interp(times, knots, values[:, column]).round(4).tolist() for column, channel in enumerate(CHANNELS)
    }
    channels["neutral"] = [1.0] * n_frames  # shapes are those of a mouth that rests closed
    data = {"name": name, "duration": n_frames / FPS, "fps": FPS, "articulators": channels}
    return Track.model_validate(data | {"visemes": _visemes(cues, n_frames / FPS)})


def _visemes(cues: list[Cue], end: float) -> list[dict[str, Any]]:
    """The cues as blocks that an editor shows, each a viseme of much the same shape."""
    spans = zip(cues, [*(cue.start for cue in cues[1:]), end], strict=True)
    return [
        {"t": cue.start, "d": round(stop - cue.start, 3), "viseme": VISEME_OF[cue.shape], "weight": 1.0}
        for cue, stop in spans
        if round(stop - cue.start, 3) > 0
    ]


def _knots(cues: list[Cue]) -> tuple[list[float], list[str]]:
    """Times, ascending, and the shape at each: the end of one shape, then the begin of the next."""
    knots, shapes = [0.0], [cues[0].shape if cues[0].start == 0 else REST]
    for cue in cues:
        knots += [max(knots[-1], cue.start - TWEEN_SECONDS), cue.start]
        shapes += [shapes[-1], cue.shape]
    return knots, shapes


def _bad(message: str) -> VectorTalkerError:
    return VectorTalkerError("bad_track", message)
