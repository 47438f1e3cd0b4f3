"""Turns viseme blocks into articulator curves, each sound colouring its neighbours' mouth shapes.

The blend is by dominance functions (Cohen and Massaro 1993, "Modeling coarticulation in synthetic visual speech",
equations 1 to 3): every block pulls each channel towards its target with a strength that decays exponentially with
distance, and the curve is the mean of the targets weighted by strength. Here distance is counted from the middle half
of a block rather than from its centre, nearly all of a long one, so that vowels have a plateau and pauses do not gape
early. Closures are then laid over the blend, because a mean never closes.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from vectortalker.speech.visemes import CHANNELS, TARGETS, VISEMES, Block

FPS = 50.0
JAW, ROUND, LOWER, PRESS = (CHANNELS.index(name) for name in ("jaw", "round", "lower_raise", "press"))

_STRENGTHS = {"sil": 1.0, "PP": 0.3, "FF": 0.4, "CH": 0.7, "RR": 0.6, "SS": 0.5} | dict.fromkeys(
    ("TH", "DD", "kk", "nn"), 0.35
)
STRENGTH = np.array([_STRENGTHS.get(name, 1.0) for name in VISEMES])  # α, the vowels' is 1
ROUND_HALF_LIFE = 0.12  # seconds before a rounded sound at which its rounding is felt by half
ONSET = 0.03  # seconds within a block, a quarter of it at most, after which its pull is full
REACH = 0.5  # seconds beyond a block after which its pull is below 2 %
SHORT_PAUSE = 0.12  # seconds; shorter silences do not bring the mouth to rest

CLOSURE_LEAD = 0.03  # seconds by which lips meet before the sound of their closure begins
CLOSURE_HOLD = 0.06  # least time that they stay together
REST_HOLD = 0.25  # longest time that closed lips wait in a pause, after which the jaw has come to rest, too
CLOSURE_RAMP = 0.05  # time of their way there, and back
CLOSED_JAW = 0.5  # share of the jaw's opening that is left at p, b, m; the lips stretch over it


@dataclass(frozen=True)
class Blend:
    """Half-lives (seconds) of a block's pull before it begins and after it ends: mouths pop open and close slowly."""

    attack: float = 0.05
    release: float = 0.08


def articulate(blocks: list[Block], n_frames: int, blend: Blend) -> NDArray[np.float64]:
    """Curves [n_frames, 7] of CHANNELS; frame i is at i / FPS seconds. No blocks: a mouth at rest."""
    pulls = np.full((n_frames, len(CHANNELS)), 1e-6)  # where nothing reaches, rest
    sums = np.zeros_like(pulls)
    for block in blocks:
        first = max(0, int((block.start - REACH) * FPS))
        last = min(n_frames, int((block.end + REACH) * FPS) + 2)
        pull = _dominance(block, np.arange(first, last) / FPS, blend)
        pulls[first:last] += pull
        sums[first:last] += pull * _target(block)
    curves = sums / pulls
    for before, block, after in zip([None, *blocks], blocks, [*blocks[1:], None], strict=False):
        if block.viseme in ("PP", "FF"):
            _close(curves, block, _pause(before), _pause(after))
    return curves


def _pause(neighbour: Block | None) -> float:
    """Seconds for which lips that meet beside a pause stay together in it: they do not gape at nothing."""
    return min(neighbour.duration, REST_HOLD) if neighbour is not None and neighbour.viseme == "sil" else 0.0


def _target(block: Block) -> NDArray[np.float64]:
    target = TARGETS[VISEMES.index(block.viseme)].copy()
    target[JAW] = min(1.0, target[JAW] * block.weight)
    return target


def _dominance(block: Block, times: NDArray[np.float64], blend: Blend) -> NDArray[np.float64]:
    """D [frames, 7] of one block: α · exp(−θ τ), θ by side and channel."""
    alpha = STRENGTH[VISEMES.index(block.viseme)]
    if block.viseme == "sil":
        alpha *= min(1.0, block.duration / SHORT_PAUSE) ** 2
    onset = min(0.25 * block.duration, ONSET)
    before = np.maximum(block.start + onset - times, 0)
    after = np.maximum(times - block.end + onset, 0)
    half_lives = np.full(len(CHANNELS), blend.attack)
    if TARGETS[VISEMES.index(block.viseme), ROUND] > 0:
        half_lives[ROUND] = max(blend.attack, ROUND_HALF_LIFE)
    return alpha * np.exp2(-before[:, None] / half_lives - after[:, None] / blend.release)


def _close(curves: NDArray[np.float64], block: Block, lead: float, hold: float) -> None:
    """Bring lips together over `block` (p b m), or the lower lip to the upper teeth (f v), whatever the blend says.

    They meet `lead` seconds earlier and part `hold` seconds later than closures within speech do.
    """
    start = block.start - CLOSURE_LEAD - lead
    end = max(block.end - CLOSURE_LEAD, block.start - CLOSURE_LEAD + CLOSURE_HOLD) + hold
    first = max(0, int((start - CLOSURE_RAMP) * FPS))
    times = np.arange(first, min(len(curves), int((end + CLOSURE_RAMP) * FPS) + 2)) / FPS
    away = np.maximum(start - times, times - end).clip(0, CLOSURE_RAMP) / CLOSURE_RAMP
    share = 0.5 + 0.5 * np.cos(np.pi * away)
    window = curves[first : first + len(times)]
    if block.viseme == "PP":
        window[:, PRESS] = np.maximum(window[:, PRESS], share)
        window[:, JAW] *= 1 - (1 - CLOSED_JAW) * share
    else:
        target = TARGETS[VISEMES.index("FF")]
        for channel in (JAW, LOWER):
            window[:, channel] += share * (target[channel] - window[:, channel])
