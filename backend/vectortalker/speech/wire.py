"""Turns speech's values into those of the contract, and back."""

from __future__ import annotations

from vectortalker.schema import SpeechOptions, VisemeBlock
from vectortalker.speech.styles import Options
from vectortalker.speech.visemes import Block, cut

LEAST_SECONDS = 0.001  # a gap or block below what the wire's times can tell


def options_of(given: SpeechOptions, transcript: str | None) -> Options:
    return Options(
        style=given.style,
        transcript=transcript,
        language=given.language,
        amplitude=given.amplitude,
        smoothing=given.smoothing,
        seed=given.seed,
        gains=dict(given.gains),
    )


def to_wire(blocks: list[Block]) -> list[VisemeBlock]:
    """Times to the millisecond."""
    return [
        VisemeBlock.model_validate(
            {"t": round(block.start, 3), "d": round(block.duration, 3), "viseme": block.viseme}
            | {"weight": round(block.weight, 2)}
        )
        for block in blocks
        if block.duration >= LEAST_SECONDS
    ]


def from_wire(visemes: list[VisemeBlock], duration: float) -> list[Block]:
    """Blocks from 0 to `duration` seconds, silence where there are none."""
    blocks: list[Block] = []
    end = 0.0
    for given in visemes:
        if given.t - end > LEAST_SECONDS:
            blocks.append(Block(end, given.t - end, "sil"))
        blocks.append(Block(given.t, given.d, given.viseme, given.weight))
        end = given.t + given.d
    if duration - end > LEAST_SECONDS:
        blocks.append(Block(end, duration - end, "sil"))
    return cut(blocks, 0.0, duration)
