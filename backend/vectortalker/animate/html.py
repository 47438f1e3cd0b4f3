"""Turns an animated SVG, and sound if there is any, into one web page that needs no other file.

The browser's export fills in the same template. In it sound is the master clock, so that lips never run away from the
voice, whatever the machine skips; without sound the animation runs by itself, and a click or the space bar pauses it.
"""

from __future__ import annotations

import base64
from importlib import resources
from string import Template
from xml.sax.saxutils import escape


def page(svg: str, title: str, audio: bytes | None) -> str:
    """HTML text around the text of an animated `svg`; `audio` is an MP4 sound file."""
    template = Template(resources.files("vectortalker.animate").joinpath("page.html").read_text(encoding="utf-8"))
    data = None if audio is None else base64.b64encode(audio).decode()
    player = "" if data is None else f'<audio controls src="data:audio/mp4;base64,{data}"></audio>'
    return template.substitute(title=escape(title), svg=svg, player=player)
