"""Golden: the web page of an animated SVG, byte for byte what the browser's export writes (`pageFile.test.ts`)."""

from __future__ import annotations

from pathlib import Path

import pytest
from vectortalker.animate.html import page

GOLDEN = Path(__file__).parents[1] / "vectors/page"
SVG = "<svg><title>$player &amp; $1</title></svg>"  # looks like what a template or a replacement fills in
TITLE = "Ada & <Lucy> $svg"


@pytest.mark.parametrize(("name", "audio"), [("silent", None), ("spoken", b"\0\1\2")])
def test_page_is_the_golden_one(name: str, audio: bytes | None) -> None:
    assert page(SVG, TITLE, audio) == (GOLDEN / f"{name}.html").read_text(encoding="utf-8")
