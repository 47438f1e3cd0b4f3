"""Whole files become broken ones: bytes changed, cut out, doubled, or cut off."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from random import Random

ODD = (0, 1, 0x7F, 0x80, 0xFF)
HEADER_BYTES = 64  # where sizes and kinds are told; hit as often as all the rest
MAX_CHANGES = 6
MAX_RUN = 40  # bytes cut out or doubled
NOISE_SHARE = 0.1  # of inputs that are no file at all
NOISE_BYTES = 200


def damaged(whole: Sequence[bytes]) -> Callable[[Random], bytes]:
    """A maker of broken copies of `whole` files, and of noise."""

    def make(random: Random) -> bytes:
        if random.random() < NOISE_SHARE:
            return random.randbytes(random.randrange(NOISE_BYTES))
        data = bytearray(random.choice(whole))
        for _ in range(random.randint(1, MAX_CHANGES)):
            if data:
                _change(random, data)
        return bytes(data)

    return make


def _change(random: Random, data: bytearray) -> None:
    at = random.randrange(len(data) if random.random() < 0.5 else min(HEADER_BYTES, len(data)))
    match random.randrange(5):
        case 0 | 1:
            data[at] = random.choice([*ODD, random.randrange(256)])
        case 2:
            del data[at : at + random.randint(1, MAX_RUN)]
        case 3:
            data[at:at] = data[at : at + random.randint(1, MAX_RUN)]
        case 4:
            del data[at:]
