"""Names manners of speaking: how far the mouth opens, how smoothly, and how much the head and brows join in."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

from vectortalker.speech.coarticulation import Blend

StyleName = Literal["subtle", "normal", "cartoon"]


@dataclass(frozen=True)
class Style:
    """Factors on the channels (1: as learnt), and the blend's half-lives."""

    jaw: float
    lips: float  # width, round, raises
    head: float
    brows: float
    blend: Blend


STYLES: dict[StyleName, Style] = {
    "subtle": Style(jaw=0.65, lips=0.8, head=0.6, brows=0.5, blend=Blend(0.06, 0.1)),
    "normal": Style(jaw=1.0, lips=1.0, head=1.0, brows=1.0, blend=Blend()),
    "cartoon": Style(jaw=1.35, lips=1.3, head=1.6, brows=1.8, blend=Blend(0.035, 0.05)),
}

CHANNEL_GROUPS = ("mouth", "blink", "head", "brows")


@dataclass(frozen=True)
class Options:
    """What a user may choose. `gains` (by channel group or channel; 0 mutes) come on top of the style."""

    style: StyleName = "normal"
    transcript: str | None = None
    language: str = "en"
    amplitude: float = 1.0  # of the mouth
    smoothing: float = 1.0  # on the blend's half-lives
    seed: int = 0
    gains: dict[str, float] = field(default_factory=dict)
