"""Whole files become broken ones: bytes changed, cut out, doubled, or cut off."""

from __future__ import annotations

from collections.abc import Sequence

from hypothesis import strategies as st

ODD = st.sampled_from([0, 1, 0x7F, 0x80, 0xFF]) | st.integers(0, 255)
HEADER_BYTES = 64  # where sizes and kinds are told; hit as often as all the rest


@st.composite
def damaged(draw: st.DrawFn, whole: Sequence[bytes]) -> bytes:
    data = bytearray(draw(st.sampled_from(whole)))
    for _ in range(draw(st.integers(1, 6))):
        if not data:
            break
        reach = len(data) - 1 if draw(st.booleans()) else min(HEADER_BYTES, len(data) - 1)
        at = draw(st.integers(0, reach))
        match draw(st.integers(0, 4)):
            case 0 | 1:
                data[at] = draw(ODD)
            case 2:
                del data[at : at + draw(st.integers(1, 40))]
            case 3:
                data[at:at] = data[at : at + draw(st.integers(1, 40))]
            case 4:
                del data[at:]
    return bytes(data)
